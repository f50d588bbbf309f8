// Random numbers for tests and for the host reference: a different generator from the renderer's, on purpose.
#pragma once

#include <cstdint>
#include <random>

namespace antipode {

class Random {
public:
    explicit Random(uint64_t seed) : engine_(seed) {}
    /// Uniform in [0, 1), 53 bits; never 1.
    double uniform() { return double(engine_() >> 11) * 0x1p-53; }
    double uniform(double low, double high) { return low + (high - low) * uniform(); }
    /// Uniform in 0 … count−1.
    uint32_t index(uint32_t count) { return uint32_t(uniform() * count); }

private:
    std::mt19937_64 engine_;
};

}  // namespace antipode
