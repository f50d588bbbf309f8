#include "proto/scene_changes.h"

#include <filesystem>

#include "proto/field_path.h"
#include "proto/name_table.h"
#include "proto/schema_camera.h"
#include "proto/schema_fields.h"
#include "renderengine/error.h"
#include "scene/environment_map.h"
#include "scene/image_decode.h"

namespace antipode {
namespace {

/// Whether the engine's scene has what the path begins with, and no transform, which is applied by then.
bool isOfRenderedScene(const std::string& path) {
    const std::string head = path.substr(0, path.find_first_of(".["));
    bool found = false;
    const Scene scene;
    forEachField(scene, [&](auto field, const auto&) {
        const std::string name = field.name;
        found |= name.substr(0, name.find('.')) == head;
    });
    return found && path.find(".transform.") == path.npos;
}

/// The message's fields, and what they refer to; arrays that it does not have stay.
class RenderedSceneChange {
public:
    RenderedSceneChange(const schema::Scene& from, Scene& scene) : from_(from), scene_(scene) {
        for (const schema::Texture& texture : from.texture()) textures_.add(texture.name());
        for (const schema::Material& material : from.material()) materials_.add(material.name());
    }

    void run() {
        readFields(from_, "scene", context_, scene_);
        forEachField(scene_, [&](auto field, auto& value) {
            using Value = std::remove_cvref_t<decltype(value)>;
            if constexpr (HasFields<Entry<Value>> && isList<Value>) readEntries(field.name, value);
        });
        if (from_.has_environment()) readEnvironment(from_.environment());
        readCamera(from_.camera(), context_, double(scene_.imageWidth) / scene_.imageHeight, scene_.camera);
    }

private:
    template <class S>
    void readEntries(const char* name, std::vector<S>& entries) {
        const auto* list = from_.GetDescriptor()->FindFieldByName(name);
        entries.resize(size_t(from_.GetReflection()->FieldSize(from_, list)));
        for (size_t i = 0; i < entries.size(); ++i) {
            const auto& message = from_.GetReflection()->GetRepeatedMessage(from_, list, int(i));
            const std::string where = std::string(name).append(" #").append(std::to_string(i));
            if constexpr (std::is_same_v<S, Texture>)
                if (const auto& texture = static_cast<const schema::Texture&>(message); !texture.file().empty())
                    entries[i] = readTexture(texture.file(), !texture.linear(), scene_.notices);
            readFields(message, where, context_, entries[i]);
        }
    }

    void readEnvironment(const schema::Environment& from) {
        Environment environment = scene_.environment.value_or(Environment());
        if (!from.file().empty()) environment = readEnvironmentMap(from.file());
        readFields(from, "environment", context_, environment);
        scene_.environment = std::move(environment);
    }

    const schema::Scene& from_;
    Scene& scene_;
    NameTable textures_{"texture"}, materials_{"material"};
    const ReadContext context_{
        [this](const std::string& reference, const std::string& where) { return textures_.find(reference, where); },
        [this](const std::string& reference, const std::string& where) { return materials_.find(reference, where); },
        true};
};

}  // namespace

SceneChanges changeWritten(const SceneChanges& changes, schema::Scene& scene) {
    if (changes.environmentFile) {
        scene.clear_environment();
        scene.mutable_environment()->set_file(std::filesystem::absolute(*changes.environmentFile).string());
    }
    SceneChanges left;
    for (const FieldChange& change : changes.fields) {
        const bool done = setField(scene, change.path, change.value, Missing::Skipped);
        // "material.*" is of those that models bring, too.
        const bool more = change.path.find(".*.") != change.path.npos && isOfRenderedScene(change.path);
        if (!done || more) left.fields.push_back(change);
    }
    return left;
}

void changeScene(const SceneChanges& changes, Scene& scene) {
    if (changes.environmentFile) scene.environment = readEnvironmentMap(*changes.environmentFile);
    if (changes.fields.empty()) return;
    schema::Scene message = toProto(scene, Arrays::LeftOut);
    message.clear_notice();                            // they would be added again
    message.mutable_camera()->clear_focus_distance();  // look_at sets it where nothing else does
    for (const FieldChange& change : changes.fields) {
        if (!isOfRenderedScene(change.path)) {
            schema::Scene nothing;
            setField(nothing, change.path, change.value, Missing::Created);  // knows of a field that does not exist
            throw Error(ErrorCode::Usage, "--set " + change.path + " finds nothing: the scene has no such object.");
        }
        setField(message, change.path, change.value, Missing::Created);
    }
    RenderedSceneChange(message, scene).run();
}

}  // namespace antipode
