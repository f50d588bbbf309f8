#include "tests/farm/simulation/simulated_client.h"

#include <algorithm>
#include <utility>

#include "proto/wire/job_messages.h"
#include "tests/farm/simulation/identity.h"

namespace antipode::simulation {
namespace {

constexpr double tickSeconds = 0.25;

}  // namespace

/// All that is lost with the process.
struct SimulatedClient::Life {
    Life(const ClientModel& model, JobDefinition job, std::optional<Checkpoint> start, farm::OpenJob open,
         farm::Hello hello, SimulatedClient& client)
        : coordinator(std::move(job), model.options, std::move(start)),
          budget(model.budgetBytes),
          context{coordinator, *client.scene_, std::move(open), std::move(hello), budget, {}},
          connections(client.process_, client.name_, client.random_.index(1u << 31), context, client.connect_,
                      [&client] { client.advance(); }) {}

    Coordinator coordinator;
    ReassemblyBudget budget;
    RemoteContext context;
    SimulatedConnections connections;
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
    life_ = std::make_unique<Life>(model_, job, std::move(start), std::move(open), std::move(hello), *this);
    for (SimulatedServer* server : servers_) life_->connections.use(*server);
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
    life_->connections.abandon(serversNotice);
    life_.reset();
    process_.kill();
    completeAt_.reset();
}

void SimulatedClient::useServer(SimulatedServer& server) {
    servers_.push_back(&server);
    process_.after(0, [this, &server] { life_->connections.use(server); });
}

void SimulatedClient::leaveServer(const SimulatedServer& server) {
    std::erase(servers_, &server);
    process_.after(0, [this, &server] { life_->connections.leave(server); });
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
    life_->connections.finish();
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
