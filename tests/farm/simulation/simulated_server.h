// A render server of the simulation: what antipode-server runs behind its sockets, on a device in virtual time.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/server_session.h"
#include "tests/farm/simulation/link.h"
#include "tests/farm/simulation/simulated_connections.h"
#include "tests/farm/simulation/stepped_worker.h"

namespace antipode::simulation {

class SimulatedServer;

struct ServerModel {
    DeviceModel device;
    std::string deviceClass = "fake";
    RenderQueueLimits limits;
    double drainSeconds = 20;
    double startSeconds = 0;                  ///< from the start of the process until it listens
    double loadSeconds = 0;                   ///< to put a scene together, beside what it lets the device wait for
    std::vector<SimulatedServer*> relayed{};  ///< has these render instead of the device
    double relayedVerifyFraction = 0;
};

class SimulatedServer {
public:
    /// `cacheFolder` outlives the process, as a disk does.
    SimulatedServer(EventLoop& loop, std::string name, ServerModel model, std::string cacheFolder, Connect connect);
    ~SimulatedServer();

    void start();
    bool running() const { return life_ != nullptr; }
    /// Whether connections are taken.
    bool listening() const;
    void accept(Link& link);

    /// The process is gone, without a word. Clients notice where the machine is still there to tell them.
    void kill(bool clientsNotice);
    void pause() { process_.pause(); }
    void resume() { process_.resume(); }
    void hang(double seconds);
    void failDevice();
    /// As SIGTERM does it.
    void drain();

    const std::string& name() const { return name_; }
    Process& process() { return process_; }
    uint64_t iterations() const;
    bool isRelay() const { return !model_.relayed.empty(); }
    /// What of the server's own bounds is broken now, if any.
    std::optional<std::string> brokenBound() const;

private:
    struct Life;
    void tick();
    void restart();

    const std::string name_;
    const ServerModel model_;
    const std::string cacheFolder_;
    Process process_;
    const Connect connect_;
    std::unique_ptr<Life> life_;
    uint64_t earlierIterations_ = 0;
};

}  // namespace antipode::simulation
