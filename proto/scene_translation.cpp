#include "proto/scene_translation.h"

#include <optional>
#include <utility>

#include "proto/name_table.h"
#include "proto/schema_camera.h"
#include "proto/schema_fields.h"
#include "proto/schema_materials.h"
#include "proto/schema_shapes.h"
#include "proto/schema_values.h"
#include "renderengine/error.h"
#include "scene/defaults.h"
#include "scene/environment_map.h"
#include "scene/image_decode.h"
#include "scene/import_model.h"
#include "scene/mesh_cleanup.h"

namespace antipode {
namespace {

/// The engine's enumerators stand in the schema's order.
static_assert(int(WrapMode::Repeat) == schema::Texture::REPEAT && int(WrapMode::Mirror) == schema::Texture::MIRROR &&
              int(WrapMode::Clamp) == schema::Texture::CLAMP);

class Translator {
public:
    /// Without a directory the scene is a resolved one: no files, no helper shapes, nothing adjusted.
    Translator(const schema::Scene& from, std::optional<std::filesystem::path> directory,
               const ImportOptions& options = {})
        : from_(from), directory_(std::move(directory)), options_(options) {}

    Scene run() {
        if (!directory_) refuseUnresolved();
        readFields(from_, "scene", context_, scene_);
        addTextures();
        addMaterials();
        addShapes();
        addLights();
        if (from_.has_environment()) addEnvironment(from_.environment());
        addModels();
        if (options_.camera && !hasModelCamera_)
            throw Error(ErrorCode::Input,
                        "--camera chooses among the cameras of a model file, and this scene uses none");
        addCamera();
        return std::move(scene_);
    }

private:
    void refuseUnresolved() const {
        bool files = !from_.environment().file().empty() || from_.model_size() > 0;
        for (const schema::Texture& texture : from_.texture()) files |= !texture.file().empty();
        if (files) throw Error(ErrorCode::Input, "a scene that was sent cannot refer to files");
        if (from_.quad_size() + from_.box_size() + from_.disk_size() + from_.ripple_grid_size() > 0)
            throw Error(ErrorCode::Input, "a scene that was sent may hold meshes and spheres only");
        if (!from_.has_camera()) throw Error(ErrorCode::Input, "a scene that was sent needs a camera");
    }

    std::string resolve(const std::string& file) const { return (*directory_ / file).string(); }

    void addTextures() {
        for (const schema::Texture& from : from_.texture()) {
            const std::string where = "texture '" + from.name() + "'";
            Texture texture;
            if (from.has_texels() == !from.file().empty()) failAt(where, "needs either file or texels");
            if (!from.has_texels()) texture = readTexture(resolve(from.file()), !from.linear(), scene_.notices);
            readFields(from, where, context_, texture);
            scene_.textures.push_back(std::move(texture));
            textures_.add(from.name());
        }
    }

    void addMaterials() {
        std::vector<std::string> notices;
        for (const schema::Material& from : from_.material()) {
            scene_.materials.push_back(readMaterial(from, context_, notices));
            materials_.add(from.name());
        }
        // A resolved scene states every field of every material, used or not.
        if (directory_) scene_.notices.insert(scene_.notices.end(), notices.begin(), notices.end());
    }

    void addMesh(Mesh mesh, const std::string& material, const char* kind) {
        const std::string where = std::string(kind) + " '" + mesh.name + "'";
        mesh.material = materials_.find(material, where + ": material");
        if (directory_) {
            checkMesh(mesh);
            if (mesh.triangles.empty()) failAt(where, "has no triangles");
            if (const size_t dropped = dropDegenerateTriangles(mesh))
                scene_.notices.push_back(where + ": " + std::to_string(dropped) +
                                         " triangles without area were dropped.");
            if (mesh.triangles.empty()) failAt(where, "has no area");
            normalizeNormals(mesh);
        }
        scene_.meshes.push_back(std::move(mesh));
    }

    void addShapes() {
        for (const auto& mesh : from_.mesh()) addMesh(makeMesh(mesh), mesh.material(), "mesh");
        for (const auto& quad : from_.quad()) addMesh(makeQuad(quad), quad.material(), "quad");
        for (const auto& box : from_.box()) addMesh(makeBox(box), box.material(), "box");
        for (const auto& disk : from_.disk()) addMesh(makeDisk(disk), disk.material(), "disk");
        for (const auto& grid : from_.ripple_grid()) addMesh(makeRippleGrid(grid), grid.material(), "ripple_grid");
        readList(from_, "sphere", context_, scene_.spheres);
    }

