#include "farm/jobs/technique_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "renderengine/engine.h"
#include "renderengine/film.h"
#include "renderengine/light_paths.h"

namespace antipode {
namespace {

constexpr double mostPixels = 128 * 128;
/// Fewer iterations say too little of a variance; more are not needed for a choice.
constexpr uint64_t fewestRounds = 8, mostRounds = 24;
/// Iterations from here on, where the merge radius is as in the middle of a short job; the seed is another, so that the
/// image is not rendered from the numbers that chose its technique.
constexpr uint64_t firstIteration = 16, seedOffset = 0x9E3779B97F4A7C15u;
/// What another technique has to save, so that the pilot's own noise does not decide.
constexpr double worthwhile = 0.8;
/// Less is not enough for the fewest iterations of anything.
constexpr double leastSeconds = 0.25;
/// Above it three engines take longer to build than a choice should.
constexpr uint64_t mostPrimitives = 1'000'000;
constexpr uint32_t tileSide = 8;
/// Standard errors by which the image, or one of some 250 tiles, has to be darker to be lacking light: by Student's t
/// with the 7 degrees of freedom of the shortest pilot one in a thousand is so by chance, and loses the choice, no
/// light.
constexpr double imageErrors = 5, tileErrors = 10, tileShare = 0.05;
constexpr double floorOfReference = 0.01;  // as relMSE has it
constexpr size_t dropped = 1000;           // of so many pixels the worst is left out

struct Moments {
    double count = 0, mean = 0, squares = 0;
    void add(double value) {
        ++count;
        const double delta = value - mean;
        mean += delta / count;
        squares += delta * (value - mean);
    }
    double variance() const { return squares / (count - 1); }
    double meanVariance() const { return variance() / count; }
};

/// What it does beside meeting emitters.
uint32_t remaining(const RenderSettings& settings) {
    const TechniqueInfo& info = *std::ranges::find(techniqueTable(), settings.technique, &TechniqueInfo::name);
    return info.transports.bits() & ~settings.without.bits();
}

/// One technique while it is tried.
class Candidate {
public:
    Candidate(const Scene& scene, RenderSettings settings, const PilotOptions& pilot) : technique_(settings.technique) {
        settings.seed ^= seedOffset;
        renderer_ = pilot.renderers(scene, settings);
        renderer_->render(1);  // drivers compile in the first
    }

    /// Returns the device time that it took.
    double takeTurn(uint64_t iteration) {
        renderer_->reset();
        renderer_->render(iteration);
        double seconds = 0;
        for (const StageTime& stage : renderer_->statistics().stages) seconds += stage.seconds;
        fastest_ = std::min(fastest_, seconds);
        add(renderer_->sums().image());
        return seconds;
    }

    /// The reference is common to all, so that no one's dark pixels make it look worse, or better.
    CandidateMeasure measured(const std::vector<Vec3d>& reference, const Candidate& all) const {
        std::vector<double> errors;
        errors.reserve(pixels_.size());
        for (size_t i = 0; i < pixels_.size(); ++i) {
            double error = 0;
            for (int channel = 0; channel < 3; ++channel) {
                const double level = reference[i][channel];
                error += pixels_[i][size_t(channel)].variance() / (level * level + floorOfReference) / 3;
            }
            errors.push_back(error);
        }
        std::ranges::sort(errors);
        const size_t kept = errors.size() - errors.size() / dropped;
        return {technique_, meanOf(errors, errors.size()), meanOf(errors, kept), fastest_, losesLight(all)};
    }

    std::vector<Vec3d> image() const {
        std::vector<Vec3d> means;
        means.reserve(pixels_.size());
        for (const auto& pixel : pixels_) means.push_back({pixel[0].mean, pixel[1].mean, pixel[2].mean});
        return means;
    }
    uint32_t width() const { return width_; }

private:
    void add(const Image& image) {
        width_ = image.width;
        pixels_.resize(image.pixels.size());
        const uint32_t columns = (image.width + tileSide - 1) / tileSide,
                       rows = (image.height + tileSide - 1) / tileSide;
        std::vector<double> tiles(size_t(columns) * rows);
        double whole = 0;
        for (size_t i = 0; i < image.pixels.size(); ++i) {
            const Vec3f& pixel = image.pixels[i];
            for (int channel = 0; channel < 3; ++channel) pixels_[i][size_t(channel)].add(pixel[channel]);
            const double sum = double(pixel.x) + double(pixel.y) + double(pixel.z);
            tiles[i / image.width / tileSide * columns + i % image.width / tileSide] += sum;
            whole += sum;
        }
        tiles_.resize(tiles.size());
        for (size_t i = 0; i < tiles.size(); ++i) tiles_[i].add(tiles[i]);
        whole_.add(whole);
    }

