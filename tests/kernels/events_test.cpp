// What lib/common.glsl counts of contributions: one event at most for each, under its source, the gravest kind.
#include <limits>

#include "tests/kernels/kernel_harness.h"

namespace antipode {
namespace {

class EventCountsTest : public DeviceTest {};

TEST_F(EventCountsTest, OneEventForEachInvalidContribution) {
    constexpr float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    ProbeData inputs;
    inputs.a = {{1, 2, 3, 0},          {0, 0, 0, 0},       {-0.0f, 0, 0, 0},
                {3e38f, 1e-45f, 0, 0},                                         // nothing is wrong with these
                {nan, 1, 1, 0},        {1, -inf, 1, 1},    {nan, -1, inf, 0},  // not finite
                {-1, 1, 1, 0},         {1, -1e-30f, 1, 1},                     // negative
                {0, 0, 0, 1}};                                                 // zero density
    KernelHarness harness(*device);
    for (size_t s = 0; s < eventSources; ++s) {
        harness.run(kernel_probes::events_probe(), inputs, uint32_t(s));
        const auto source = EventSource(s);
        EXPECT_EQ(harness.events(source, EventKind::NonFinite), 3u) << name(source);
        EXPECT_EQ(harness.events(source, EventKind::Negative), 2u) << name(source);
        EXPECT_EQ(harness.events(source, EventKind::ZeroPdf), 1u) << name(source);
        for (EventKind kind : {EventKind::Saturated, EventKind::LoopLimit, EventKind::StackOverflow})
            EXPECT_EQ(harness.events(source, kind), 0u) << name(source);
    }
}

}  // namespace
}  // namespace antipode
