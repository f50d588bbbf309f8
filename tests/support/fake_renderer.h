// A renderer whose sums tell which iterations are in them: what blocks, jobs and farms are tested with.
#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "renderengine/iteration_range.h"
#include "renderengine/renderer.h"

namespace antipode::test {

/// Stops renderers before an iteration until it is released: a device that hangs, or a test that wants to do something
/// at that point. Thread-safe.
class FakeGate {
public:
    /// `iteration` counts from 0.
    explicit FakeGate(uint64_t iteration) : iteration_(iteration) {}

    /// Called by renderers. Throws Error(Device) where nobody releases the gate for a minute.
    void pass(uint64_t iteration);
    /// For good.
    void release();
    /// Whether a renderer has come to the gate, or does within ten seconds.
    bool waitUntilReached();

private:
    const uint64_t iteration_;
    std::mutex mutex_;
    std::condition_variable changed_;
    bool reached_ = false, released_ = false;
};

struct FakeOptions {
    std::chrono::duration<double> perIteration{0};  ///< slept
    std::optional<uint64_t> failAt{};               ///< iteration, from 0, that throws Error(Device)
    std::optional<uint64_t> failAfter{};            ///< so many iterations of a renderer, all others throw it
    std::shared_ptr<FakeGate> gate{};
    bool lie = false;                  ///< adds 1 to the first sum
    bool black = false;                ///< renders zeros, and at once
    bool bomb = false;                 ///< puts sums that leave no room for others
    std::optional<FilmLayout> film{};  ///< whose scales its film has
    bool noise = false;                ///< adds a number below 2^24 to every sum that looks drawn at random
};

/// Renders iteration i (from 0: `render(i + 1)`) as 2^(i mod 40) in every sum, so that losses and duplicates can be
/// read off the sums. Its statistics count one ray a pixel and iteration.
class FakeRenderer final : public Renderer {
public:
    explicit FakeRenderer(const RenderSettings& settings, FakeOptions options = {});

    void render(uint64_t iteration) override;
    FilmSums sums() const override { return sums_; }
    void reset() override;
    EngineStatistics statistics() const override;

private:
    const RenderSettings settings_;
    const FakeOptions options_;
    uint64_t rendered_ = 0;
    FilmSums sums_;
};

RendererFactory fakeRenderers(const FakeOptions& options = {});

/// What a FakeRenderer's film holds after these iterations; one that is named twice counts twice.
FilmSums fakeSums(const RenderSettings& settings, const std::vector<IterationRange>& ranges, bool noise = false);

/// The smallest scene that can be rendered: a white square on the floor below a point light.
Scene tinyScene();

/// The same with a mirror sphere: the caustics that it throws and shows are light that only merging renders.
Scene mirrorScene();

}  // namespace antipode::test