    void addLights() {
        forEachField(scene_, [&](auto field, auto& lights) {
            constexpr bool listed = isList<std::remove_cvref_t<decltype(lights)>>;
            if constexpr (field.role == Role::Light && listed) readList(from_, field.name, context_, lights);
        });
    }

    void addEnvironment(const schema::Environment& from) {
        if (from.has_map() && !from.file().empty()) failAt("environment", "needs either file or map, not both");
        Environment environment;
        if (!from.file().empty()) environment = readEnvironmentMap(resolve(from.file()));
        if (from.has_map()) environment.radiance = Vec3f(1.0f);
        readFields(from, "environment", context_, environment);
        scene_.environment = std::move(environment);
    }

    void addModels() {
        for (const schema::Model& from : from_.model()) {
            const std::string where = "model '" + from.file() + "': ";
            if (from.file().empty()) failAt("model", "needs a file");
            ImportOptions options = options_;
            if (!from.use_camera()) options.camera.reset();
            ImportedModel model = importModelParts(resolve(from.file()), options);
            place(model.scene, readTransform(from.transform(), where + "transform"));
            if (from.use_camera()) {
                if (!model.hasCamera) failAt(where + "use_camera", "is set, but the file has no camera");
                if (from_.has_camera() || hasModelCamera_)
                    failAt(where + "use_camera", "is set, but there is a camera");
                hasModelCamera_ = true;
                scene_.camera = model.scene.camera;
                if (!from_.has_image()) scene_.imageWidth = model.scene.imageWidth;
            }
            merge(std::move(model.scene), from, where);
        }
    }

    static void place(Scene& model, const Affine& map) {
        if (map == Affine{}) return;
        std::vector<Mesh> meshes = std::exchange(model.meshes, {});  // whose normals turn otherwise
        for (Mesh& mesh : meshes) transformMesh(mesh, map);
        forEach<Role::Position>(model, [&](Vec3f& p) { p = Vec3f(map.point(Vec3d(p))); });
        forEach<Role::Direction>(model, [&](Vec3f& v) { v = Vec3f(normalize(map.vector(Vec3d(v)))); });
        model.meshes = std::move(meshes);
    }

    void merge(Scene model, const schema::Model& from, const std::string& where) {
        const auto textureOffset = uint32_t(scene_.textures.size());
        for (Texture& texture : model.textures) scene_.textures.push_back(std::move(texture));
        std::vector<uint32_t> newIndex;
        for (Material& material : model.materials) {
            if (const auto replacement = findOverride(from, material.name, where)) {
                newIndex.push_back(*replacement);
                continue;
            }
            forEach<Role::Texture>(material, [&](uint32_t& index) { index += textureOffset; });
            newIndex.push_back(uint32_t(scene_.materials.size()));
            scene_.materials.push_back(std::move(material));
        }
        for (Mesh& mesh : model.meshes) {
            mesh.material = newIndex.at(mesh.material);
            scene_.meshes.push_back(std::move(mesh));
        }
        for (std::string& notice : model.notices) scene_.notices.push_back(from.file() + ": " + std::move(notice));
        if (from.without_lights()) return;
        forEachField(scene_, [&](auto field, auto& lights) {
            constexpr bool listed = isList<std::remove_cvref_t<decltype(lights)>>;
            if constexpr (field.role == Role::Light && listed) {
                const auto& added = model.*(field.member);
                lights.insert(lights.end(), added.begin(), added.end());
            }
        });
    }

    std::optional<uint32_t> findOverride(const schema::Model& from, const std::string& name,
                                         const std::string& where) const {
        for (const schema::MaterialOverride& entry : from.override())
            if (entry.replace() == name || entry.replace() == "*")
                return materials_.find(entry.material(), where + "override.material");
        return {};
    }

    void addCamera() {
        if (!from_.has_camera()) {
            if (!hasModelCamera_) addDefaultCamera(scene_);
            return;
        }
        readCamera(from_.camera(), context_, double(scene_.imageWidth) / scene_.imageHeight, scene_.camera);
    }

    const schema::Scene& from_;
    std::optional<std::filesystem::path> directory_;
    ImportOptions options_;
    NameTable textures_{"texture"}, materials_{"material"};
    const ReadContext context_{
        [this](const std::string& reference, const std::string& where) { return textures_.find(reference, where); },
        [this](const std::string& reference, const std::string& where) { return materials_.find(reference, where); },
        directory_.has_value()};
    bool hasModelCamera_ = false;
    Scene scene_;
};

}  // namespace

Scene resolveScene(const schema::Scene& scene, const std::filesystem::path& directory, const ImportOptions& options) {
    return Translator(scene, directory, options).run();
}

Scene fromProto(const schema::Scene& scene) { return Translator(scene, std::nullopt).run(); }

}  // namespace antipode
