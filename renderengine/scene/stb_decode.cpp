#include "scene/stb_decode.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <memory>

#include "scene/image_size.h"

// Where a picture ends early stb_image leaves memory as it was, which must not be another picture's.
#define STBI_MALLOC(size) std::calloc(1, size)
#define STBI_REALLOC(pointer, size) std::realloc(pointer, size)
#define STBI_FREE(pointer) std::free(pointer)
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_TGA
#define STBI_ONLY_BMP
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS (1 << 24)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace antipode {
namespace {

/// Hands out the data and remembers whether more was asked for than there is.
struct Source {
    std::span<const uint8_t> rest;
    bool cutShort = false;

    size_t take(int size) {
        const size_t count = std::min(size_t(std::max(size, 0)), rest.size());
        rest = rest.subspan(count);
        return count;
    }
    static int read(void* user, char* out, int size) {
        constexpr int readAhead = 128;  // how much stb_image fetches in advance, which may be more than there is
        auto& source = *static_cast<Source*>(user);
        const uint8_t* from = source.rest.data();
        const size_t count = source.take(size);
        std::copy_n(from, count, out);
        source.cutShort |= size > 0 && (count == 0 || (count < size_t(size) && size != readAhead));
        return int(count);
    }
    static void skip(void* user, int size) {
        auto& source = *static_cast<Source*>(user);
        source.cutShort |= size > 0 && source.take(size) < size_t(size);
    }
    static int atEnd(void* user) { return static_cast<Source*>(user)->rest.empty(); }
};

}  // namespace

std::optional<Texture> decodeTgaOrBmp(std::span<const uint8_t> data, const std::string& name) {
    if (data.size() > size_t(std::numeric_limits<int>::max())) return {};
    int width = 0, height = 0, channels = 0;
    if (!stbi_info_from_memory(data.data(), int(data.size()), &width, &height, &channels)) return {};
    Texture texture = allocateTexture(name, uint64_t(width), uint64_t(height), data.size());
    constexpr stbi_io_callbacks callbacks{Source::read, Source::skip, Source::atEnd};
    Source source{data};
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
        stbi_load_from_callbacks(&callbacks, &source, &width, &height, &channels, 4), stbi_image_free);
    if (source.cutShort) failToDecode(name, "it is cut short");
    if (!pixels) failToDecode(name, stbi_failure_reason());
    std::copy_n(pixels.get(), texture.rgba.size(), texture.rgba.begin());
    return texture;
}

}  // namespace antipode
