// Whatever walks the tables of fields sees every field, and does with it what its role says.
#include "scene/scene_fields.h"

#include <cstring>
#include <map>
#include <set>

#include "proto/scene_loader.h"
#include "proto/scene_translation.h"
#include "scene/origin.h"
#include "scene/units.h"
#include "tests/scene/full_scene.h"
#include "tests/scene/model_files.h"

namespace antipode {
namespace {

/// fullScene() with a second texture, so that every index can be another one.
Scene sceneOfTwoTextures() {
    Scene scene = testing::fullScene();
    scene.textures.push_back(scene.textures[0]);
    return scene;
}

/// Calls visit(path, field, value) for every field of the object and its parts: "point_light#0.position".
template <class S, class Visit>
void forEachLeaf(S& object, const std::string& path, const Visit& visit) {
    forEachField(object, [&](auto field, auto& value) {
        if constexpr (HasFields<Entry<decltype(value)>>) {
            size_t index = 0;
            forEachEntry(value, [&](auto& part) {
                forEachLeaf(part, path + field.name + "#" + std::to_string(index++) + ".", visit);
            });
        } else {
            visit(path + field.name, field, value);
        }
    });
}

// Another value of the same kind.
void change(float& v, Role) { v += 0.25f; }
void change(Vec3f& v, Role) { v.y += 0.25f; }
void change(std::array<float, 2>& v, Role) { v[1] += 0.25f; }
void change(std::array<float, 4>& v, Role) { v[3] += 0.125f; }
void change(std::array<uint32_t, 3>& v, Role) { v[2] += 1; }
void change(uint8_t& v, Role) { v ^= 1; }
void change(bool& v, Role) { v = !v; }
void change(std::string& v, Role) { v += "x"; }
void change(uint32_t& v, Role role) { v = role == Role::Texture || role == Role::Material ? v ^ 1 : v + 1; }
template <class E>
requires std::is_enum_v<E>
void change(E& v, Role) { v = E(int(v) == 0 ? 1 : int(v) - 1); }

using Values = std::map<std::string, std::string>;

std::string bytesOf(const std::string& v) { return v; }
template <class V>
std::string bytesOf(const V& v) {
    std::string bytes(sizeof v, 0);
    std::memcpy(bytes.data(), &v, sizeof v);
    return bytes;
}

/// The bytes of every field, by its path.
Values valuesOf(const Scene& scene) {
    Values values;
    forEachLeaf(scene, "", [&](const std::string& path, auto, const auto& value) {
        std::string& bytes = values[path];
        forEachEntry(value, [&](const auto& entry) { bytes += bytesOf(entry); });
    });
    return values;
}

/// Notes of every list and optional in the object and its parts whether one of its kind holds something.
template <class S>
void noteHeld(const S& object, const std::string& path, std::map<std::string, bool>& held) {
    forEachField(object, [&](auto field, const auto& value) {
        using Value = std::remove_cvref_t<decltype(value)>;
        if constexpr (isList<Value> || isOptional<Value>) held[path + field.name];
        forEachEntry(value, [&](const auto& entry) {
            if constexpr (isList<Value> || isOptional<Value>) held[path + field.name] = true;
            if constexpr (HasFields<std::remove_cvref_t<decltype(entry)>>)
                noteHeld(entry, path + field.name + ".", held);
        });
    });
}

TEST(SceneFields, TheFullSceneHoldsSomethingOfEach) {
    // What it lacks no test here would see.
    std::map<std::string, bool> held;
    noteHeld(testing::fullScene(), "", held);
    EXPECT_GE(held.size(), 25u);
    for (const auto& [path, holds] : held) EXPECT_TRUE(holds) << path;
}

TEST(SceneFields, HashMessageAndRoundTripSeeEveryOne) {
    const Scene original = sceneOfTwoTextures();
    const size_t count = valuesOf(original).size();
    EXPECT_GE(count, 90u);
    for (size_t changed = 0; changed < count; ++changed) {
        Scene scene = original;
        std::string path;
        bool named = false;
        size_t at = 0;
        forEachLeaf(scene, "", [&](const std::string& leaf, auto field, auto& value) {
            if (at++ != changed) return;
            constexpr Role role = field.role;
            path = leaf, named = role == Role::Name;
            bool first = true;
            forEachEntry(value, [&](auto& entry) {
                if (std::exchange(first, false)) change(entry, role);
            });
            if (first) path.clear();  // an empty list, of which another scene's mesh has some
        });
        if (path.empty()) continue;
        SCOPED_TRACE(path);
        EXPECT_NE(valuesOf(scene), valuesOf(original));
        EXPECT_EQ(sceneHash(scene) == sceneHash(original), named);
        EXPECT_NE(toProto(scene).SerializeAsString(), toProto(original).SerializeAsString());
        EXPECT_EQ(valuesOf(fromProto(toProto(scene))), valuesOf(scene));
    }
}

TEST(SceneFields, NoMemberHasTwoRows) {
    // A table has as many rows as its struct has members, or it would not compile.
    struct Struct {
        int a;
        std::array<int, 2> b;
        std::string c;
    };
    static_assert(memberCount<Struct>() == 3);
    const Scene scene = sceneOfTwoTextures();
    std::set<const void*> members;
    size_t leaves = 0;
    forEachLeaf(scene, "", [&](const std::string&, auto, const auto& value) { members.insert(&value), ++leaves; });
    EXPECT_EQ(members.size(), leaves);
}

TEST(SceneFields, NamesAndRolesAgree) {
    const std::pair<const char*, Role> meanings[] = {
        {"position", Role::Position}, {"center", Role::Position},     {"direction", Role::Direction},
        {"forward", Role::Direction}, {"normals", Role::Direction},   {"radius", Role::Length},
        {"distance", Role::Length},   {"angle", Role::Angle},         {"fov", Role::Angle},
        {"rotation", Role::Angle},    {"intensity", Role::Intensity}, {"irradiance", Role::Irradiance},
        {"emission", Role::Radiance}, {"material", Role::Material},
    };
    std::set<std::string> found;
    const Scene scene = sceneOfTwoTextures();
    forEachLeaf(scene, "", [&](const std::string& path, auto field, const auto&) {
        const std::string name = path.substr(path.rfind('.') + 1);
        for (const auto& [word, role] : meanings)
            if (name == word || name == std::string(word) + "s" || name.ends_with(std::string("_") + word)) {
                EXPECT_EQ(field.role, role) << path;
                found.insert(word);
            }
        if (name.ends_with("_texture")) {
            EXPECT_EQ(field.role, Role::Texture) << path;
        }
    });
    EXPECT_EQ(found.size(), std::size(meanings));
}

TEST(SceneFields, PositionsMove) {
    const Scene scene = sceneOfTwoTextures();
    Scene expected = scene;
    forEachLeaf(expected, "", [](const std::string&, auto field, auto& value) {
        if constexpr (field.role == Role::Position)
            forEachEntry(value, [](Vec3f& p) { p = Vec3f(Vec3d(p) - Vec3d(1, 2, 4)); });
    });
    EXPECT_NE(valuesOf(expected), valuesOf(scene));
    EXPECT_EQ(valuesOf(movedToOrigin(scene, {1, 2, 4})), valuesOf(expected));
}

TEST(SceneFields, LengthsAndIntensitiesScale) {
    const Scene scene = sceneOfTwoTextures();
    Scene expected = scene;
    forEachLeaf(expected, "", [](const std::string&, auto field, auto& value) {
        if constexpr (field.role == Role::Position || field.role == Role::Length)
            forEachEntry(value, [](auto& length) { length *= 8; });
        if constexpr (field.role == Role::Intensity) forEachEntry(value, [](Vec3f& power) { power *= 64; });
    });
    EXPECT_NE(valuesOf(expected), valuesOf(scene));
    EXPECT_EQ(valuesOf(inUnits(scene, 3)), valuesOf(expected));
}

TEST(SceneFields, NoNumberMayBeNan) {
    const Scene original = sceneOfTwoTextures();
    EXPECT_NO_THROW(validate(original));
    const size_t count = valuesOf(original).size();
    size_t spoiled = 0;
    for (size_t changed = 0; changed < count; ++changed) {
        Scene scene = original;
        std::string path;
        size_t at = 0;
        forEachLeaf(scene, "", [&](const std::string& leaf, auto, auto& value) {
            if (at++ != changed) return;
            forEachEntry(value, [&](auto& entry) {
                using Value = std::remove_cvref_t<decltype(entry)>;
                if constexpr (std::is_same_v<Value, float> || std::is_same_v<Value, Vec3f>)
                    entry = Value(std::numeric_limits<float>::quiet_NaN()), path = leaf;
            });
        });
        if (path.empty()) continue;
        ++spoiled;
        const std::string sentence = testing::inputErrorOf([&] { validate(scene); });
        std::string name = path.substr(path.rfind('.') + 1);
        if (path.starts_with("mesh")) name = name.substr(0, name.size() - 1) + " 0";  // "positions"
        EXPECT_NE(sentence.find(name), std::string::npos) << path << ": " << sentence;
    }
    EXPECT_GE(spoiled, 50u);
}

/// The schema's fields that have no row.
void collectRowless(const google::protobuf::Descriptor& message, const std::set<std::string>& rows,
                    std::set<std::string>& rowless) {
    for (int i = 0; i < message.field_count(); ++i) {
        const std::string& name = message.field(i)->name();
        if (!rows.contains(name)) rowless.insert(message.name() + "." + name);
    }
}

template <class S>
void collectRowless(const google::protobuf::Descriptor& message, std::set<std::string>& rowless) {
    S object;
    std::set<std::string> rows;
    forEachField(object, [&](auto field, const auto& value) {
        const std::string name = field.name, outer = name.substr(0, name.find('.'));
        rows.insert(outer);
        const auto* descriptor = message.FindFieldByName(outer);
        ASSERT_TRUE(descriptor) << message.name() << "." << name;
        if (outer != name) {
            EXPECT_TRUE(descriptor->message_type()->FindFieldByName(name.substr(outer.size() + 1))) << name;
        }
        if constexpr (HasFields<Entry<decltype(value)>>)
            collectRowless<Entry<decltype(value)>>(*descriptor->message_type(), rowless);
    });
    collectRowless(message, rows, rowless);
}

TEST(SceneFields, TheSchemaHasNoOthersButForPeople) {
    std::set<std::string> rowless;
    collectRowless<Scene>(*schema::Scene::descriptor(), rowless);
    EXPECT_EQ(rowless,
              (std::set<std::string>{"Camera.f_stop", "Camera.focal_length", "Camera.look_at", "Camera.sensor_width",
                                     "Environment.file", "Mesh.transform", "Scene.box", "Scene.disk", "Scene.model",
                                     "Scene.quad", "Scene.ripple_grid", "Texture.file"}));
}

}  // namespace
}  // namespace antipode
