// The film: int64 fixed-point sums as two 32-bit words, so that the order of additions never shows.
#ifndef ANTIPODE_FILM
#define ANTIPODE_FILM
#include "lib/crop.glsl"
#include "lib/random.glsl"

layout(set = 0, binding = BIND_FILM_LOW, std430) buffer FilmLow { uint filmLow[]; };
layout(set = 0, binding = BIND_FILM_HIGH, std430) buffer FilmHigh { uint filmHigh[]; };
layout(set = 0, binding = BIND_LAYERS_LOW, std430) buffer LayersLow { uint layersLow[]; };
layout(set = 0, binding = BIND_LAYERS_HIGH, std430) buffer LayersHigh { uint layersHigh[]; };

/// Rounds to one of the two whole numbers around `scaled`, with the chances that keep its mean to 2^-32: rounding to
/// the nearest would lose whatever is below half a unit, and S follows the brightest emitter. `random_`: 32 bits.
/// `whole`: two's complement, low word first. False where the sample would reach the sign bit by itself: 2^62.
bool roundSample(real scaled, uint random_, out uvec2 whole) {
    whole = uvec2(0u);
    if (!(abs(scaled) < 4.6e18)) return false;
    real magnitude = abs(scaled), below = floor(magnitude);
    if (uint((magnitude - below) * 4294967296.0) > random_) below += 1.0;
    real high = floor(below * 2.3283064365386963e-10);
    whole.x = uint(below - high * 4294967296.0);  // exact: the high word takes the leading bits
    whole.y = uint(high);
    if (scaled < 0.0) {
        whole.x = ~whole.x + 1u;
        whole.y = ~whole.y + (whole.x == 0u ? 1u : 0u);
    }
    return true;
}

/// A sum that leaves 64 bits is counted by the addition that takes it across, and in whatever order samples of one sign
/// come, as often.
void countOverflow(uint highBefore, uint added) {
    uint highAfter = highBefore + added;
    if (((highBefore ^ highAfter) & (added ^ highAfter)) >> 31u != 0u) countEvent(SOURCE_FILM, EVENT_OVERFLOW);
}

/// Works on any device: a carry joins two 32-bit atomics.
void addToImage(uint at, uvec2 whole) {
    uint before = atomicAdd(filmLow[at], whole.x);
    uint added = whole.y + (before + whole.x < before ? 1u : 0u);
    countOverflow(atomicAdd(filmHigh[at], added), added);
}

/// The same for a sum of the layers behind the image.
void addToLayers(uint at, uvec2 whole) {
    uint before = atomicAdd(layersLow[at], whole.x);
    uint added = whole.y + (before + whole.x < before ? 1u : 0u);
    countOverflow(atomicAdd(layersHigh[at], added), added);
}

/// Where the sums of layer `bit` begin, among those behind the image.
uint layerBase(uint bit) {
    uint before = LAYERS & (bit - 1u);
    uint channels = 3u * bitCount(before) - 2u * bitCount(before & LAYERS_OF_ONE_CHANNEL);
    return channels * job.image.x * job.image.y;
}

/// Adds value·2^S to channel `at` of the image, and where it is there to the same one of layer `also` (a bit, or 0).
void addToChannel(uint at, real value, uint random_, uint also) {
    uvec2 whole;
    if (!roundSample(value * job.cameraUp.w, random_, whole)) {
        countEvent(SOURCE_FILM, EVENT_SATURATED);
        return;
    }
    addToImage(at, whole);
    if (layer(also)) addToLayers(layerBase(also) + at, whole);
}

/// What the samples of a pixel are rounded by: one number for all channels, so that grey stays grey. `path` of `stream`
/// is what the sample came by.
uint roundingBits(uint pixel, uint path, uint stream) {
    return randomBits(path, stream, framePixel(pixel), RANDOM_ROUNDING).x;
}

/// Adds a sample to a pixel. Non-finite and negative values are counted, and non-finite ones cannot be summed: the
/// count makes the job visibly dirty.
void addSample(uint pixel, real3 value, uint path, uint stream, uint also) {
    bool invalid = nonFinite(value);
    countInvalid(SOURCE_FILM, invalid, any(lessThan(value, real3(0.0))), false);
    if (invalid) return;
    uint random_ = roundingBits(pixel, path, stream);
    addToChannel(3u * pixel, value.x, random_, also);
    addToChannel(3u * pixel + 1u, value.y, random_, also);
    addToChannel(3u * pixel + 2u, value.z, random_, also);
}
#endif
