// All nodes of a job: this machine's device, the servers, and the event loop that they live in.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "farm/jobs/coordinator.h"
#include "farm/nodes/server_list.h"
#include "renderengine/scene.h"

namespace antipode {

struct FarmOptions {
    ServerListOptions servers;
    bool waitsForEver = true;               ///< for what notes say
    bool local = true;                      ///< this machine's device, too
    std::string device;                     ///< selector for it
    std::string build;                      ///< version, for servers that are told and refuse
    uint64_t reassemblyBytes = 1ull << 30;  ///< of results that are being put together
};

/// A node as people want to see it.
struct NodeReport {
    std::string name, device;
    std::string state;   ///< "rendering", "uploading 40 %", "lost" …
    std::string detail;  ///< why it is lost or refused
    bool local = false;
    double iterationsPerSecond = 0;
    uint32_t leases = 0;
    uint64_t committed = 0, lost = 0;  ///< iterations in the image; iterations leased in vain
    uint64_t results = 0;              ///< blocks that the former came in
    uint64_t bytesReceived = 0, bytesSent = 0;
    uint32_t connections = 0;
};

/// Reaches the coordinator from one thread only, the one that calls runFor().
class Farm {
public:
    /// Begins to open the local device and to connect. `scene`, `coordinator` outlive it. Throws Error.
    Farm(const FarmOptions& options, std::shared_ptr<const Scene> scene, const JobDefinition& job,
         Coordinator& coordinator);
    ~Farm();
    Farm(const Farm&) = delete;
    Farm& operator=(const Farm&) = delete;

    /// Handles what happens for about so long, then returns; sooner when the job is complete or its first node is
    /// ready.
    void runFor(double seconds);
    /// Whether a node has been ready for leases at any time.
    bool everReady() const;
    /// Nodes that can be given leases now.
    size_t readyNodes() const;
    /// Why the job cannot go on whatever happens: the local device failed, all servers refuse it for good. Empty where
    /// it can; so it is with a servers file once a node has been ready, because people mend what it names.
    std::string hopeless() const;
    /// For how long no node has had the job, or been getting it.
    double idleSeconds() const;
    /// What each server that has not got the job says: "HOST:PORT: Connection refused", joined by "; ".
    std::string complaints() const;
    /// Tells the servers that the job is over. Takes two seconds at most.
    void shutDown();

    std::vector<NodeReport> nodes() const;
    /// Of the local device; empty where there is none or it is not ready.
    std::optional<JobReady> localReady() const;
    /// What the user must know, each once. Returns and forgets.
    std::vector<std::string> takeMessages();

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace antipode
