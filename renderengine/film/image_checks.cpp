#include "film/image_checks.h"

#include <limits>

#include "renderengine/error.h"

namespace antipode {

void requireConsistent(const Image& image, const std::string& path) {
    constexpr uint32_t maxSide = std::numeric_limits<int32_t>::max();
    const bool sized = image.width >= 1 && image.width <= maxSide && image.height >= 1 && image.height <= maxSide;
    if (sized && image.pixels.size() == size_t(image.width) * image.height) return;
    throw Error(ErrorCode::Usage, "The image for '" + path + "' of " + std::to_string(image.width) + "x" +
                                      std::to_string(image.height) + " with " + std::to_string(image.pixels.size()) +
                                      " pixels is inconsistent.");
}

}  // namespace antipode
