// A worker whose device is a farm of its own: what makes a server a relay.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "farm/nodes/remote_session.h"
#include "renderengine/block_worker.h"
#include "renderengine/film_scale.h"

namespace antipode {

/// The connections of one job to a relay's servers, kept up until they are told to stop.
class RelayChildren {
public:
    virtual ~RelayChildren() = default;
    /// What a log should tell of them. Returns and forgets. Called often.
    virtual std::vector<std::string> tick(double now) = 0;
    /// Why none of them will ever have the job; empty where one may.
    virtual std::string hopeless() const = 0;
    /// Tells them that the job is over.
    virtual void stop() = 0;
    virtual bool stopped() const = 0;
};
/// Begins to connect. The context is kept for as long as a connection may refer to it.
using MakeRelayChildren = std::function<std::unique_ptr<RelayChildren>(std::shared_ptr<RemoteContext>)>;

struct RelayOptions {
    std::string build, kernelHash, name;  ///< as Hello tells them
    double verifyFraction = 0;            ///< of its servers' blocks that a second one of them renders, too
    uint64_t verifySeed = 1;
    uint32_t blocks = 4;                    ///< of a job that are rendered side by side
    uint64_t reassemblyBytes = 1ull << 30;  ///< of a job's results that are being put together
    /// The layers of a job's film at their scales.
    std::function<FilmLayout(const Scene&, const RenderSettings&)> film = scaledFilmLayout;
    wire::LoopWatch watch{};
    /// Without a server for so long, the blocks in hand are ended as they are.
    double patienceSeconds = 5;
};

/// Splits the blocks of a job among servers and adds up what they render, with the coordinator that clients have; so a
/// block is lost with none of them, and its sums are those of one device.
///
/// Lives on one thread with the connections of its servers. What takes long (packing a scene, hashing sums) runs in the
/// background; callbacks come from within tick() or from the background's `done`.
class RelayWorker final : public BlockWorker {
public:
    /// See SceneIntake's Background.
    using Background = std::function<void(std::function<void()> work, std::function<void()> done)>;
    RelayWorker(RelayOptions options, MakeRelayChildren children, Background background, std::function<double()> clock,
                std::function<void(const std::string&)> log);
    ~RelayWorker() override;

    void openJob(const JobKey& job, std::shared_ptr<const Scene> scene, const RenderSettings& settings,
                 std::function<void(const JobReady&)> ready, std::function<void(const Error&)> failed) override;
    void renderBlock(const JobKey& job, IterationRange range, BlockCallbacks callbacks) override;
    void truncateBlock(const JobKey& job, uint64_t first) override;
    void closeJob(const JobKey& job) override;
    BlocksAtOnce blocksAtOnce() const override;
    void tellWidth(const std::function<void(const JobKey&, uint32_t)>& told) override;

    /// Hands out leases and takes what is finished: often, and after any connection has received something.
    void tick();
    /// Closes all jobs.
    void stop();
    /// There is no job, and no connection of an earlier one.
    bool idle() const;

    struct Totals {
        size_t jobs = 0, servers = 0;  ///< servers that have a job, each as often as it has one
        uint64_t width = 0;            ///< iterations that they render side by side
        uint64_t blocks = 0;           ///< put together
    };
    Totals totals() const;

private:
    struct Impl;
    std::shared_ptr<Impl> impl_;  ///< what runs in the background may outlive the worker
};

}  // namespace antipode
