// A client of the simulation: a job, its coordinator, and a session with each server, reconnected as RemoteNode does.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "farm/nodes/local_node.h"
#include "tests/farm/simulation/simulated_connections.h"
#include "tests/farm/simulation/link.h"
#include "tests/farm/simulation/simulated_server.h"
#include "tests/support/random.h"

namespace antipode::simulation {

struct ClientModel {
    RenderSettings settings;
    CoordinatorOptions options;
    uint64_t budgetBytes = 0;
    double checkpointSeconds = 5;
    std::optional<DeviceModel> device;  ///< of its own, which renders, too
    bool noise = false;                 ///< what devices render for it, see DeviceModel
};

class SimulatedClient {
public:
    SimulatedClient(EventLoop& loop, std::string name, ClientModel model,
                    std::shared_ptr<const wire::ScenePackage> scene, uint64_t seed, Connect connect);
    ~SimulatedClient();

    /// Begins the job, or goes on from the last checkpoint if there is one.
    void start();
    bool running() const { return life_ != nullptr; }
    /// The process is gone without a word; servers notice where the machine is still there to tell them.
    void kill(bool serversNotice);
    void pause() { process_.pause(); }
    void resume() { process_.resume(); }

    /// From now on, after restarts, too.
    void useServer(SimulatedServer& server);
    void leaveServer(const SimulatedServer& server);

    const std::string& name() const { return name_; }
    Process& process() { return process_; }
    /// The job is complete; the process goes on.
    bool complete() const { return completeAt_.has_value(); }
    double completeAt() const { return completeAt_.value_or(never); }
    const Coordinator& coordinator() const;
    /// Whether one of its messages contained the words.
    bool said(const std::string& words) const;
    /// What of the client's own bounds is broken now, if any.
    std::optional<std::string> brokenBound() const;
    /// What the finished job's sums are not as they must be, if anything.
    std::optional<std::string> wrongResult() const;

private:
    struct Life;
    void advance();

    const std::string name_;
    const ClientModel model_;
    const std::shared_ptr<const wire::ScenePackage> scene_;
    Connect connect_;
    Process process_;
    Random random_;
    std::vector<SimulatedServer*> servers_;
    std::string checkpoint_;  ///< as on disk
    std::unique_ptr<Life> life_;
    std::optional<double> completeAt_;
    std::vector<std::string> messages_;
};

}  // namespace antipode::simulation
