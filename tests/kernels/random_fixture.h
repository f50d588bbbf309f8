// Random numbers of lib/random.glsl as a device draws them.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "support/hard_case.h"
#include "techniques/sample_sets.h"
#include "tests/kernels/kernel_harness.h"

namespace antipode {

class RandomFixture : public DeviceTest {
protected:
    /// What of a path draws, as the kernels address it.
    struct Address {
        uint32_t path = 0, stream = 0, vertex = 1, block = 2;
    };

    /// One block of four a call of `address`, by a variant of random_probe, in an iteration of `set`.
    std::vector<Texel> draw(uint32_t variant, size_t count, const std::function<Address(uint32_t)>& address,
                            const SampleSet& set) {
        ProbeData inputs;
        for (uint32_t i = 0; i < count; ++i) {
            const Address a = address(i);
            inputs.a.push_back({std::bit_cast<float>(a.path), std::bit_cast<float>(a.stream),
                                std::bit_cast<float>(a.vertex), std::bit_cast<float>(a.block)});
        }
        shared::DispatchParameters<float> push{};
        push.randomKey0 = set.key0;
        push.randomKey1 = set.key1;
        push.sampleIndex = set.index;
        return harness.run(kernel_probes::random_probe(), inputs, variant, push).a;
    }

    void expectNull(const std::string& difficulty, double significance, double pValue) {
        expectWithin(
            {"Sampling", difficulty, "largest −log₁₀ p of χ² and correlation tests", -std::log10(significance)},
            -std::log10(pValue), device->info().name);
    }

    KernelHarness harness{*device};
};

}  // namespace antipode
