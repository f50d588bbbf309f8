// What an engine will take of a device, added up from the buffers that it makes.
#include <algorithm>
#include <cmath>
#include <limits>

#include "gpu/bvh.h"
#include "gpu/curved_triangles.h"
#include "kernels/shared/layout.h"
#include "renderengine/engine.h"
#include "techniques/job.h"

namespace antipode {
namespace {

using namespace shared;

constexpr double texelBytes = sizeof(uvec4);
// Light vertices that an iteration stores per light path: roulette from the third vertex on, of what has lost more than
// half, leaves 3 + 2ρ³/(1−ρ) of them in a closed room of albedo ρ, here for ρ = .7.
constexpr double verticesPerLightPath = 5.3;
// The pilot that counts them allocates for at least as many.
constexpr double fewestVertices = 8192;
// The GPU's batch: the larger one.
constexpr uint64_t smallestBatch = 1u << 12, largestBatch = 1u << 20;
// The staging buffer, and small tables: materials, counters, what a driver adds to each allocation.
constexpr double fixedBytes = double((16u + 1u) << 20);

/// PackedScene: three texels of geometry, four of attributes, at most one BVH node and, of an emitter, a light record.
/// Not the tangents, colours and further texture coordinates that few meshes have.
double sceneBytes(const JobSize& size) {
    constexpr double perPrimitive = texelBytes * (3 + 4 + Bvh::texelsPerNode + LIGHT_TEXELS);
    // Textures take 8 bytes a texel, environment maps a texel of radiance and one of the alias table.
    constexpr double perTexel = texelBytes * 2;
    const double added = size.curvedTriangles ? double(greatestCurvedTriangles(size.triangles)) : 0;
    return perPrimitive * (double(size.triangles) + added + double(size.spheres)) + perTexel * double(size.texels);
}

/// PathBuffers: path, hit, radiance, shadow segment and a vertex, three queues and flags per slot; FilmBuffer: two
/// words for each channel. Not the 32 bytes of media a slot, which only touching transparent bodies ask for.
double pathBytes(const JobSize& size) {
    constexpr double records = PATH_RECORDS + 1 + 1 + SHADOW_RECORDS + VERTEX_RECORDS;
    const double techniques = size.channels > 3 ? CAMERA_TECHNIQUES : 0;  // whose radiance may be kept apart
    const double perSlot = double(recordBytes(size.precision)) * (records + techniques) + 4 * (3 + 1);
    const uint64_t batch = std::clamp(std::max(size.pixels, size.lightPaths), smallestBatch, largestBatch);
    return perSlot * double(batch) + 8.0 * double(size.channels) * double(size.pixels);
}

/// VertexBuffers, with the tenth that the engine keeps in reserve: position and data, the same sorted, two halves of
/// keys, up to two buckets of 8 bytes, and the radix sort's counts.
double vertexBytes(const JobSize& size, uint64_t bindingBytes) {
    if (size.lightPaths == 0) return 0;
    const double dataBytes = double(recordBytes(size.precision)) * 2;
    const double perVertex =
        double(recordBytes(size.precision)) * 2 * VERTEX_RECORDS + 2 * 8 + 2 * 8 + 4.0 * SORT_DIGITS / SORT_CHUNK;
    const double wanted = std::max(verticesPerLightPath * double(size.lightPaths), fewestVertices);
    return 1.1 * perVertex * std::min(wanted, double(bindingBytes) / dataBytes);
}

}  // namespace

JobSize sizeOf(const RenderSettings& settings) {
    const FilmLayout film = filmLayout(settings);
    JobSize size;
    size.pixels = film.pixels();
    size.channels = film.channels();
    for (const TechniqueInfo& technique : techniqueTable())
        if (technique.name == settings.technique && technique.lightPaths)
            size.lightPaths = settings.lightPathCount.value_or(framePixels(settings));
    size.precision = settings.precision;
    size.curvedTriangles = settings.curvedTriangles;
    return size;
}

uint64_t estimateDeviceBytes(const JobSize& size, uint64_t bindingBytes) {
    // In double: sizes may come from a peer, and their products need not fit in 64 bits.
    const double bytes = std::ceil(fixedBytes + sceneBytes(size) + pathBytes(size) + vertexBytes(size, bindingBytes));
    return bytes < 0x1p64 ? uint64_t(bytes) : std::numeric_limits<uint64_t>::max();
}

}  // namespace antipode
