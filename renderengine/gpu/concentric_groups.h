// Sets of boxes with one centre, which no plane through a centre can part.
#pragma once

#include "gpu/bvh.h"

namespace antipode {

/// Bounds3f indices, grouped.
struct ConcentricGroups {
    std::vector<uint32_t> members;  ///< group after group; within one by rising size, then by index
    std::vector<uint32_t> begins;   ///< of every group in `members`, and the end of the last
    std::vector<Bounds3f> boxes;    ///< union of every group's boxes

    std::span<const uint32_t> group(size_t i) const {
        return std::span(members).subspan(begins[i], begins[i + 1] - begins[i]);
    }
};

/// Groups the boxes, of which there are at most 2³² - 1, by the sum of their corners in float arithmetic.
ConcentricGroups groupConcentric(std::span<const Bounds3f> boxes);

}  // namespace antipode
