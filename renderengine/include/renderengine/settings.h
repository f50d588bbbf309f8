// What a render is asked for, apart from the scene. Everything that decides the image's bytes is here.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "renderengine/layers.h"
#include "renderengine/transport.h"

namespace antipode {

/// A light transport algorithm as a choice of terms in one weighted sum (see techniques/technique.h for the table).
struct TechniqueInfo {
    std::string name;         ///< what --technique takes: pt, pt-naive, lt, bpt, ppm, bpm, vcm
    std::string description;  ///< one sentence
    bool lightPaths = false;  ///< whether it traces paths from the lights
    TransportSet transports;  ///< what of it can be left out
};

/// All techniques that can be selected by name, the default first.
const std::vector<TechniqueInfo>& techniqueTable();

/// One term of the weighted sum alone, unweighted, for tests and per-technique images.
/// Vertices are counted from the light (s) and from the camera (t); a path has s+t−1 edges.
/// A merge joins the s-th light vertex with the t-th camera vertex: one path vertex less, s+t−2 edges.
struct SingleTechnique {
    uint32_t s = 0, t = 2;
    bool merge = false;
};

/// The kernels' arithmetic. Double takes a device with 64-bit floats, and the same random numbers: it tells what
/// float32 costs in accuracy and saves in time.
enum class Precision { Float, Double };

/// "float" or "double": what --precision takes.
constexpr const char* name(Precision precision) { return precision == Precision::Double ? "double" : "float"; }

/// What the numbers are that paths are drawn by. Sobol': each pixel goes through an Owen-scrambled sequence from
/// iteration to iteration, and all light paths share one, so that samples are spread evenly. Independent: hashes.
enum class Sampler { Independent, Sobol };

/// "independent" or "sobol": what --sampler takes.
constexpr const char* name(Sampler sampler) { return sampler == Sampler::Sobol ? "sobol" : "independent"; }

/// What engines take at most. checkSettings() refuses more; command lines and scenes are held to the same numbers.
struct SettingsLimits {
    static constexpr uint32_t side = 65536;  ///< pixels
    static constexpr uint64_t pixels = uint64_t(1) << 28;
    static constexpr uint32_t pathLength = 65535;  ///< edges
    static constexpr uint64_t lightPaths = uint64_t(1) << 28;
    static constexpr uint32_t connectionsPerVertex = 16;
    static constexpr uint32_t residueClasses = 8;
};

/// Pixels (x, y) of a frame with x0 ≤ x < x1 and y0 ≤ y < y1, from its upper left corner.
struct PixelWindow {
    uint32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;

    constexpr uint32_t width() const { return x1 - x0; }
    constexpr uint32_t height() const { return y1 - y0; }
    constexpr bool operator==(const PixelWindow&) const = default;
};

/// "x0,y0,x1,y1": what --crop takes.
std::string described(const PixelWindow& window);

struct RenderSettings {
    uint32_t width = 512, height = 512;  ///< of the frame: what the camera sees
    std::optional<PixelWindow> crop;  ///< part of the frame that is rendered, with the bytes that it has in the whole
    std::string technique = "vcm";
    std::optional<SingleTechnique> single;  ///< replaces `technique`
    TransportSet without;                   ///< what of the technique is left out
    uint64_t seed = 1;
    double radiusFactor = 1.0;               ///< initial merge radius in units of the scene's automatic radius
    std::optional<double> initialRadius;     ///< in scene units; replaces the automatic radius
    double alpha = 2.0 / 3.0;                ///< radius reduction: r_i = r_1·i^((α−1)/2), in (0,1]
    std::optional<uint32_t> minPathLength;   ///< edges; shorter paths contribute nothing (tests)
    std::optional<uint32_t> maxPathLength;   ///< edges; unlimited without
    bool russianRoulette = true;             ///< paths may end from their third vertex on; false needs maxPathLength
    std::optional<uint64_t> lightPathCount;  ///< per iteration; framePixels() without
    uint32_t connectionsPerVertex = 1;       ///< light vertices that each camera vertex connects to
    Precision precision = Precision::Float;
    Sampler sampler = Sampler::Sobol;
    bool curvedTriangles = true;             ///< coarse smooth triangles are rendered as curved surfaces
    LayerSet layers;                         ///< beside the image
    Guides guides = Guides::FirstDiffuse;    ///< which surface they tell of
    std::optional<uint32_t> residueClasses;  ///< in how many layers the image comes, by iteration modulo their number
};

/// The part of the frame that the film holds.
constexpr PixelWindow filmWindow(const RenderSettings& s) {
    return s.crop.value_or(PixelWindow{0, 0, s.width, s.height});
}

/// Of the whole, whatever part is rendered; as many light paths make an iteration where the settings do not say.
constexpr uint64_t framePixels(const RenderSettings& s) { return uint64_t(s.width) * s.height; }

/// Whether the technique merges, with what is left out of it: only then is its image off by more than noise. Throws
/// Error(Usage) as an engine does.
bool merges(const RenderSettings& settings);

/// Throws Error(Usage) for what no engine takes: sizes of 0, numbers out of their range (SettingsLimits), an unknown
/// technique.
void checkSettings(const RenderSettings& settings);

}  // namespace antipode
