#include "techniques/technique.h"

#include <array>

#include "kernels/shared/layout.h"
#include "renderengine/error.h"

namespace antipode {
namespace {

using namespace shared;

struct TableRow {
    const char* name;
    uint32_t terms;
    const char* description;
};

constexpr uint32_t bidirectional = TERM_HIT | TERM_NEXT_EVENT | TERM_CONNECT | TERM_SPLAT;

/// What needs paths from the lights.
constexpr uint32_t lightPathTerms = TERM_SPLAT | TERM_CONNECT | TERM_MERGE;

constexpr std::array<TableRow, 7> table{{
    {"vcm", bidirectional | TERM_MERGE, "vertex connection and merging: all techniques, combined by MIS"},
    {"bpt", bidirectional, "bidirectional path tracing: everything but merging"},
    {"pt", TERM_HIT | TERM_NEXT_EVENT, "path tracing with next-event estimation and MIS"},
    {"pt-naive", TERM_HIT, "path tracing that meets emitters by chance"},
    {"lt", TERM_HIT | TERM_SPLAT | TERM_FIRST_DIFFUSE,
     "light tracing; emitters seen directly or in mirrors by camera paths"},
    {"ppm", TERM_HIT | TERM_MERGE | TERM_FIRST_DIFFUSE,
     "progressive photon mapping: merges at the first non-specular vertex"},
    {"bpm", TERM_HIT | TERM_MERGE, "bidirectional photon mapping: merges at every vertex, combined by MIS"},
}};

uint32_t singleTerms(const SingleTechnique& single) {
    if (single.merge) {
        if (single.s < 2 || single.t < 2)
            throw Error(ErrorCode::Usage,
                        "a merge joins a light and a camera vertex on surfaces: s and t must be at least 2");
        return TERM_SINGLE | TERM_MERGE;
    }
    if (single.t == 0 || single.s + single.t < 2)
        throw Error(ErrorCode::Usage, "no technique has s = " + std::to_string(single.s) + ", t = " +
                                          std::to_string(single.t) + ": a path needs a camera vertex and an edge");
    if (single.s == 0) return TERM_SINGLE | TERM_HIT;
    if (single.t == 1) return TERM_SINGLE | TERM_SPLAT;
    return TERM_SINGLE | (single.s == 1 ? TERM_NEXT_EVENT : TERM_CONNECT);
}

uint32_t termsOf(const RenderSettings& settings) {
    if (settings.single) return singleTerms(*settings.single);
    std::string names;
    for (const TableRow& row : table) {
        if (settings.technique == row.name) return row.terms;
        names += names.empty() ? row.name : std::string(", ") + row.name;
    }
    throw Error(ErrorCode::Usage, "unknown technique '" + settings.technique + "'; the techniques are " + names);
}

}  // namespace

const std::vector<TechniqueInfo>& techniqueTable() {
    static const std::vector<TechniqueInfo> infos = [] {
        std::vector<TechniqueInfo> all;
        for (const TableRow& row : table) all.push_back({row.name, row.description, (row.terms & lightPathTerms) != 0});
        return all;
    }();
    return infos;
}

TechniquePlan planTechnique(const RenderSettings& settings, bool hasMeetableEmitters) {
    TechniquePlan plan;
    plan.terms = termsOf(settings);
    if (settings.russianRoulette) plan.terms |= TERM_ROULETTE;
    if (!hasMeetableEmitters) plan.terms &= ~TERM_HIT;
    plan.lightPaths = (plan.terms & lightPathTerms) != 0;
    plan.cameraPaths =
        (plan.terms & (TERM_HIT | TERM_NEXT_EVENT | TERM_CONNECT | TERM_MERGE)) != 0 || settings.layers.hasGuides();
    return plan;
}

}  // namespace antipode