    static double meanOf(const std::vector<double>& errors, size_t count) {
        double sum = 0;
        for (size_t i = 0; i < count; ++i) sum += errors[i];
        return sum / double(count);
    }

    /// What a technique finds too rarely is missing from a short pilot, and with it the variance that it would cause.
    bool losesLight(const Candidate& all) const {
        const auto deficit = [](const Moments& here, const Moments& there) {
            const double error = std::sqrt(here.meanVariance() + there.meanVariance());
            return error > 0 ? (there.mean - here.mean) / error : 0;
        };
        if (deficit(whole_, all.whole_) > imageErrors) return true;
        for (size_t i = 0; i < tiles_.size(); ++i)
            if (deficit(tiles_[i], all.tiles_[i]) > tileErrors &&
                all.tiles_[i].mean - tiles_[i].mean > tileShare * all.tiles_[i].mean)
                return true;
        return false;
    }

    std::string technique_;
    std::unique_ptr<Renderer> renderer_;
    double fastest_ = std::numeric_limits<double>::infinity();
    uint32_t width_ = 0;
    std::vector<std::array<Moments, 3>> pixels_;
    std::vector<Moments> tiles_;
    Moments whole_;
};

/// Means over 5×5 pixels: less of the noise that a reference of a few iterations has.
std::vector<Vec3d> blurred(const std::vector<Vec3d>& image, uint32_t width) {
    const int columns = int(width), rows = int(image.size() / width);
    std::vector<Vec3d> result;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            Vec3d sum;
            double count = 0;
            for (int v = std::max(0, y - 2); v <= std::min(rows - 1, y + 2); ++v)
                for (int u = std::max(0, x - 2); u <= std::min(columns - 1, x + 2); ++u, ++count)
                    sum += image[size_t(v) * width + size_t(u)];
            result.push_back(sum / count);
        }
    return result;
}

/// Whether pt meets the lamps of caustics by chance alone, and where a pilot never met one, nothing in its image tells.
/// Not so of a sky that is the same everywhere, which no path misses.
bool hidesCaustics(const LightPathFacts& facts, const Scene& scene) {
    const auto emits = [](const Material& m) { return m.emission != Vec3f(0.0f); };
    return facts.specular &&
           (std::ranges::any_of(scene.materials, emits) || (scene.environment && !scene.environment->map.empty()));
}

/// vcm, and those others that render all that it would.
std::vector<RenderSettings> candidates(const Scene& scene, const LightPathFacts& facts,
                                       const RenderSettings& settings) {
    std::vector<RenderSettings> all{withTechnique(settings, "vcm")};
    const std::vector<PathClass> unavoidable = missingClasses(facts, all.front());
    for (const std::string name : {"bpt", "pt"}) {
        if (name == "pt" && hidesCaustics(facts, scene)) continue;
        const RenderSettings other = withTechnique(settings, name);
        const auto same = [&](const RenderSettings& s) { return remaining(s) == remaining(other); };
        if (std::ranges::none_of(all, same) && missingClasses(facts, other) == unavoidable) all.push_back(other);
    }
    return all;
}

uint64_t primitives(const Scene& scene) {
    uint64_t count = scene.spheres.size();
    for (const Mesh& mesh : scene.meshes) count += mesh.triangles.size();
    return count;
}

/// Without a pilot. Where nothing is specular merging does nothing that connections do not, but costs; between bpt and
/// pt only a pilot could tell, and bpt is never far behind.
TechniqueChoice byRule(const LightPathFacts& facts, const std::vector<RenderSettings>& all, const std::string& why) {
    if (!facts.specular && std::ranges::count(all, "bpt", &RenderSettings::technique) > 0)
        return {"bpt", "nothing is a mirror or clear glass, so merging would only cost; " + why, {}};
    return {"vcm", "it renders all light that mirrors and glass may carry; " + why, {}};
}

std::string rounded(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", number);
    return text;
}

TechniqueChoice byPilot(const Scene& scene, const std::vector<RenderSettings>& all, const PilotOptions& pilot) {
    std::vector<Candidate> tried;
    tried.reserve(all.size());
    for (const RenderSettings& settings : all) tried.emplace_back(scene, pilotSettings(settings), pilot);
    double seconds = 0;
    uint64_t rounds = 0;
    while (rounds < fewestRounds ||
           (rounds < mostRounds && seconds * (double(rounds) + 1) < pilot.seconds * double(rounds))) {
        for (Candidate& candidate : tried) seconds += candidate.takeTurn(firstIteration + rounds);
        ++rounds;
    }
    const std::vector<Vec3d> reference = blurred(tried.front().image(), tried.front().width());
    TechniqueChoice choice;
    for (const Candidate& candidate : tried) choice.measures.push_back(candidate.measured(reference, tried.front()));
    const CandidateMeasure &vcm = choice.measures.front(), *best = &vcm;
    for (const CandidateMeasure& m : choice.measures)
        if (!m.losesLight && m.timeBeside(vcm) < best->timeBeside(vcm)) best = &m;
    const std::string trial = "a pilot of " + std::to_string(rounds) + " iterations says";
    if (best == &vcm || best->timeBeside(vcm) > worthwhile) {
        choice.technique = "vcm";
        choice.reason = trial + " that nothing else reaches the same error in much less time";
    } else {
        choice.technique = best->technique;
        choice.reason =
            trial + " that it reaches the same error " + rounded(1 / best->timeBeside(vcm)) + " times as fast as vcm";
    }
    return choice;
}

/// Why there is nothing to choose.
std::string onlyOne(const LightPathFacts& facts, const RenderSettings& settings) {
    const std::vector<PathClass> lacking = missingClasses(facts, withTechnique(settings, "bpt"));
    if (!lacking.empty()) return "nothing else renders " + described(lacking);
    return facts.specular
               ? "with what is left out nothing but pt differs from it, which meets the lamps of caustics by chance"
               : "with what is left out all techniques are one";
}

}  // namespace

