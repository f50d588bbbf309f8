// The film: int64 fixed-point sums as two 32-bit words, so that the order of additions never shows.
#ifndef ANTIPODE_FILM
#define ANTIPODE_FILM

layout(set = 0, binding = BIND_FILM_LOW, std430) buffer FilmLow { uint filmLow[]; };
layout(set = 0, binding = BIND_FILM_HIGH, std430) buffer FilmHigh { uint filmHigh[]; };

/// Adds value·2^S, rounded to the nearest integer, ties to even, to channel `at`. Works on any device: a carry
/// joins two 32-bit atomics.
void addToChannel(uint at, real value) {
    real scaled = value * job.cameraUp.w;
    if (abs(scaled) >= 4.6e18) {  // 2^62: no sum may come near the sign bit
        countEvent(COUNTER_SATURATED);
        return;
    }
    real magnitude = abs(scaled);
    real high = floor(magnitude * 2.3283064365386963e-10);
    real rest = magnitude - high * 4294967296.0;  // exact: a float holds 24 bits, the high word takes whole ones
    uint low = uint(min(roundEven(rest), 4294967040.0));
    uint top = uint(high);
    if (scaled < 0.0) {
        low = ~low + 1u;
        top = ~top + (low == 0u ? 1u : 0u);
    }
    uint before = atomicAdd(filmLow[at], low);
    uint carry = before + low < before ? 1u : 0u;
    atomicAdd(filmHigh[at], top + carry);
}

/// Adds a sample to a pixel. Non-finite and negative values are counted, and non-finite ones cannot be summed: the
/// count makes the job visibly dirty.
void addSample(uint pixel, real3 value) {
    if (any(isnan(value)) || any(isinf(value))) {
        countEvent(COUNTER_NON_FINITE);
        return;
    }
    if (any(lessThan(value, real3(0.0)))) countEvent(COUNTER_NEGATIVE);
    addToChannel(3u * pixel, value.x);
    addToChannel(3u * pixel + 1u, value.y);
    addToChannel(3u * pixel + 2u, value.z);
}
#endif
