#include "client/explanation.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "renderengine/io/suggest.h"
#include "terminal/text.h"

namespace antipode {
namespace {

uint64_t triangleCount(const Scene& scene) {
    uint64_t triangles = 0;
    for (const Mesh& mesh : scene.meshes) triangles += mesh.triangles.size();
    return triangles;
}

std::string counted(uint64_t number, const std::string& one, const std::string& many) {
    return shortCount(double(number)) + " " + (number == 1 ? one : many);
}

/// Columns that the text takes in a terminal: its code points.
size_t columns(const std::string& text) {
    return size_t(std::ranges::count_if(text, [](char c) { return (uint8_t(c) & 0xC0) != 0x80; }));
}

std::string padded(const std::string& text, size_t width) {
    return text + std::string(width - std::min(width, columns(text)), ' ');
}

/// The classes that words stand for, in a row each.
std::vector<LightRow> lightRows(const LightPathFacts& facts, const RenderSettings& settings,
                                const std::vector<std::string>& techniques) {
    std::vector<LightRow> rows;
    for (const PathClass& c : pathClasses(facts, settings.maxPathLength)) {
        auto row = std::ranges::find(rows, c.words(), &LightRow::words);
        if (row == rows.end())
            row = rows.insert(rows.end(), {c.words(), c.expression(), std::vector<bool>(techniques.size(), true)});
        else
            row->paths += ", " + c.expression();
        for (size_t i = 0; i < techniques.size(); ++i) {
            RenderSettings other = settings;
            other.technique = techniques[i];
            other.without = {};
            if (std::ranges::count(missingClasses(facts, other), c) > 0) row->techniques[i] = false;
        }
    }
    return rows;
}

class Page {
public:
    explicit Page(bool styled) : styled_(styled) {}

