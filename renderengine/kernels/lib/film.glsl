// The film: int64 fixed-point sums as two 32-bit words, so that the order of additions never shows.
#ifndef ANTIPODE_FILM
#define ANTIPODE_FILM
#include "lib/random.glsl"

layout(set = 0, binding = BIND_FILM_LOW, std430) buffer FilmLow { uint filmLow[]; };
layout(set = 0, binding = BIND_FILM_HIGH, std430) buffer FilmHigh { uint filmHigh[]; };

/// Adds value·2^S to channel `at`, rounded to one of the two whole numbers around it, with the chances that keep its
/// mean to 2^-32: rounding to the nearest would lose whatever is below half a unit, and S follows the brightest
/// emitter. `random_`: 32 bits. Works on any device: a carry joins two 32-bit atomics. A sum that leaves 64 bits is
/// counted by the addition that takes it across, and in whatever order samples of one sign come, as often.
void addToChannel(uint at, real value, uint random_) {
    real scaled = value * job.cameraUp.w;
    if (!(abs(scaled) < 4.6e18)) {  // 2^62: no sample may reach the sign bit by itself
        countEvent(SOURCE_FILM, EVENT_SATURATED);
        return;
    }
    real magnitude = abs(scaled), whole = floor(magnitude);
    if (uint((magnitude - whole) * 4294967296.0) > random_) whole += 1.0;
    real high = floor(whole * 2.3283064365386963e-10);
    uint low = uint(whole - high * 4294967296.0);  // exact: the high word takes the leading bits
    uint top = uint(high);
    if (scaled < 0.0) {
        low = ~low + 1u;
        top = ~top + (low == 0u ? 1u : 0u);
    }
    uint before = atomicAdd(filmLow[at], low);
    uint carry = before + low < before ? 1u : 0u;
    uint added = top + carry;
    uint highBefore = atomicAdd(filmHigh[at], added), highAfter = highBefore + added;
    if (((highBefore ^ highAfter) & (added ^ highAfter)) >> 31u != 0u) countEvent(SOURCE_FILM, EVENT_OVERFLOW);
}

/// Adds a sample to a pixel. Non-finite and negative values are counted, and non-finite ones cannot be summed: the
/// count makes the job visibly dirty. `path` of `stream` is what the sample came by.
void addSample(uint pixel, real3 value, uint path, uint stream) {
    bool invalid = nonFinite(value);
    countInvalid(SOURCE_FILM, invalid, any(lessThan(value, real3(0.0))), false);
    if (invalid) return;
    // One number for all channels: grey stays grey.
    uint random_ = randomBits(path, stream, pixel, RANDOM_ROUNDING).x;
    addToChannel(3u * pixel, value.x, random_);
    addToChannel(3u * pixel + 1u, value.y, random_);
    addToChannel(3u * pixel + 2u, value.z, random_);
}
#endif
