// What can be had of a render beside its image.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderengine/enum_set.h"

namespace antipode {

/// Quantities that films sum, in the order in which they lie in one, behind the image. LAYER_* of
/// kernels/shared/layout.h are their bits.
enum class LayerKind : uint32_t {
    // Parts of the image, by the technique that found them; they add up to it exactly.
    EmitterHit,
    NextEvent,
    Connection,
    Merge,
    Splat,
    // Guides: what the camera path's first surface is like (see Guides).
    Albedo,
    Normal,
    Depth,
    Position,
    Coverage,  ///< where a surface was met at all; comes with depth and position
    // What the bias of merging is told from (film/bias_estimate.h), of either sign; the last before the image.
    Blur,
    Image,
};
inline constexpr uint32_t layerKinds = 11;  ///< without the image

/// Radiance W/(m² sr); none for what is at most 1; lengths in scene units, as means over the iterations that met
/// something.
enum class LayerUnit { Radiance, None, Length };

struct LayerInfo {
    LayerKind kind;
    const char* option;    ///< what --layers takes
    const char* name;      ///< prefix of its channels in files, as viewers and denoisers know them
    const char* channels;  ///< one letter each
    LayerUnit unit;
    const char* description;  ///< a few words
};

/// All but the image, in the order of LayerKind.
const std::vector<LayerInfo>& layerTable();

/// Which unit the kind's values have; the image's is radiance.
LayerUnit unitOf(LayerKind kind);

using LayerSet = EnumSet<LayerKind, layerKinds>;

constexpr bool hasGuides(LayerSet layers) {
    constexpr uint32_t guides = (1u << uint32_t(LayerKind::Blur)) - (1u << uint32_t(LayerKind::Albedo));
    return (layers.bits() & guides) != 0;
}

/// The names that --layers takes, joined by commas; "none" where there are none.
std::string name(LayerSet layers);

/// Which surface guides tell of: the first on the camera path that is not purely specular, so that they show what is in
/// mirrors and behind glass, or the first of all.
enum class Guides { FirstDiffuse, FirstHit };

/// "first-diffuse" or "first-hit": what --guides takes.
constexpr const char* name(Guides guides) { return guides == Guides::FirstHit ? "first-hit" : "first-diffuse"; }

}  // namespace antipode
