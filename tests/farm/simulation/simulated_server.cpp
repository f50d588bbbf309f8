#include "tests/farm/simulation/simulated_server.h"

#include <utility>

#include "server/relay/relay_worker.h"
#include "tests/farm/simulation/identity.h"

namespace antipode::simulation {
namespace {

constexpr double tickSeconds = 0.25, relayTickSeconds = 0.05, lastWordsSeconds = 2, restartSeconds = 1;
constexpr uint64_t cacheBytes = 64 << 20;

/// The servers of a relay.
class Children final : public RelayChildren {
public:
    Children(Process& process, const std::string& name, const ServerModel& model, const Connect& connect,
             std::shared_ptr<RemoteContext> context, std::function<void()> advance)
        : context_(std::move(context)),
          connections_(process, name, process.life(), *context_, connect, std::move(advance)) {
        for (SimulatedServer* server : model.relayed) connections_.use(*server);
    }

    std::vector<std::string> tick(double) override { return {}; }
    std::string hopeless() const override { return ""; }
    void stop() override { connections_.finish(); }
    bool stopped() const override { return false; }  // events refer to it
    void abandon(bool serversNotice) { connections_.abandon(serversNotice); }

private:
    const std::shared_ptr<RemoteContext> context_;
    SimulatedConnections connections_;
};

}  // namespace

/// All that is lost with the process.
struct SimulatedServer::Life {
    Life(Process& process, const std::string& name, const ServerModel& model, const std::string& cacheFolder,
         const Connect& connect)
        : device(process, model.device),
          relay(model.relayed.empty() ? nullptr : makeRelay(process, name, model, connect)),
          queue(relay ? static_cast<BlockWorker&>(*relay) : device, model.limits,
                [&process](std::function<void()> call) { process.after(0, std::move(call)); }),
          cache(cacheFolder, cacheBytes),
          context{queue, cache, welcomeOf(model), {}, false, inBackground(process, model)},
          listensFrom(process.now() + model.startSeconds) {}

    /// What the loader's thread does takes its time, and none of the event loop's.
    static Background inBackground(Process& process, const ServerModel& model) {
        return [&process, seconds = model.loadSeconds](std::function<void()> work, std::function<void()> done) {
            process.loop().elsewhere(work);
            process.after(seconds, std::move(done));
        };
    }

    std::unique_ptr<RelayWorker> makeRelay(Process& process, const std::string& name, const ServerModel& model,
                                           const Connect& connect) {
        RelayOptions options;
        options.build = "simulated";
        options.kernelHash = kernelHashOfAll;
        options.name = name;
        options.verifyFraction = model.relayedVerifyFraction;
        options.blocks = model.limits.leaseDepth;
        options.film = [](const Scene&, const RenderSettings& settings) { return test::fakeSums(settings, {}).layout; };
        const auto children = [this, &process, &name, &model, &connect](std::shared_ptr<RemoteContext> ofJob) {
            auto made =
                std::make_unique<Children>(process, name, model, connect, std::move(ofJob), [this] { relay->tick(); });
            connected.push_back(made.get());
            return made;
        };
        return std::make_unique<RelayWorker>(
            std::move(options), children, inBackground(process, model), [&process] { return process.now(); },
            [&process, &name](const std::string& event) { process.loop().log(name + " says: " + event); });
    }

    static farm::Welcome welcomeOf(const ServerModel& model) {
        farm::Welcome welcome;
        welcome.set_build("simulated");
        welcome.set_kernel_hash(kernelHashOfAll);
        welcome.mutable_device()->set_name("simulated device");
        welcome.mutable_device()->set_device_class(model.deviceClass);
        welcome.set_lease_depth(model.limits.leaseDepth);
        return welcome;
    }

    SteppedWorker device;
    std::vector<Children*> connected;
    const std::unique_ptr<RelayWorker> relay;  ///< instead of the device
    RenderQueue queue;
    SceneCache cache;
    ServerContext context;
    std::map<Link*, std::unique_ptr<ServerSession>> sessions;
    const double listensFrom;
    double drainEnd = 0;
};

SimulatedServer::SimulatedServer(EventLoop& loop, std::string name, ServerModel model, std::string cacheFolder,
                                 Connect connect)
    : name_(std::move(name)),
      model_(std::move(model)),
      cacheFolder_(std::move(cacheFolder)),
      process_(loop),
      connect_(std::move(connect)) {}

SimulatedServer::~SimulatedServer() = default;

void SimulatedServer::start() {
    if (life_) return;
    life_ = std::make_unique<Life>(process_, name_, model_, cacheFolder_, connect_);
    process_.every(tickSeconds, [this] { tick(); });
    if (life_->relay) process_.every(relayTickSeconds, [this] { life_->relay->tick(); });
}

bool SimulatedServer::listening() const {
    return life_ && !life_->context.draining && process_.now() >= life_->listensFrom;
}

void SimulatedServer::accept(Link& link) {
    process_.after(0, [this, &link] {
        if (!life_) return;
        auto& session = life_->sessions[&link];
        session = std::make_unique<ServerSession>(life_->context, link.server(), process_.now());
        link.server().attach(*session, [this, &link] { life_->sessions.erase(&link); });
    });
}

void SimulatedServer::tick() {
    life_->queue.tick(process_.now());
    if (!life_->queue.deviceLoss().empty()) return restart();
    if (!life_->context.draining) return;
    if (process_.now() < life_->drainEnd && !(life_->queue.idle() && life_->sessions.empty())) return;
    for (auto& [link, session] : life_->sessions) link->server().close("the server is going down");
    life_->drainEnd = never;
    process_.after(lastWordsSeconds, [this] { kill(true); });
}

/// As its supervisor does it.
void SimulatedServer::restart() {
    kill(true);
    process_.loop().after(restartSeconds, [this] { start(); });
}

void SimulatedServer::kill(bool clientsNotice) {
    if (!life_) return;
    process_.loop().log(name_ + " is gone");
    for (auto& [link, session] : life_->sessions) {
        link->server().abandon();
        link->client().hold(never);
        if (clientsNotice) link->client().lose(0.01, "connection reset by peer");
    }
    for (Children* children : life_->connected) children->abandon(clientsNotice);
    earlierIterations_ += life_->device.iterations();
    life_.reset();
    process_.kill();
}

void SimulatedServer::hang(double seconds) {
    if (life_) life_->device.hang(process_.now() + seconds);
}

void SimulatedServer::failDevice() {
    if (life_) life_->device.failNext();
}

void SimulatedServer::drain() {
    process_.after(0, [this] {
        if (!life_ || life_->context.draining) return;
        process_.loop().log(name_ + " drains");
        life_->context.draining = true;
        life_->drainEnd = process_.now() + model_.drainSeconds;
        life_->queue.drain();
    });
}

uint64_t SimulatedServer::iterations() const { return earlierIterations_ + (life_ ? life_->device.iterations() : 0); }

std::optional<std::string> SimulatedServer::brokenBound() const {
    if (!life_) return std::nullopt;
    const RenderQueue::Totals totals = life_->queue.totals();
    if (totals.jobs > model_.limits.jobs) return name_ + " has more jobs than its limit";
    if (totals.waitingResults > totals.jobs * model_.limits.leaseDepth) return name_ + " keeps too many results";
    return std::nullopt;
}

}  // namespace antipode::simulation
