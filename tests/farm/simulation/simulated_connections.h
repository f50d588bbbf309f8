// Sessions of one job with servers, connected again and again as RemoteNode does it.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "farm/nodes/remote_session.h"
#include "tests/farm/simulation/link.h"
#include "tests/support/random.h"

namespace antipode::simulation {

class SimulatedServer;

/// Makes the link of a new connection from a process, which bears this name, to a server.
using Connect = std::function<Link&(const std::string& name, Process& from, SimulatedServer& to)>;

/// Events of the process refer to it until the process is killed.
class SimulatedConnections {
public:
    /// `advance` is called after each frame that came.
    SimulatedConnections(Process& process, std::string name, uint64_t seed, RemoteContext& context, Connect connect,
                         std::function<void()> advance);
    ~SimulatedConnections();

    void use(SimulatedServer& server);
    void leave(const SimulatedServer& server);
    /// The job is over.
    void finish();
    /// The process is gone without a word.
    void abandon(bool serversNotice);

private:
    struct Node;
    void connect(Node& node);
    void opened(Node& node);
    void greet(Node& node);
    void retry(Node& node);

    Process& process_;
    const std::string name_;
    Random random_;
    RemoteContext& context_;
    const Connect connect_;
    const std::function<void()> advance_;
    bool over_ = false;
    std::vector<std::unique_ptr<Node>> nodes_;
};

}  // namespace antipode::simulation
