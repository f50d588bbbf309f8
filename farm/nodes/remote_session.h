// The client's side of one connection to a server: introduction, scene, leases, results.
#pragma once

#include <memory>
#include <string>

#include "farm/jobs/coordinator.h"
#include "proto/wire/loop_watch.h"
#include "proto/wire/session.h"
#include "proto/wire/scene_package.h"

namespace antipode {

/// Bounds the sums that are being put together, over all servers: a 1080p result is 50 MB before it is merged.
class ReassemblyBudget {
public:
    explicit ReassemblyBudget(uint64_t bytes) : whole_(bytes) {}
    /// Takes the bytes if they are free, or if nothing is taken.
    bool tryTake(uint64_t bytes);
    void give(uint64_t bytes) { taken_ -= bytes; }
    uint64_t taken() const { return taken_; }

private:
    uint64_t whole_, taken_ = 0;
};

/// What all connections of a client share.
struct RemoteContext {
    Coordinator& coordinator;
    const wire::ScenePackage& scene;
    farm::OpenJob openJob;
    farm::Hello hello;
    ReassemblyBudget& budget;
    wire::Liveness liveness;
    wire::LoopWatch watch{};  ///< of what connections run
};

/// How a server was lost, for whoever decides about reconnecting.
struct RemoteEnd {
    farm::Refusal::Code refusal = farm::Refusal::UNKNOWN;  ///< where the server refused
    std::string reason;
    bool wasReady = false;  ///< it had been ready for leases
    bool rejected = false;  ///< secrets or certificates do not fit, see wire::Stream
};

/// Pure: see wire::Session. Checks all that a server sends: order, lease, range, size, scale, hash, radius. It is the
/// coordinator's node from JobReady to disconnected().
class RemoteSession final : public wire::Session, private NodePort {
public:
    /// `name`: HOST:PORT, the node's name.
    RemoteSession(RemoteContext& context, wire::FramePort& port, std::string name, double now);
    ~RemoteSession() override;

    void heard(double now) override;
    void receive(const wire::Frame& frame, double now) override;
    void tick(double now) override;
    void disconnected(const std::string& reason, double now) override;

    /// Tells the server that the job is over, then closes.
    void finish();

    enum class Phase { Greeting, Uploading, Building, Ready, Ended };
    Phase phase() const;
    uint64_t uploadedBytes() const;  ///< of `uploadBytes`, in phase Uploading
    uint64_t uploadBytes() const;
    const farm::Welcome& welcome() const;
    const RemoteEnd& end() const;

private:
    void grant(const Lease& lease) override;
    void truncate(LeaseId lease) override;

    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace antipode
