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

constexpr std::array<uint32_t, transports> termOf{TERM_NEXT_EVENT, TERM_SPLAT, TERM_CONNECT, TERM_MERGE};

TransportSet transportsIn(uint32_t terms) {
    TransportSet found;
    for (uint32_t i = 0; i < transports; ++i)
        if ((terms & termOf[i]) != 0) found.add(Transport(i));
    return found;
}

/// The weights renormalise over what remains, since what is left out has no sample count.
uint32_t leftOver(uint32_t terms, const RenderSettings& settings) {
    for (const TransportInfo& info : transportTable()) {
        if (!settings.without.has(info.transport)) continue;
        const uint32_t term = termOf[size_t(info.transport)];
        if ((terms & term) == 0)
            throw Error(ErrorCode::Usage,
                        "the technique " + settings.technique + " has no " + info.option + " that could be left out");
        terms &= ~term;
    }
    return terms;
}

uint32_t termsOf(const RenderSettings& settings) {
    if (settings.single) return singleTerms(*settings.single);
    std::string names;
    for (const TableRow& row : table) {
        if (settings.technique == row.name) return leftOver(row.terms, settings);
        names += names.empty() ? row.name : std::string(", ") + row.name;
    }
    throw Error(ErrorCode::Usage, "unknown technique '" + settings.technique + "'; the techniques are " + names);
}

}  // namespace

const std::vector<TechniqueInfo>& techniqueTable() {
    static const std::vector<TechniqueInfo> infos = [] {
        std::vector<TechniqueInfo> all;
        all.reserve(std::size(table));
        for (const TableRow& row : table)
            all.push_back({row.name, row.description, (row.terms & lightPathTerms) != 0, transportsIn(row.terms)});
        return all;
    }();
    return infos;
}

const std::vector<TransportInfo>& transportTable() {
    static const std::vector<TransportInfo> table{
        {Transport::NextEvent, "next-event", "camera vertices look for points drawn on the lights"},
        {Transport::LightTracing, "light-tracing", "light vertices look for the camera"},
        {Transport::Connections, "connections", "camera vertices look for stored light vertices"},
        {Transport::Merging, "merging", "camera vertices take in the light vertices around them"},
    };
    return table;
}

std::string described(const PixelWindow& w) {
    return std::to_string(w.x0) + "," + std::to_string(w.y0) + "," + std::to_string(w.x1) + "," + std::to_string(w.y1);
}

std::string name(TransportSet set) { return namesOf(set, transportTable()); }

TechniquePlan planTechnique(const RenderSettings& settings, bool hasMeetableEmitters) {
    TechniquePlan plan;
    plan.terms = termsOf(settings);
    if (settings.russianRoulette) plan.terms |= TERM_ROULETTE;
    if (settings.sampler == Sampler::Sobol) plan.terms |= TERM_SOBOL;
    if (!hasMeetableEmitters) plan.terms &= ~TERM_HIT;
    plan.lightPaths = (plan.terms & lightPathTerms) != 0;
    plan.cameraPaths =
        (plan.terms & (TERM_HIT | TERM_NEXT_EVENT | TERM_CONNECT | TERM_MERGE)) != 0 || hasGuides(settings.layers);
    return plan;
}

bool merges(const RenderSettings& settings) { return (termsOf(settings) & TERM_MERGE) != 0; }

bool makes(const TechniquePlan& plan, const PathClass& paths) {
    const auto has = [&](uint32_t term) { return (plan.terms & term) != 0; };
    // Camera paths that end at the first scattering vertex count emitters before it alone; those that take from light
    // paths by merges only, at surfaces, go on through media.
    const bool ends = has(TERM_FIRST_DIFFUSE) && (!paths.mediaAlone || has(TERM_SPLAT));
    const bool meets = has(TERM_HIT) && !paths.sizeless && !(paths.scattered && ends);
    if (meets || !paths.scattered) return meets;
    return (has(TERM_MERGE) && !paths.mediaAlone) || (has(TERM_NEXT_EVENT) && !paths.specularStart) ||
           (has(TERM_SPLAT) && !paths.specularEnd) || (has(TERM_CONNECT) && paths.adjacent);
}

}  // namespace antipode