RenderSettings withTechnique(RenderSettings settings, const std::string& name) {
    const TechniqueInfo& info = *std::ranges::find(techniqueTable(), name, &TechniqueInfo::name);
    settings.technique = name;
    settings.without = TransportSet(settings.without.bits() & info.transports.bits());
    return settings;
}

double CandidateMeasure::timeBeside(const CandidateMeasure& other) const {
    return seconds / other.seconds * std::max(variance / other.variance, trimmed / other.trimmed);
}

RenderSettings pilotSettings(RenderSettings settings) {
    const double scale = std::min(1.0, std::sqrt(mostPixels / (double(settings.width) * settings.height)));
    const uint32_t rows = settings.height;
    settings.width = std::max(1u, uint32_t(settings.width * scale));
    settings.height = std::max(1u, uint32_t(settings.height * scale));
    *settings.initialRadius *= double(rows) / settings.height;
    settings.crop.reset();  // parts of one image are rendered alike
    settings.lightPathCount.reset();
    settings.layers = {};
    settings.residueClasses.reset();
    return settings;
}

TechniqueChoice chooseTechnique(const Scene& scene, RenderSettings& settings, const PilotOptions& pilot) {
    const LightPathFacts facts = lightPathFacts(scene);
    settings = withTechnique(settings, "vcm");
    std::vector<RenderSettings> all = candidates(scene, facts, settings);
    TechniqueChoice choice;
    if (all.size() == 1)
        choice = {"vcm", onlyOne(facts, settings), {}};
    else if (!pilot.renderers)
        choice = byRule(facts, all, "there was no device for a pilot");
    else if (pilot.seconds < leastSeconds)
        choice = byRule(facts, all, "there was no time for a pilot");
    else if (primitives(scene) > mostPrimitives)
        choice = byRule(facts, all, "the scene is too large for a pilot");
    else {
        const double radius = initialRadius(scene, settings);
        for (RenderSettings& candidate : all) candidate.initialRadius = radius;
        choice = byPilot(scene, all, pilot);
    }
    settings = withTechnique(settings, choice.technique);
    return choice;
}

}  // namespace antipode
