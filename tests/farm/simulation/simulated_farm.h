// A farm in virtual time: servers, clients and the network between them, on one thread, replayable from a seed.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "tests/farm/simulation/simulated_client.h"
#include "tests/farm/simulation/simulated_server.h"

namespace antipode::simulation {

/// Where the servers' caches lie; the folder is this process's own.
std::string cacheFolderOf(const std::string& server);
/// Empties a server's cache, or fills it with the scene.
void emptyCache(const std::string& server);
void fillCache(const std::string& server, const wire::ScenePackage& scene);

class SimulatedFarm {
public:
    /// `watched`: whoever blocks an event loop is a failure.
    explicit SimulatedFarm(uint64_t seed, bool watched = true);
    ~SimulatedFarm();

    /// Of connections that are made from now on.
    LinkQuality quality;
    /// Of jobs and caches that are added from now on; the smallest one unless set.
    std::shared_ptr<const wire::ScenePackage> scene;

    /// Its cache holds the scene unless `emptyCache`.
    SimulatedServer& addServer(const ServerModel& model, bool emptyCache = false);
    SimulatedClient& addClient(const ClientModel& model);

    EventLoop& loop() { return loop_; }
    Random& random() { return random_; }
    double seconds() const { return loop_.now() - start_; }
    std::vector<std::unique_ptr<SimulatedServer>>& servers() { return servers_; }
    std::vector<std::unique_ptr<SimulatedClient>>& clients() { return clients_; }
    const std::vector<std::unique_ptr<SimulatedClient>>& clients() const { return clients_; }
    std::vector<Link*> openLinks();
    size_t linksMade() const { return links_.size(); }

    /// Until all clients are complete or so many virtual seconds have passed.
    void run(double seconds);
    /// Lets so many virtual seconds pass.
    void pass(double seconds);
    bool complete() const;

    /// Errors of the protocol and broken bounds so far. Results are the clients' affair.
    std::vector<std::string> failures() const;
    size_t largestServerQueue() const;

private:
    Link& makeLink(const std::string& name, Process& from, SimulatedServer& to);
    Connect connect();
    void checkBounds();

    EventLoop loop_;
    const double start_;
    Random random_;
    std::deque<Link> links_;  ///< they live as long as the events that know them
    std::vector<std::unique_ptr<SimulatedServer>> servers_;
    std::vector<std::unique_ptr<SimulatedClient>> clients_;
    std::vector<std::string> failures_;
};

/// A job of a few pixels.
ClientModel tinyJob(uint64_t iterations);

}  // namespace antipode::simulation
