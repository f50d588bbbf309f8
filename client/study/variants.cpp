#include "client/study/variants.h"

#include <algorithm>
#include <set>
#include <sstream>

#include "renderengine/error.h"
#include "renderengine/io/suggest.h"

namespace antipode::study {
namespace {

/// A row of the table of knobs. To add one, add a row.
struct Knob {
    const char *name, *label;
    const char* against;  ///< another knob; nullptr for the technique that all knobs are turned on
    void (*turn)(RenderSettings&);
};

constexpr uint32_t fixedLength = 10;

constexpr Knob knobs[] = {
    {"double", "Double precision", nullptr, [](RenderSettings& s) { s.precision = Precision::Double; }},
    {"independent", "Independent random numbers", nullptr, [](RenderSettings& s) { s.sampler = Sampler::Independent; }},
    {"half-radius", "Half the first merge radius", nullptr, [](RenderSettings& s) { s.radiusFactor = 0.5; }},
    {"twice-radius", "Twice the first merge radius", nullptr, [](RenderSettings& s) { s.radiusFactor = 2; }},
    {"alpha-half", "A radius that shrinks faster (alpha 0.5)", nullptr, [](RenderSettings& s) { s.alpha = 0.5; }},
    {"alpha-one", "A radius that never shrinks (alpha 1)", nullptr, [](RenderSettings& s) { s.alpha = 1; }},
    {"quarter-light-paths", "A quarter of the light paths", nullptr,
     [](RenderSettings& s) { s.lightPathCount = std::max<uint64_t>(1, uint64_t(s.width) * s.height / 4); }},
    {"connections-4", "Four connections at each vertex", nullptr,
     [](RenderSettings& s) { s.connectionsPerVertex = 4; }},
    {"length-3", "Paths of at most 3 edges", nullptr, [](RenderSettings& s) { s.maxPathLength = 3; }},
    {"length-6", "Paths of at most 6 edges", nullptr, [](RenderSettings& s) { s.maxPathLength = 6; }},
    {"length-10", "Paths of at most 10 edges", nullptr, [](RenderSettings& s) { s.maxPathLength = fixedLength; }},
    {"no-roulette", "No Russian roulette (10 edges)", "length-10",
     [](RenderSettings& s) { s.maxPathLength = fixedLength, s.russianRoulette = false; }},
};

}  // namespace

std::vector<Variant> allVariants(const std::string& base) {
    std::vector<Variant> variants;
    for (const TechniqueInfo& technique : techniqueTable()) {
        if (technique.name == "pt-naive" && technique.name != base) continue;  // a check on others, nobody's choice
        Variant variant{technique.name, technique.name, technique.name == base ? "" : base, true, {}};
        variant.settings.technique = technique.name;
        variants.insert(technique.name == base ? variants.begin() : variants.end(), variant);
    }
    for (const Knob& knob : knobs) {
        Variant variant{knob.name, knob.label, knob.against ? knob.against : base, false, {}};
        variant.settings.technique = base;
        variants.push_back(variant);
    }
    return variants;
}

void turnKnob(const std::string& name, RenderSettings& settings) {
    for (const Knob& knob : knobs)
        if (name == knob.name) knob.turn(settings);
}

std::vector<Variant> chooseVariants(const std::string& base, const std::string& list) {
    const std::vector<Variant> all = allVariants(base);
    std::vector<std::string> names{"all", "techniques"};
    for (const Variant& variant : all) names.push_back(variant.name);
    std::set<std::string> chosen{base};
    std::istringstream parts(list + ",");
    for (std::string name; std::getline(parts, name, ',');) {
        if (std::find(names.begin(), names.end(), name) == names.end())
            throw Error(ErrorCode::Usage, "--knobs takes some of " + joined(names) + ", parted by commas, not '" +
                                              name + "'." + suggestion(name, names));
        for (const Variant& variant : all)
            if (name == "all" || (name == "techniques" && variant.technique) || name == variant.name)
                chosen.insert({variant.name, variant.against.empty() ? base : variant.against});
    }
    std::vector<Variant> result;
    for (const Variant& variant : all)
        if (chosen.contains(variant.name)) result.push_back(variant);
    return result;
}

}  // namespace antipode::study
