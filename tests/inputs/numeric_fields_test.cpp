// Every number of the schema takes every bad value: the scene is refused by a sentence that names the object, or valid.
#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "proto/scene_loader.h"
#include "proto/scene_translation.h"
#include "renderengine/error.h"
#include "support/hard_case.h"
#include "tests/inputs/child_process.h"

namespace antipode::test {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

/// One object of each kind, every field of numbers set.
const char kEverything[] = R"(
    camera { position: [0, 0, 9] look_at: [0, 0, 0] up: [0, 1, 0] vertical_fov: 40 lens_radius: 0.1 focus_distance: 9 }
    image { width: 64 height: 48 }
    max_path_length: 12
    texture { name: "the_texture" texels { width: 1 height: 1 rgba: "abcd" } }
    material { name: "the_material" kind: METALLIC_ROUGHNESS base_color: [0.5, 0.5, 0.5] specular: [1, 1, 1]
               specular_factor: 1 phong_exponent: 9 roughness: 0.5 metallic: 0.5 ior: 1.5 abbe_number: 40
               conductor_eta: [1, 1, 1]
               conductor_k: [1, 1, 1] emission: [1, 1, 1] normal_scale: 1 alpha_cutoff: 0.5 }
    mesh { name: "the_mesh" material: "the_material" positions: [0, 0, 0, 1, 0, 0, 0, 1, 0]
           normals: [0, 0, 1, 0, 0, 1, 0, 0, 1] uvs: [0, 0, 1, 0, 0, 1] triangles: [0, 1, 2]
           transform { scale: [1, 2, 1] rotate { axis: [0, 0, 1] degrees: 30 } translate: [1, 2, 3] } }
    sphere { center: [0, 0, 0] radius: 1 material: "the_material" }
    quad { name: "the_quad" material: "the_material" corner: [0, 0, 0] edge_u: [1, 0, 0] edge_v: [0, 1, 0]
           uv_repeat: [1, 1] }
    box { name: "the_box" material: "the_material" low: [0, 0, 0] high: [1, 1, 1] transform { scale: [2] } }
    disk { name: "the_disk" material: "the_material" center: [0, 0, 0] normal: [0, 1, 0] radius: 1 segments: 5 }
    ripple_grid { name: "the_grid" material: "the_material" center: [0, 0, 0] size_x: 1 size_z: 1 cells_x: 3 cells_z: 3
                  wave { amplitude: 0.1 wavelength: 0.5 direction: 10 phase: 20 } }
    point_light { position: [0, 5, 0] intensity: [1, 1, 1] }
    spot_light { position: [0, 5, 0] direction: [0, -1, 0] intensity: [1, 1, 1] inner_half_angle: 10
                 outer_half_angle: 20 }
    directional_light { direction: [0, -1, 0] irradiance: [1, 1, 1] }
    environment { radiance: [1, 1, 1] map { width: 1 height: 1 rgb: [1, 1, 1] } rotation: 10 }
)";

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
const double kBadNumbers[] = {kNan,  kInf,   -kInf, 1e39, -1e39, 3e38, -3e38, 1e-46,
                              1e-40, -1e-30, 0,     -0.0, -1,    1e20, 1e300};
const uint32_t kBadCounts[] = {0, 1, 3, 65536, 0x7fffffff, 0x80000000, 0xffffffff};

struct Trial {
    std::string object, field;
    bool finite;  ///< whether the number put in is
    std::string text;
};

/// Sets element `index` of a field (−1: the field itself) to each bad value and keeps the text.
void collectField(const Message& whole, Message& parent, const FieldDescriptor& field, int index,
                  const std::string& object, std::vector<Trial>& trials) {
    const auto& reflection = *parent.GetReflection();
    const auto keep = [&](bool finite) {
        Trial trial{object, field.name(), finite, ""};
        google::protobuf::TextFormat::PrintToString(whole, &trial.text);
        trials.push_back(std::move(trial));
    };
    switch (field.cpp_type()) {
        case FieldDescriptor::CPPTYPE_FLOAT: {
            const float before =
                index < 0 ? reflection.GetFloat(parent, &field) : reflection.GetRepeatedFloat(parent, &field, index);
            const auto put = [&](float v) {
                index < 0 ? reflection.SetFloat(&parent, &field, v)
                          : reflection.SetRepeatedFloat(&parent, &field, index, v);
            };
            for (double bad : kBadNumbers) {
                const auto value = std::abs(bad) < 3.5e38 || bad != bad ? float(bad) : float(bad > 0 ? kInf : -kInf);
                put(value), keep(std::isfinite(value));
            }
            put(before);
            break;
        }
        case FieldDescriptor::CPPTYPE_DOUBLE: {
            const double before = reflection.GetDouble(parent, &field);
            for (double bad : kBadNumbers) reflection.SetDouble(&parent, &field, bad), keep(std::isfinite(bad));
            reflection.SetDouble(&parent, &field, before);
            break;
        }
        case FieldDescriptor::CPPTYPE_UINT32: {
            const uint32_t before =
                index < 0 ? reflection.GetUInt32(parent, &field) : reflection.GetRepeatedUInt32(parent, &field, index);
            const auto put = [&](uint32_t v) {
                index < 0 ? reflection.SetUInt32(&parent, &field, v)
                          : reflection.SetRepeatedUInt32(&parent, &field, index, v);
            };
            for (uint32_t bad : kBadCounts) put(bad), keep(true);
            put(before);
            break;
        }
        default: break;
    }
}

