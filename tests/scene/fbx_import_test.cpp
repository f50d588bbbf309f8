// FBX through importModel(): units, up axis, powers of lamps, and materials as Blender writes them. Numbers as by
// Blender's io_scene_fbx: Intensity = 100·W, Shininess = (10·(1 − roughness))², SpecularFactor = specular/2.
#include <algorithm>
#include <numbers>
#include <string>

#include "renderengine/import_options.h"
#include "tests/scene/model_files.h"

namespace antipode {
namespace {

struct Fbx {
    std::string creator = "Blender (stable FBX IO) - 4.2.0", unit = "1";
    int up = 1;
    std::string shading = "Phong", material = "P: \"DiffuseColor\", \"Color\", \"\", \"A\",0.4,0.2,0.1\n";
    std::string light = "P: \"LightType\", \"enum\", \"\", \"\",0\nP: \"Intensity\", \"Number\", \"\", \"A\",5000\n";
    std::string objects, connections;

    std::string text() const {
        return "; FBX 7.4.0 project file\n"
               "FBXHeaderExtension:  {\nFBXHeaderVersion: 1003\nFBXVersion: 7400\nCreator: \"" +
               creator +
               "\"\n}\nGlobalSettings:  {\nVersion: 1000\nProperties70:  {\n"
               "P: \"UpAxis\", \"int\", \"Integer\", \"\"," +
               std::to_string(up) +
               "\n"
               "P: \"UnitScaleFactor\", \"double\", \"Number\", \"\"," +
               unit +
               "\n}\n}\n"
               "Objects:  {\n"
               "Geometry: 1, \"Geometry::q\", \"Mesh\" {\nVertices: *9 {\na: 0,0,0,100,0,0,0,200,0\n}\n"
               "PolygonVertexIndex: *3 {\na: 0,1,-3\n}\nGeometryVersion: 124\n"
               "LayerElementMaterial: 0 {\nVersion: 101\nName: \"\"\nMappingInformationType: \"AllSame\"\n"
               "ReferenceInformationType: \"IndexToDirect\"\nMaterials: *1 {\na: 0\n}\n}\n"
               "Layer: 0 {\nVersion: 100\nLayerElement:  {\nType: \"LayerElementMaterial\"\nTypedIndex: 0\n}\n}\n}\n"
               "Model: 2, \"Model::q\", \"Mesh\" {\nVersion: 232\n}\n"
               "Material: 3, \"Material::m\", \"\" {\nVersion: 102\nShadingModel: \"" +
               shading +
               "\"\n"
               "Properties70:  {\n" +
               material +
               "}\n}\n"
               "NodeAttribute: 4, \"NodeAttribute::l\", \"Light\" {\nProperties70:  {\n" +
               light +
               "}\nTypeFlags: \"Light\"\n}\n"
               "Model: 5, \"Model::l\", \"Light\" {\nVersion: 232\nProperties70:  {\n"
               "P: \"Lcl Translation\", \"Lcl Translation\", \"\", \"A\",0,0,300\n}\n}\n" +
               objects +
               "}\n"
               "Connections:  {\nC: \"OO\",2,0\nC: \"OO\",1,2\nC: \"OO\",3,2\nC: \"OO\",5,0\nC: \"OO\",4,5\n" +
               connections + "}\n";
    }
};

class FbxImport : public testing::ModelFiles {
protected:
    Scene import(const Fbx& fbx, const ImportOptions& options = {}) const {
        return importModel(write("m.fbx", fbx.text()), options);
    }
};

void expectNear(const Vec3f& a, const Vec3f& b) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(a[axis], b[axis], 1e-5f) << axis;
}

TEST_F(FbxImport, LengthsAreMetres) {
    const Scene centimetres = import({});
    expectNear(centimetres.meshes.at(0).positions[2], {0, 2, 0});
    expectNear(centimetres.pointLights.at(0).position, {0, 0, 3});
    Fbx metres;
    metres.unit = "100";
    expectNear(import(metres).meshes.at(0).positions[2], {0, 200, 0});
}

TEST_F(FbxImport, UpIsY) {
    Fbx fbx;
    fbx.up = 2;
    expectNear(import(fbx).pointLights.at(0).position, {0, 3, 0});
    ImportOptions options;
    options.up = UpAxis::Y;
    expectNear(import(fbx, options).pointLights.at(0).position, {0, 0, 3});
    options.up = UpAxis::Z;
    expectNear(import({}, options).pointLights.at(0).position, {0, 3, 0});
}

TEST_F(FbxImport, LampsAreInWatts) {
    expectNear(import({}).pointLights.at(0).intensity, Vec3f(float(50 / (4 * std::numbers::pi))));
    Fbx sun;
    sun.light = "P: \"LightType\", \"enum\", \"\", \"\",1\nP: \"Intensity\", \"Number\", \"\", \"A\",300\n";
    expectNear(import(sun).directionalLights.at(0).irradiance, Vec3f(3));
    Fbx spot;
    spot.light =
        "P: \"LightType\", \"enum\", \"\", \"\",2\nP: \"Intensity\", \"Number\", \"\", \"A\",5000\n"
        "P: \"InnerAngle\", \"Number\", \"\", \"A\",40\nP: \"OuterAngle\", \"Number\", \"\", \"A\",60\n";
    const SpotLight light = import(spot).spotLights.at(0);
    expectNear(light.intensity, Vec3f(float(50 / (4 * std::numbers::pi))));
    EXPECT_NEAR(light.outerHalfAngle, 30 * std::numbers::pi / 180, 1e-5);
    EXPECT_NEAR(light.innerHalfAngle, 20 * std::numbers::pi / 180, 1e-5);
}

const std::string kSpecular = "P: \"SpecularColor\", \"Color\", \"\", \"A\",0.4,0.2,0.1\n";

TEST_F(FbxImport, SpecularFactorScalesTheHighlight) {
    Fbx fbx;
    fbx.material += kSpecular + "P: \"SpecularFactor\", \"Number\", \"\", \"A\",0\n";
    const Material matte = import(fbx).materials.at(0);
    EXPECT_EQ(matte.kind, MaterialKind::Lambert);
    expectNear(matte.baseColor, {0.4f, 0.2f, 0.1f});

    fbx.creator = "FBX SDK/FBX Plugins";
    fbx.material = "P: \"DiffuseColor\", \"Color\", \"\", \"A\",0.4,0.2,0.1\n" + kSpecular +
                   "P: \"SpecularFactor\", \"Number\", \"\", \"A\",0.5\n";
    const Material glossy = import(fbx).materials.at(0);
    EXPECT_EQ(glossy.kind, MaterialKind::Phong);
    expectNear(glossy.specular, {0.2f, 0.1f, 0.05f});
}

TEST_F(FbxImport, BlendersPrincipledMaterial) {
    Fbx fbx;
    fbx.material +=
        kSpecular +
        "P: \"SpecularFactor\", \"Number\", \"\", \"A\",0.25\n"
        "P: \"Shininess\", \"Number\", \"\", \"A\",36\nP: \"ShininessExponent\", \"Number\", \"\", \"A\",36\n"
        "P: \"ReflectionFactor\", \"Number\", \"\", \"A\",0.75\n";
    const Material m = import(fbx).materials.at(0);
    EXPECT_EQ(m.kind, MaterialKind::MetallicRoughness);
    expectNear(m.baseColor, {0.4f, 0.2f, 0.1f});
    EXPECT_NEAR(m.roughness, 0.4f, 1e-6);
    EXPECT_NEAR(m.metallic, 0.75f, 1e-6);
    EXPECT_NEAR(m.specularFactor, 1.0f, 1e-6) << "Blender's specular of one half";
}

TEST_F(FbxImport, ATextureReplacesTheColor) {
    write("two.png", testing::makePng());
    Fbx fbx;
    fbx.objects =
        "Texture: 6, \"Texture::t\", \"\" {\nType: \"TextureVideoClip\"\nVersion: 202\n"
        "FileName: \"C:\\somewhere\\TWO.png\"\nRelativeFilename: \"C:\\somewhere\\TWO.png\"\n}\n";
    fbx.connections = "C: \"OP\",6,3, \"DiffuseColor\"\n";
    const Scene scene = import(fbx);
    expectNear(scene.materials.at(0).baseColor, Vec3f(1));
    ASSERT_TRUE(scene.materials[0].baseColorTexture.has_value());
    EXPECT_EQ(scene.textures.at(0).width, 2u) << "found by its bare name";
}

TEST_F(FbxImport, PhysicallyBasedMaterials) {
    Fbx fbx;
    fbx.creator = "FBX SDK/FBX Plugins version 2020.2";
    fbx.material +=
        "P: \"3dsMax|main|baseColor\", \"ColorAndAlpha\", \"\", \"A\",0.1,0.2,0.3,1\n"
        "P: \"3dsMax|main|metalness\", \"Float\", \"\", \"A\",0.75\n"
        "P: \"3dsMax|main|roughness\", \"Float\", \"\", \"A\",0.25\n";
    const Material max = import(fbx).materials.at(0);
    EXPECT_EQ(max.kind, MaterialKind::MetallicRoughness);
    expectNear(max.baseColor, {0.1f, 0.2f, 0.3f});
    EXPECT_EQ(max.metallic, 0.75f);
    EXPECT_EQ(max.roughness, 0.25f);

    fbx = {};
    fbx.creator = "FBX SDK/FBX Plugins version 2020.2";
    fbx.material +=
        "P: \"Maya|base\", \"float\", \"\", \"\",0.5\n"
        "P: \"Maya|baseColor\", \"Vector3D\", \"Vector\", \"\",0.2,0.4,0.8\n"
        "P: \"Maya|specularRoughness\", \"float\", \"\", \"\",0.4\n";
    const Material maya = import(fbx).materials.at(0);
    EXPECT_EQ(maya.kind, MaterialKind::MetallicRoughness);
    expectNear(maya.baseColor, {0.1f, 0.2f, 0.4f});
    EXPECT_EQ(maya.metallic, 0.0f);
    EXPECT_EQ(maya.roughness, 0.4f);
}

TEST_F(FbxImport, TransparencyIsCoverage) {
    Fbx fbx;
    fbx.material +=
        "P: \"TransparencyFactor\", \"Number\", \"\", \"A\",0.75\n"
        "P: \"Opacity\", \"Number\", \"\", \"A\",0.25\n";
    const Material m = import(fbx).materials.at(0);
    ASSERT_TRUE(m.coverage.has_value());
    EXPECT_NEAR(*m.coverage, 0.25f, 1e-6f);
}

TEST_F(FbxImport, ParallelProjectionsAreLeftOutByName) {
    for (const bool isParallel : {true, false}) {
        Fbx fbx;
        fbx.objects =
            "NodeAttribute: 6, \"NodeAttribute::c\", \"Camera\" {\nProperties70:  {\n"
            "P: \"CameraProjectionType\", \"enum\", \"\", \"\"," +
            std::string(isParallel ? "1" : "0") +
            "\n}\nTypeFlags: \"Camera\"\n}\n"
            "Model: 7, \"Model::view\", \"Camera\" {\nVersion: 232\nProperties70:  {\n"
            "P: \"Lcl Translation\", \"Lcl Translation\", \"\", \"A\",-500,0,0\n}\n}\n";
        fbx.connections = "C: \"OO\",7,0\nC: \"OO\",6,7\n";
        ImportOptions options;  // by its name it is taken as it is
        if (!isParallel) options.camera = "view";
        const Scene scene = import(fbx, options);
        const auto said = [](const std::string& n) { return n.find("parallel projection") != n.npos; };
        EXPECT_EQ(std::count_if(scene.notices.begin(), scene.notices.end(), said), isParallel);
        EXPECT_EQ(scene.camera.position.x == -5, !isParallel) << scene.camera.position.x;
    }
}

}  // namespace
}  // namespace antipode
