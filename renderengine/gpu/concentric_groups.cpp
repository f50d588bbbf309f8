#include "gpu/concentric_groups.h"

#include <tbb/parallel_sort.h>

#include <tuple>

namespace antipode {

namespace {

struct Key {
    Vec3f doubledCentre;
    float size;
    uint32_t index;
};

/// Rises with the extent of a box; its unit does not matter.
float sizeOf(const Bounds3f& box) {
    const Vec3f extent = box.size();
    return extent.x + extent.y + extent.z;
}

}  // namespace

ConcentricGroups groupConcentric(std::span<const Bounds3f> boxes) {
    std::vector<Key> keys(boxes.size());
    for (uint32_t i = 0; i < boxes.size(); ++i) keys[i] = {boxes[i].lower + boxes[i].upper, sizeOf(boxes[i]), i};
    // The index makes the order total, so that it does not depend on how the work is shared out.
    tbb::parallel_sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
        return std::tie(a.doubledCentre.x, a.doubledCentre.y, a.doubledCentre.z, a.size, a.index) <
               std::tie(b.doubledCentre.x, b.doubledCentre.y, b.doubledCentre.z, b.size, b.index);
    });

    ConcentricGroups groups;
    groups.members.reserve(keys.size());
    for (size_t i = 0; i < keys.size(); ++i) {
        const Bounds3f& box = boxes[keys[i].index];
        if (i == 0 || !(keys[i].doubledCentre == keys[i - 1].doubledCentre)) {
            groups.begins.push_back(static_cast<uint32_t>(i));
            groups.boxes.push_back(box);
        } else {
            groups.boxes.back().add(box);
        }
        groups.members.push_back(keys[i].index);
    }
    groups.begins.push_back(static_cast<uint32_t>(keys.size()));
    return groups;
}

}  // namespace antipode