    std::string bold(const std::string& text) const { return styled_ ? "\x1b[1m" + text + "\x1b[0m" : text; }
    std::string dim(const std::string& text) const { return styled_ ? "\x1b[2m" + text + "\x1b[0m" : text; }
    void line(const std::string& text = "") {
        text_ += text;
        text_.erase(text_.find_last_not_of(' ') + 1);
        text_ += '\n';
    }
    void heading(const std::string& text, const std::string& aside = "") {
        line();
        line(bold(text) + (aside.empty() ? "" : "  " + dim(aside)));
    }
    /// Words as long lines break, behind an indent.
    void paragraph(const std::string& words, size_t indent) {
        constexpr size_t width = 92;
        std::string current(indent, ' ');
        for (size_t from = 0; from < words.size();) {
            size_t to = words.find(' ', from);
            if (to == std::string::npos) to = words.size();
            const std::string word = words.substr(from, to - from);
            if (columns(current) > indent && columns(current) + 1 + columns(word) > width) {
                line(current);
                current.assign(indent, ' ');
            }
            current += (columns(current) > indent ? " " : "") + word;
            from = to + 1;
        }
        line(current);
    }
    const std::string& text() const { return text_; }

private:
    bool styled_;
    std::string text_;
};

void showEffects(const Explanation& e, Page& page) {
    page.heading("What the scene has");
    const char* group = "";
    std::string absent;
    for (const SceneEffect& effect : e.effects) {
        if (!effect.present) {
            if (!absent.empty()) absent += ", ";
            absent += effect.name;
            continue;
        }
        const bool first = std::string(group) != name(effect.group);
        group = name(effect.group);
        page.line("  " + padded(first ? group : "", 10) + padded(effect.name, 38) + page.dim(effect.meaning));
    }
    page.heading("What is not simulated",
                 "nothing in the scene calls for it: it has no code in the kernels and no memory");
    page.paragraph(absent, 2);
}

void showLight(const Explanation& e, Page& page) {
    constexpr size_t pathsWidth = 20;
    size_t wordsWidth = 46;
    const std::string mirrored = ", seen in mirrors or through glass";
    const auto cell = [](const std::string& technique, const std::string& text) {
        return padded(text, std::max<size_t>(5, technique.size() + 2));
    };
    const auto shown = [&](const LightRow& row) {
        return row.words.ends_with(mirrored) ? "   … seen in mirrors or through glass" : row.words;
    };
    for (const LightRow& row : e.light) wordsWidth = std::max(wordsWidth, columns(shown(row)) + 2);
    std::string names;
    for (const std::string& technique : e.techniques) names += cell(technique, technique);
    page.heading(padded("Light that it can have, and what renders it", wordsWidth + pathsWidth + 2) + names);
    for (const LightRow& row : e.light) {
        std::string cells;
        for (size_t i = 0; i < row.techniques.size(); ++i)
            cells += cell(e.techniques[i], row.techniques[i] ? "●" : "·");
        page.line("  " + padded(shown(row), wordsWidth) + page.dim(padded(row.paths, pathsWidth)) + cells);
    }
    page.line(
        page.dim("  ● renders it   · does not: its image lacks it   "
                 "(L lamp, D scattering, M in a medium, S mirror or glass, E camera)"));
}

std::string bar(double share) {
    std::string text;
    for (long i = 0; i < std::lround(share * 40); ++i) text += "█";
    return text;
}

std::string formatted(const char* format, double value) {
    char text[32];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

void showCosts(const SceneCosts& costs, const std::string& technique, Page& page) {
    const double whole = costs.iterationSeconds();
    page.heading("Where the time of an iteration goes", technique + ", " + std::to_string(costs.width) + "×" +
                                                            std::to_string(costs.height) + ", " +
                                                            formatted("%.1f ms", 1e3 * whole) + " on " + costs.device);
    for (const PartCost& part : costs.parts)
        page.line("  " + padded(part.name, 34) + formatted("%5.1f ms", 1e3 * part.seconds) +
                  formatted("%5.0f %%  ", 100 * part.seconds / whole) + bar(part.seconds / whole));
    if (costs.effects.empty()) return;
    page.heading("What effects add to it", "an iteration with and without them, in turns");
    for (const EffectCost& effect : costs.effects) {
        const std::string share = formatted("%+5.0f %%", 100 * (effect.ratio - 1));
        page.line("  " + padded(effect.name, 34) +
                  (effect.low <= 1 && effect.high >= 1
                       ? page.dim("nothing that could be measured")
                       : formatted("%5.1f ms", 1e3 * costs.iterationSeconds() * (1 - 1 / effect.ratio)) + share));
    }
}

}  // namespace

Explanation explainScene(const Scene& scene, const RenderSettings& settings) {
    Explanation e;
    e.scene = scene.name;
    e.triangles = triangleCount(scene);
    e.spheres = scene.spheres.size();
    for (const LightCount& lights : lightCounts(scene)) e.lamps += lights.number;
    e.width = settings.width;
    e.height = settings.height;
    e.technique = settings.technique;
    for (const TechniqueInfo& technique : techniqueTable()) e.techniques.push_back(technique.name);
    e.light = lightRows(lightPathFacts(scene), settings, e.techniques);
    e.effects = sceneEffects(scene);
    return e;
}

std::string explanationText(const Explanation& e, bool styled) {
    Page page(styled);
    std::string size = counted(e.triangles, "triangle", "triangles");
    if (e.spheres > 0) size += ", " + counted(e.spheres, "sphere", "spheres");
    page.line(page.bold(e.scene) + "  " +
              page.dim(size + ", " + std::to_string(e.width) + "×" + std::to_string(e.height) + " pixels"));
    showEffects(e, page);
    showLight(e, page);
    if (e.costs) showCosts(*e.costs, e.technique, page);
    return page.text();
}

std::string explanationJson(const Explanation& e) {
    nlohmann::ordered_json json{{"scene", e.scene},
                                {"triangles", e.triangles},
                                {"spheres", e.spheres},
                                {"lamps", e.lamps},
                                {"width", e.width},
                                {"height", e.height},
                                {"technique", e.technique},
                                {"effects", nlohmann::ordered_json::array()},
                                {"light", nlohmann::ordered_json::array()}};
    for (const SceneEffect& effect : e.effects)
        json["effects"].push_back({{"key", effect.key},
                                   {"group", name(effect.group)},
                                   {"name", effect.name},
                                   {"meaning", effect.meaning},
                                   {"present", effect.present}});
    for (const LightRow& row : e.light) {
        nlohmann::ordered_json by = nlohmann::ordered_json::array();
        for (size_t i = 0; i < row.techniques.size(); ++i)
            if (row.techniques[i]) by.push_back(e.techniques[i]);
        json["light"].push_back({{"words", row.words}, {"paths", row.paths}, {"rendered_by", by}});
    }
    if (e.costs) {
        nlohmann::ordered_json costs{{"device", e.costs->device},
                                     {"width", e.costs->width},
                                     {"height", e.costs->height},
                                     {"iteration_seconds", e.costs->iterationSeconds()},
                                     {"parts", nlohmann::ordered_json::array()},
                                     {"effects", nlohmann::ordered_json::array()}};
        for (const PartCost& part : e.costs->parts)
            costs["parts"].push_back({{"name", part.name}, {"seconds", part.seconds}});
        for (const EffectCost& effect : e.costs->effects)
            costs["effects"].push_back(
                {{"key", effect.key}, {"ratio", effect.ratio}, {"low", effect.low}, {"high", effect.high}});
        json["costs"] = costs;
    }
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::vector<std::string> sceneInShort(const Scene& scene, const JobDefinition& job) {
    const RenderSettings& settings = job.settings;
    std::vector<std::string> parts{counted(triangleCount(scene), "triangle", "triangles")};
    const auto add = [&](size_t number, const char* one, const char* many) {
        if (number > 0) parts.push_back(counted(number, one, many));
    };
    add(scene.spheres.size(), "sphere", "spheres");
    add(scene.textures.size(), "texture", "textures");
    for (const LightCount& lights : lightCounts(scene)) add(lights.number, lights.one, lights.many);
    std::vector<std::string> lines{"scene: " + joined(parts)};

    const LightPathFacts facts = lightPathFacts(scene);
    std::string light = "light: direct and indirect";
    if (facts.specular) light += ", caustics, and all of it in mirrors or through glass";
    if (facts.sizelessLamps) light += facts.sizedLamps ? "; some lamps have no size" : "; no lamp has a size";
    lines.push_back(light + (facts.specular ? "" : "; nothing is a mirror or clear glass"));

    std::string technique = "technique: " + settings.technique;
    if (!settings.without.empty()) technique += " without " + name(settings.without);
    if (job.choice) technique += ": " + job.choice->reason;
    if (!job.missing.empty())
        technique += "; the image will lack " + described(job.missing) + ", which it cannot render";
    else if (!job.choice)
        technique += ", renders all of it";
    lines.push_back(technique);
    return lines;
}

}  // namespace antipode