/// Every field of numbers below `message`, each with every bad value. `object`: how sentences name what it belongs to.
void collect(const Message& whole, Message& message, const std::string& object, std::vector<Trial>& trials) {
    const auto& reflection = *message.GetReflection();
    std::vector<const FieldDescriptor*> fields;
    reflection.ListFields(message, &fields);
    for (const FieldDescriptor* field : fields) {
        const int count = field->is_repeated() ? reflection.FieldSize(message, field) : 1;
        for (int i = 0; i < count; ++i) {
            const int index = field->is_repeated() ? i : -1;
            if (field->cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE) {
                collectField(whole, message, *field, index, object.empty() ? field->name() : object, trials);
                continue;
            }
            Message& below = field->is_repeated() ? *reflection.MutableRepeatedMessage(&message, field, i)
                                                  : *reflection.MutableMessage(&message, field);
            const FieldDescriptor* name = below.GetDescriptor()->FindFieldByName("name");
            const std::string called = !object.empty() ? object
                                       : name          ? below.GetReflection()->GetString(below, name)
                                                       : field->name();
            collect(whole, below, called, trials);
        }
    }
}

std::vector<Trial> allTrials() {
    schema::Scene everything;
    if (!google::protobuf::TextFormat::ParseFromString(kEverything, &everything)) return {};
    std::vector<Trial> trials;
    collect(everything, everything, "", trials);
    return trials;
}

/// "" or what is wrong with how the trial ended.
std::string judge(const Trial& trial) {
    try {
        checkedHash(parseScene(trial.text, "t.textproto", "."));
        // validate() has seen the scene, so whatever is not finite in it must have been the field of a shape.
        return trial.finite ? "" : "a number that is not finite was taken";
    } catch (const Error& e) {
        std::string sentence = e.what(), spaced = trial.object;
        std::replace(spaced.begin(), spaced.end(), '_', ' ');
        if (e.code() != ErrorCode::Input) return "not an input error: " + sentence;
        if (!sentence.starts_with("t.textproto: ")) return "the file is not named: " + sentence;
        if (sentence.find(trial.object) == std::string::npos && sentence.find(spaced) == std::string::npos)
            return "the object is not named: " + sentence;
        return "";
    }
}

TEST(NumericFields, TheSceneOfTheTestIsSound) {
    EXPECT_NO_THROW(checkedHash(parseScene(kEverything, "t.textproto", ".")));
}

TEST(NumericFields, TakeNoHarmFromAnyValue) {
    const std::vector<Trial> trials = allTrials();
    EXPECT_GT(trials.size(), 1000u);
    RecordProperty("trials", int(trials.size()));
    size_t begin = 0;
    while (begin < trials.size()) {  // one child per field
        size_t end = begin;
        while (end < trials.size() && trials[end].object == trials[begin].object &&
               trials[end].field == trials[begin].field)
            ++end;
        const Outcome outcome = runInChild([&] {
            std::string objections;
            for (size_t i = begin; i < end; ++i)
                if (const std::string objection = judge(trials[i]); !objection.empty())
                    objections += "\n  " + objection;
            return objections;
        });
        SCOPED_TRACE(::testing::Message() << trials[begin].object << ": " << trials[begin].field << ": " << outcome);
        expectWithin({"Bad input", "NaN, infinities, 0, −1, 10³⁹, 2³¹ … in every numeric field of a scene",
                      "fields that give neither a sound scene nor one clear sentence", 0},
                     !(outcome.ending == Ending::Returned && outcome.text.empty() && outcome.output.empty()));
        begin = end;
    }
}

}  // namespace
}  // namespace antipode::test
