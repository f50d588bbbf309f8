// Wavefront material libraries as they are written: what a file does not say is not there.
//
// After the specification (Alias|Wavefront, "MTL material format", 1995) and the physically based statements that
// Blender and others write (Pr, Pm, Ps, Pc, Pcr, aniso, norm).
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "renderengine/vec.h"

namespace antipode {

/// An image with its options; without a file there is none.
struct MtlMap {
    std::string file;
    std::array<float, 2> scale{1, 1}, offset{0, 0};  ///< -s, -o: uv·scale + offset, v upwards
    bool clamp = false;                              ///< -clamp on
    float bumpMultiplier = 1;                        ///< -bm
    char channel = 0;                                ///< -imfchan: r, g, b, m (alpha), l (luminance), z; 0 where unsaid

    explicit operator bool() const { return !file.empty(); }
};

struct MtlMaterial {
    std::map<std::string, Vec3f> colors;   ///< kd, ks, ke, tf
    std::map<std::string, float> numbers;  ///< ns, ni, d, illum, pr, pm, ps, pc, pcr, aniso, anisor
    std::map<std::string, MtlMap> maps;    ///< by lower-case statement: map_kd, map_ks, map_ke, map_d, bump, norm …
    std::map<std::string, bool> notRead;   ///< statements and options that ask for something else

    std::optional<Vec3f> color(const std::string& statement) const;
    std::optional<float> number(const std::string& statement) const;
    /// The map of this statement, or an empty one.
    const MtlMap& map(const std::string& statement) const;
};

/// The materials of a library by name; a second definition adds to the first. Tr is read as 1 − d, map_bump as bump.
/// Lines that make no sense are skipped; nothing throws.
std::map<std::string, MtlMaterial> parseMtl(std::string_view text);

}  // namespace antipode
