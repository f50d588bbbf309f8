// Collada through importModel(): what Assimp 5.2 invents or misreads.
#include <algorithm>
#include <numbers>
#include <string>

#include "renderengine/import_options.h"
#include "tests/scene/model_files.h"

namespace antipode {
namespace {

using testing::inputErrorOf;

constexpr double kDegree = std::numbers::pi / 180;

struct Collada {
    std::string tool = "by hand", up = "Y_UP", unit = "1";
    std::string shader = "<lambert><diffuse><color>0.4 0.2 0.1 1</color></diffuse></lambert>";
    std::string light = "<point><color>50 50 50</color></point>", lightExtra;
    std::string camera = "id=\"c\" name=\"c\"", lens = "<yfov>45</yfov><aspect_ratio>2</aspect_ratio>";
    std::string space;  ///< before every list of numbers

    std::string text() const {
        const std::string s = space;
        return "<?xml version=\"1.0\"?>\n<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
               "version=\"1.4.1\">"
               "<asset><contributor><authoring_tool>" +
               tool + "</authoring_tool></contributor><unit meter=\"" + unit + "\"/><up_axis>" + up +
               "</up_axis></asset>"
               "<library_cameras><camera " +
               camera + "><optics><technique_common><perspective>" + lens +
               "<znear>0.1</znear><zfar>100</zfar></perspective></technique_common></optics></camera></library_cameras>"
               "<library_lights><light id=\"l\"><technique_common>" +
               light + "</technique_common>" + lightExtra +
               "</light></library_lights>"
               "<library_effects><effect id=\"e\"><profile_COMMON><technique sid=\"common\">" +
               shader +
               "</technique></profile_COMMON></effect></library_effects>"
               "<library_materials><material id=\"m\" name=\"mat\"><instance_effect "
               "url=\"#e\"/></material></library_materials>"
               "<library_geometries><geometry id=\"g\"><mesh><source id=\"p\"><float_array id=\"pa\" count=\"9\">" +
               s +
               "0 0 0 1 0 0 0 1 0</float_array><technique_common><accessor source=\"#pa\" count=\"3\" stride=\"3\">"
               "<param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/>"
               "</accessor></technique_common></source><vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/>"
               "</vertices><triangles material=\"m\" count=\"1\"><input semantic=\"VERTEX\" source=\"#v\" "
               "offset=\"0\"/><p>" +
               s +
               "0 1 2</p></triangles></mesh></geometry></library_geometries>"
               "<library_visual_scenes><visual_scene id=\"s\">"
               "<node id=\"gn\"><instance_geometry url=\"#g\"><bind_material><technique_common>"
               "<instance_material symbol=\"m\" "
               "target=\"#m\"/></technique_common></bind_material></instance_geometry></node>"
               "<node id=\"cn\"><matrix>" +
               s +
               "1 0 0 0 0 1 0 0 0 0 1 5 0 0 0 1</matrix><instance_camera url=\"#c\"/></node>"
               "<node id=\"ln\"><matrix>" +
               s +
               "1 0 0 0 0 1 0 0 0 0 1 3 0 0 0 1</matrix><instance_light url=\"#l\"/></node>"
               "</visual_scene></library_visual_scenes><scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>";
    }
};

class ColladaImport : public testing::ModelFiles {
protected:
    Scene import(const Collada& file) const { return importModel(write("m.dae", file.text())); }
};

TEST_F(ColladaImport, LambertHasNoHighlight) {
    const Material m = import({}).materials.at(0);
    EXPECT_EQ(m.kind, MaterialKind::Lambert);
    EXPECT_EQ(m.baseColor, Vec3f(0.4f, 0.2f, 0.1f));
}

TEST_F(ColladaImport, PhongHasWhatItSays) {
    Collada file;
    file.shader = "<phong><diffuse><color>0.4 0.2 0.1 1</color></diffuse></phong>";
    EXPECT_EQ(import(file).materials.at(0).kind, MaterialKind::Lambert) << "without <specular>";
    file.shader =
        "<phong><diffuse><color>0.4 0.2 0.1 1</color></diffuse><specular><color>0.5 0.25 0.5 1</color></specular>"
        "<shininess><float>20</float></shininess></phong>";
    const Material m = import(file).materials.at(0);
    EXPECT_EQ(m.kind, MaterialKind::Phong);
    EXPECT_EQ(m.specular, Vec3f(0.5f, 0.25f, 0.5f));
    EXPECT_EQ(m.phongExponent, 20.0f);
}

TEST_F(ColladaImport, LampsAreInWatts) {
    EXPECT_NEAR(import({}).pointLights.at(0).intensity.x, 50 / (4 * std::numbers::pi), 1e-5);
    Collada sun;
    sun.light = "<directional><color>3 2 1</color></directional>";
    EXPECT_EQ(import(sun).directionalLights.at(0).irradiance, Vec3f(3, 2, 1));
}

TEST_F(ColladaImport, SpotsShineWhereTheySay) {
    Collada file;
    file.light = "<spot><color>1 1 1</color><falloff_angle>20</falloff_angle></spot>";
    const SpotLight hard = import(file).spotLights.at(0);
    EXPECT_NEAR(hard.outerHalfAngle, 20 * kDegree, 1e-6);
    EXPECT_GT(hard.innerHalfAngle, 0.99f * hard.outerHalfAngle);
    file.tool = "Blender 4.2.0";
    file.lightExtra =
        "<extra><technique profile=\"blender\"><spotblend type=\"float\">0.25</spotblend></technique></extra>";
    const SpotLight soft = import(file).spotLights.at(0);
    EXPECT_NEAR(soft.outerHalfAngle, 10 * kDegree, 1e-6) << "Blender writes the full angle";
    EXPECT_NEAR(soft.innerHalfAngle, 7.5 * kDegree, 1e-6);
}

TEST_F(ColladaImport, FieldsOfView) {
    for (const char* camera : {"id=\"c\" name=\"c\"", "id=\"c\""}) {
        Collada file;
        file.camera = camera;
        const Scene scene = import(file);
        EXPECT_NEAR(scene.camera.verticalFov, 45 * kDegree, 1e-6) << camera;
        EXPECT_EQ(scene.imageWidth, 1024u);
        file.lens = "<xfov>60</xfov><aspect_ratio>1.5</aspect_ratio>";
        EXPECT_NEAR(import(file).camera.verticalFov, 2 * std::atan(std::tan(30 * kDegree) / 1.5), 1e-6);
        file.lens = "<xfov>60</xfov><yfov>40</yfov>";
        EXPECT_EQ(import(file).imageWidth,
                  uint32_t(std::lround(512 * std::tan(30 * kDegree) / std::tan(20 * kDegree))));
    }
}

TEST_F(ColladaImport, SpacesBeforeNumbersMeanNothing) {
    Collada file;
    file.space = "\n\t ";
    file.shader = "<lambert><diffuse><color>\n 0.4 0.2 0.1 1</color></diffuse></lambert>";
    file.light = "<point><color> 50 50 50</color></point>";
    file.lens = "<yfov> 45</yfov>";
    const Scene scene = import(file);
    EXPECT_EQ(scene.materials.at(0).baseColor, Vec3f(0.4f, 0.2f, 0.1f));
    EXPECT_NEAR(scene.pointLights.at(0).intensity.x, 50 / (4 * std::numbers::pi), 1e-5);
    EXPECT_NEAR(scene.camera.verticalFov, 45 * kDegree, 1e-6);
}

TEST_F(ColladaImport, UnitsAndUpAxis) {
    Collada file;
    file.up = "Z_UP";
    file.unit = "0.01";
    const Vec3f position = import(file).pointLights.at(0).position;
    EXPECT_NEAR(position.y, 0.03f, 1e-6);
    EXPECT_NEAR(position.z, 0, 1e-6);
}

TEST_F(ColladaImport, BrokenXmlIsAnError) {
    const std::string text = Collada().text();
    const std::string message = inputErrorOf([&] { importModel(write("m.dae", text.substr(0, text.size() / 2))); });
    EXPECT_NE(message.find("XML"), std::string::npos) << message;
}

TEST_F(ColladaImport, TransparencyWithoutRefractionIsCoverage) {
    Collada file;
    const std::string diffuse = "<phong><diffuse><color>0.4 0.2 0.1 1</color></diffuse>", end = "</phong>";
    file.shader = diffuse +
                  "<transparent><color>1 1 1 1</color></transparent>"
                  "<transparency><float>0.25</float></transparency>" +
                  end;
    const Material quarter = import(file).materials.at(0);
    ASSERT_TRUE(quarter.coverage.has_value());
    EXPECT_NEAR(*quarter.coverage, 0.25f, 1e-6f);
    file.shader = diffuse + end;
    EXPECT_FALSE(import(file).materials.at(0).coverage.has_value());
}

TEST_F(ColladaImport, WhatWouldBeInvisibleIsOpaque) {
    Collada file;
    file.shader =
        "<phong><diffuse><color>0.4 0.2 0.1 1</color></diffuse>"
        "<transparent><color>1 1 1 1</color></transparent>"
        "<transparency><float>0</float></transparency></phong>";
    const Scene scene = import(file);
    EXPECT_FALSE(scene.materials.at(0).coverage.has_value());
    const auto said = [](const std::string& n) { return n.find("invisible") != n.npos; };
    EXPECT_EQ(std::count_if(scene.notices.begin(), scene.notices.end(), said), 1);
}

TEST_F(ColladaImport, ParallelProjections) {
    Collada file;
    const std::string old = "<perspective>", parallel = "<orthographic>";
    file.lens = "<xmag>3</xmag><aspect_ratio>1.5</aspect_ratio>";
    std::string text = file.text();
    text.replace(text.find(old), old.size(), parallel);
    text.replace(text.find("</perspective>"), 14, "</orthographic>");
    const Scene scene = importModel(write("p.dae", text));
    EXPECT_NEAR(scene.camera.orthographicHeight, 4, 1e-6) << "2·3/1.5";
    EXPECT_EQ(scene.imageWidth, 768u);
}

TEST_F(ColladaImport, ACameraThatSeesNothingIsReplaced) {
    Collada file;
    std::string text = file.text();
    const std::string stand = "0 0 1 5 0 0 0 1", away = "0 0 1 -5 0 0 0 1";
    text.replace(text.find(stand), stand.size(), away);
    const std::string path = write("away.dae", text);
    const Scene scene = importModel(path);
    EXPECT_GT(scene.camera.position.z, 0);
    const auto said = [](const std::string& n) { return n.find("next to nothing") != n.npos; };
    EXPECT_EQ(std::count_if(scene.notices.begin(), scene.notices.end(), said), 1);
    ImportOptions byName;
    byName.camera = "cn";
    EXPECT_EQ(importModel(path, byName).camera.position.z, -5) << "asked for";
}

TEST_F(ColladaImport, NothingStandsForMissingGeometry) {
    Collada file;
    std::string text = file.text();
    const size_t begin = text.find("<node id=\"gn\">"), end = text.find("<node id=\"cn\">");
    text.erase(begin, end - begin);
    EXPECT_NE(inputErrorOf([&] { importModel(write("e.dae", text)); }).find("no surface"), std::string::npos);
}

}  // namespace
}  // namespace antipode
