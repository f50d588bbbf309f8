#include "tests/farm/simulation/simulated_connections.h"

#include <algorithm>
#include <utility>

#include "tests/farm/simulation/simulated_server.h"

namespace antipode::simulation {
namespace {

constexpr double shortestPauseSeconds = 0.5, longestPauseSeconds = 30;

}  // namespace

struct SimulatedConnections::Node {
    SimulatedServer& server;
    bool leaving = false;
    double pause = shortestPauseSeconds;
    Link* link = nullptr;
    std::unique_ptr<RemoteSession> session{};
};

SimulatedConnections::SimulatedConnections(Process& process, std::string name, uint64_t seed, RemoteContext& context,
                                           Connect connect, std::function<void()> advance)
    : process_(process),
      name_(std::move(name)),
      random_(seed),
      context_(context),
      connect_(std::move(connect)),
      advance_(std::move(advance)) {}

SimulatedConnections::~SimulatedConnections() = default;

void SimulatedConnections::use(SimulatedServer& server) {
    nodes_.push_back(std::make_unique<Node>(Node{server}));
    connect(*nodes_.back());
}

void SimulatedConnections::leave(const SimulatedServer& server) {
    for (const auto& node : nodes_)
        if (&node->server == &server) {
            node->leaving = true;
            if (node->session) node->session->finish();
        }
}

void SimulatedConnections::finish() {
    over_ = true;
    for (const auto& node : nodes_)
        if (node->session) node->session->finish();
}

void SimulatedConnections::abandon(bool serversNotice) {
    for (const auto& node : nodes_) {
        if (!node->link) continue;
        node->link->client().abandon();
        node->link->server().hold(never);
        if (serversNotice) node->link->server().lose(0.01, "connection reset by peer");
    }
}

void SimulatedConnections::connect(Node& node) {
    process_.after(0.01, [this, &node] {
        if (node.leaving || over_) return;
        if (node.server.listening())
            opened(node);
        else
            retry(node);
    });
}

void SimulatedConnections::opened(Node& node) {
    Link& link = connect_(name_, process_, node.server);
    node.link = &link;
    node.server.accept(link);
    // The server's time begins as the client's greetings of TCP and TLS reach it; its answer has to come back.
    process_.after(link.quality().latency, [this, &node] { greet(node); });
}

void SimulatedConnections::greet(Node& node) {
    Link& link = *node.link;
    if (!link.client().open()) {
        node.link = nullptr;
        return retry(node);
    }
    if (node.leaving || over_) return link.client().close("the job is over");
    node.session = std::make_unique<RemoteSession>(context_, link.client(), node.server.name(), process_.now());
    link.client().afterReceive = advance_;
    link.client().attach(*node.session, [this, &node] {
        process_.loop().log(name_ + " lost " + node.server.name() + ": " + node.session->end().reason);
        if (node.session->end().wasReady) node.pause = shortestPauseSeconds;
        node.session.reset();
        node.link = nullptr;
        retry(node);
    });
}

void SimulatedConnections::retry(Node& node) {
    if (node.leaving || over_) return;
    process_.after(node.pause * random_.uniform(0.5, 1.0), [this, &node] { connect(node); });
    node.pause = std::min(2 * node.pause, longestPauseSeconds);
}

}  // namespace antipode::simulation
