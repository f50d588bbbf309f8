#include "tests/farm/simulation/simulated_client.h"

#include <algorithm>
#include <utility>

#include "proto/wire/job_messages.h"
#include "tests/farm/simulation/identity.h"

namespace antipode::simulation {
namespace {

constexpr double tickSeconds = 0.25, shortestPauseSeconds = 0.5, longestPauseSeconds = 30;

}  // namespace

struct SimulatedClient::Node {
    SimulatedServer& server;
    bool leaving = false;
    double pause = shortestPauseSeconds;
    Link* link = nullptr;
    std::unique_ptr<RemoteSession> session{};
};

/// All that is lost with the process.
struct SimulatedClient::Life {
    Life(const ClientModel& model, JobDefinition job, std::optional<Checkpoint> start, farm::OpenJob open,
         farm::Hello hello, const wire::ScenePackage& scene)
        : coordinator(std::move(job), model.options, std::move(start)),
          budget(model.budgetBytes),
          context{coordinator, scene, std::move(open), std::move(hello), budget, {}} {}

    Coordinator coordinator;
    ReassemblyBudget budget;
    RemoteContext context;
    std::vector<std::unique_ptr<Node>> nodes;
    std::optional<SteppedWorker> worker;
    std::optional<LocalNode> local;
};

SimulatedClient::SimulatedClient(EventLoop& loop, std::string name, ClientModel model,
                                 std::shared_ptr<const wire::ScenePackage> scene, uint64_t seed, Connect connect)
    : name_(std::move(name)),
      model_(std::move(model)),
      scene_(std::move(scene)),
      connect_(std::move(connect)),
      process_(loop),
      random_(seed) {}

SimulatedClient::~SimulatedClient() = default;

void SimulatedClient::start() {
    if (life_) return;
    const JobDefinition job{model_.settings, scene_->sceneHash, kernelHashOfAll,
                            test::fakeSums(model_.settings, {}).layout};
    std::optional<Checkpoint> start;
    if (!checkpoint_.empty()) {
        start = decodeCheckpoint(checkpoint_);
        requireSameJob(*start, job);
    }
    std::string id;
    while (id.size() < 16) id.push_back(char(random_.index(256)));
    farm::OpenJob open = wire::makeOpenJob(id, job.settings, scene_->root(), job.sceneHash, job.kernelHash);
    farm::Hello hello;
    hello.set_oldest_protocol(wire::protocolVersion);
    hello.set_newest_protocol(wire::protocolVersion);
    hello.set_build("simulated");
    hello.set_kernel_hash(kernelHashOfAll);
    hello.set_client(name_);
    life_ = std::make_unique<Life>(model_, job, std::move(start), std::move(open), std::move(hello), *scene_);
    for (SimulatedServer* server : servers_) {
        life_->nodes.push_back(std::make_unique<Node>(Node{*server}));
        connect(*life_->nodes.back());
    }
    if (model_.device) {
        life_->worker.emplace(process_, *model_.device);
        LocalNodeContext context{life_->coordinator, *life_->worker,
                                 [this](std::function<void()> action) { process_.after(0, std::move(action)); },
                                 [this] { return process_.now(); }, [](const Error&) {}};
        life_->local.emplace(std::move(context), "simulated device", "fake",
                             std::make_shared<const Scene>(test::tinyScene()), model_.settings);
    }
    process_.every(tickSeconds, [this] { advance(); });
    process_.every(model_.checkpointSeconds, [this] {
        if (!life_->coordinator.committed().empty())
            checkpoint_ = encodeCheckpoint(life_->coordinator.checkpoint(process_.now()));
    });
}

void SimulatedClient::kill(bool serversNotice) {
    if (!life_) return;
    process_.loop().log(name_ + " is gone");
    for (const auto& node : life_->nodes) {
        if (!node->link) continue;
        node->link->client().abandon();
        node->link->server().hold(never);
        if (serversNotice) node->link->server().lose(0.01, "connection reset by peer");
    }
    life_.reset();
    process_.kill();
    completeAt_.reset();
}

void SimulatedClient::useServer(SimulatedServer& server) {
    servers_.push_back(&server);
    process_.after(0, [this, &server] {
        life_->nodes.push_back(std::make_unique<Node>(Node{server}));
        connect(*life_->nodes.back());
    });
}

void SimulatedClient::leaveServer(const SimulatedServer& server) {
    std::erase(servers_, &server);
    process_.after(0, [this, &server] {
        for (const auto& node : life_->nodes)
            if (&node->server == &server) {
                node->leaving = true;
                if (node->session) node->session->finish();
            }
    });
}

void SimulatedClient::connect(Node& node) {
    process_.after(0.01, [this, &node] {
        if (node.leaving || complete()) return;
        if (node.server.listening())
            opened(node);
        else
            retry(node);
    });
}

void SimulatedClient::opened(Node& node) {
    Link& link = connect_(*this, node.server);
    node.link = &link;
    node.server.accept(link);
    // The server's time begins as the client's greetings of TCP and TLS reach it; its answer has to come back.
    process_.after(link.quality().latency, [this, &node] { greet(node); });
}

void SimulatedClient::greet(Node& node) {
    Link& link = *node.link;
    if (!link.client().open()) {
        node.link = nullptr;
        return retry(node);
    }
    if (node.leaving || complete()) return link.client().close("the job is over");
    node.session = std::make_unique<RemoteSession>(life_->context, link.client(), node.server.name(), process_.now());
    link.client().afterReceive = [this] { advance(); };
    link.client().attach(*node.session, [this, &node] {
        process_.loop().log(name_ + " lost " + node.server.name() + ": " + node.session->end().reason);
        if (node.session->end().wasReady) node.pause = shortestPauseSeconds;
        node.session.reset();
        node.link = nullptr;
        retry(node);
    });
}

void SimulatedClient::retry(Node& node) {
    if (node.leaving || complete()) return;
    process_.after(node.pause * random_.uniform(0.5, 1.0), [this, &node] { connect(node); });
    node.pause = std::min(2 * node.pause, longestPauseSeconds);
}

void SimulatedClient::advance() {
    if (complete()) return;
    Coordinator& coordinator = life_->coordinator;
    coordinator.tick(process_.now());
    for (std::string& message : coordinator.takeMessages()) {
        process_.loop().log(name_ + " says: " + message);
        messages_.push_back(std::move(message));
    }
    if (!coordinator.complete()) return;
    completeAt_ = process_.now();
    process_.loop().log(name_ + " is complete");
    for (const auto& node : life_->nodes)
        if (node->session) node->session->finish();
}

bool SimulatedClient::said(const std::string& words) const {
    return std::ranges::any_of(messages_,
                               [&](const auto& message) { return message.find(words) != std::string::npos; });
}

const Coordinator& SimulatedClient::coordinator() const { return life_->coordinator; }

std::optional<std::string> SimulatedClient::brokenBound() const {
    if (!life_) return std::nullopt;
    const uint64_t result = uint64_t(model_.settings.width) * model_.settings.height * 24;
    if (life_->budget.taken() > std::max(model_.budgetBytes, result)) return name_ + " exceeds its reassembly budget";
    return std::nullopt;
}

std::optional<std::string> SimulatedClient::wrongResult() const {
    if (!complete()) {
        std::string state = name_ + " is not complete:";
        for (const NodeStatus& node : life_->coordinator.nodes())
            state += ' ' + node.description.name + " in state " + std::to_string(int(node.state)) + " with " +
                     std::to_string(node.leases) + " leases,";
        return state + ' ' + std::to_string(life_->coordinator.committed().count()) + " of " +
               std::to_string(*model_.options.iterations) + " iterations are committed";
    }
    const Coordinator& coordinator = life_->coordinator;
    const std::vector<IterationRange> all = {{0, *model_.options.iterations}};
    if (coordinator.committed().ranges() != all) return name_ + " has committed other iterations than the job's";
    const FilmSums expected = test::fakeSums(model_.settings, all, model_.noise);
    if (coordinator.sums().iterations != expected.iterations) return name_ + " counts other iterations";
    if (coordinator.sums().sha256() != expected.sha256()) return name_ + " has other sums than the standalone render";
    if (life_->budget.taken() != 0) return name_ + " has not given its reassembly budget back";
    return std::nullopt;
}

}  // namespace antipode::simulation
