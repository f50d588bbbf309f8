#include "farm/nodes/farm.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <random>

#include <asio/executor_work_guard.hpp>
#include <asio/io_context.hpp>
#include <asio/post.hpp>
#include <unistd.h>

#include "farm/nodes/local_node.h"
#include "farm/nodes/server_list.h"
#include "proto/wire/job_messages.h"
#include "renderengine/devices.h"
#include "renderengine/engine.h"

namespace antipode {
namespace {

constexpr double shutDownSeconds = 2, patienceSeconds = 5;

std::string randomJobId() {
    std::random_device random;
    std::string id;
    while (id.size() < 16) id.push_back(char(random()));
    return id;
}

std::string thisClient() {
    char host[256] = "";
    ::gethostname(host, sizeof host - 1);
    return std::string(host) + "/" + std::to_string(::getpid());
}

farm::Hello makeHello(const std::string& build, const JobDefinition& job) {
    farm::Hello hello;
    hello.set_oldest_protocol(wire::protocolVersion);
    hello.set_newest_protocol(wire::protocolVersion);
    hello.set_build(build);
    hello.set_kernel_hash(job.kernelHash);
    hello.set_client(thisClient());
    return hello;
}

farm::BlobRef rootOf(const wire::ScenePackage& package) {
    return package.blobs.empty() ? farm::BlobRef() : package.root();
}

bool isServing(const NodeStatus& node) {
    return node.state == NodeStatus::State::Idle || node.state == NodeStatus::State::Rendering ||
           node.state == NodeStatus::State::Stalled;
}

std::string describe(NodeStatus::State state) {
    switch (state) {
        case NodeStatus::State::Idle: return "idle";
        case NodeStatus::State::Rendering: return "rendering";
        case NodeStatus::State::Stalled: return "stalled";
        case NodeStatus::State::Gone: return "gone";
        case NodeStatus::State::Quarantined: return "quarantined";
    }
    return "";
}

NodeReport named(const std::string& name, const std::string& state) {
    NodeReport report;
    report.name = name;
    report.state = state;
    return report;
}

}  // namespace

struct Farm::Impl {
    Impl(const FarmOptions& farmOptions, std::shared_ptr<const Scene> jobScene, const JobDefinition& job,
         Coordinator& jobCoordinator)
        : options(farmOptions),
          scene(std::move(jobScene)),
          coordinator(jobCoordinator),
          budget(options.reassemblyBytes) {
        if (options.servers.any()) package = wire::packageScene(*scene);
        context = std::make_shared<RemoteContext>(RemoteContext{
            coordinator, package,
            wire::makeOpenJob(randomJobId(), job.settings, rootOf(package), job.sceneHash, job.kernelHash),
            makeHello(options.build, job), budget, wire::Liveness{},
            wire::LoopWatch::ofThisBuild([this](const std::string& sentence) { messages.push_back(sentence); })});
        if (options.local) openLocal(job);
        servers.emplace(*io, options.servers, context);
        started = idleSince = wire::monotonicSeconds();
    }

    /// In this order: the worker's thread posts to the loop, and the loop's coroutines refer to all the rest.
    ~Impl() {
        over = true;
        localNode.reset();
        worker.reset();
        work.reset();
        io.reset();
    }

    void openLocal(const JobDefinition& job) {
        const DeviceInfo device = selectDevice(options.device);
        const std::string selector = device.uuid;
        worker = std::make_unique<ThreadBlockWorker>(
            [this, selector](const Scene& toRender, const RenderSettings& settings) -> std::unique_ptr<Renderer> {
                return std::make_unique<Engine>(toRender, settings, selector,
                                                [this](const char* next) { setUpStep(next); });
            });
        localNode = std::make_unique<LocalNode>(
            LocalNodeContext{coordinator, *worker,
                             [this](std::function<void()> call) { asio::post(*io, std::move(call)); },
                             wire::monotonicSeconds, [this](const Error& error) { localFailure.emplace(error); }},
            device.name, deviceClass(device), scene, job.settings);
    }

    /// On the worker's thread. A job that is over, because servers rendered it or failed it, does not wait for the
    /// rest.
    void setUpStep(const char* next) {
        if (over) throw Error(ErrorCode::Device, "The job has ended before this device was ready.");
        asio::post(*io, [this, step = std::string(next)] { localStep = step; });
    }

    /// Waits for the next event, 10 ms or until `end` at most.
    void step(double end) {
        const double wait = std::clamp(end - wire::monotonicSeconds(), 0.0, 0.01);
        io->run_one_for(std::chrono::microseconds(int64_t(1e6 * wait)));
        io->poll();
        const double now = wire::monotonicSeconds();
        coordinator.tick(now);
        servers->tick(now);
        watch(now);
    }

    /// Says what has become of the nodes.
    void watch(double now) {
        const size_t ready = readyNodes();
        everReady |= ready > 0;
        for (std::string& message : coordinator.takeMessages()) messages.push_back(std::move(message));
        if (localFailure && !localFailureTold) {
            localFailureTold = true;
            messages.push_back(std::string("the local device has failed: ") + localFailure->what());
        }
        for (std::string& message : servers->takeMessages()) messages.push_back(std::move(message));
        if (anyAtWork()) idleSince = now;
        if (ready > 0) {
            waitingSince = now;
            waitingTold = false;
        } else if (!waitingTold && hopeless().empty() && now - std::max(waitingSince, started) > patienceSeconds &&
                   !options.local) {
            waitingTold = true;
            messages.push_back(std::string(everReady          ? "no server is left; waiting for one to return"
                                           : servers->empty() ? "the servers file names no server; waiting for one"
                                                              : "waiting for a server to be ready") +
                               (options.waitsForEver ? " (--wait SECONDS bounds this)" : ""));
        }
    }

    bool anyAtWork() const {
        return (options.local && !localFailure) || std::ranges::any_of(servers->status(), &RemoteStatus::atWork);
    }

    size_t readyNodes() const {
        size_t count = 0;
        for (const NodeStatus& node : coordinator.nodes()) count += isServing(node);
        return count;
    }

    std::string hopeless() const {
        if (options.local && !localFailure) return "";
        if (servers->hasFile() && (everReady || servers->empty())) return "";
        std::string reason;
        if (localFailure) reason = localFailure->what();
        std::map<std::string, std::string> quarantined;
        for (const NodeStatus& node : coordinator.nodes())
            if (node.state == NodeStatus::State::Quarantined)
                quarantined.emplace(node.description.name, node.quarantine);
        for (const RemoteStatus& status : servers->status()) {
            const auto found = quarantined.find(status.name);
            if (!status.refusedForGood && found == quarantined.end()) return "";
            if (!reason.empty()) continue;
            reason = found == quarantined.end() ? status.name + " refuses: " + status.detail
                                                : status.name + " is not used any more: " + found->second;
        }
        return reason;
    }

    std::vector<NodeReport> reports() const {
        std::map<std::string, NodeStatus> statuses;
        for (const NodeStatus& node : coordinator.nodes()) statuses.emplace(node.description.name, node);
        std::vector<NodeReport> reports;
        const auto add = [&](NodeReport report) {
            if (const auto found = statuses.find(report.name); found != statuses.end()) {
                const NodeStatus& node = found->second;
                report.device = node.description.deviceName;
                report.iterationsPerSecond = node.iterationsPerSecond;
                report.leases = node.leases;
                report.committed = node.committed;
                report.results = node.results;
                report.lost = node.lost;
                const bool present = isServing(node) || node.state == NodeStatus::State::Quarantined;
                if (present && (report.state == "ready" || report.local)) report.state = describe(node.state);
                statuses.erase(found);
            }
            reports.push_back(std::move(report));
        };
        if (options.local) {
            NodeReport report = named("local", localFailure ? "failed" : localStep);
            report.local = true;
            if (localFailure) report.detail = localFailure->what();
            add(report);
        }
        for (const RemoteStatus& status : servers->status()) {
            NodeReport report = named(status.name, status.state);
            report.device = status.device;
            report.detail = status.detail;
            report.bytesReceived = status.bytesReceived;
            report.bytesSent = status.bytesSent;
            report.connections = status.connections;
            add(std::move(report));
        }
        // Servers that are no longer in the list may have contributed.
        for (const auto& [name, node] : std::map(statuses)) add(named(name, describe(node.state)));
        return reports;
    }

    FarmOptions options;
    std::shared_ptr<const Scene> scene;
    Coordinator& coordinator;
    wire::ScenePackage package;
    ReassemblyBudget budget;
    std::shared_ptr<RemoteContext> context;
    std::unique_ptr<asio::io_context> io = std::make_unique<asio::io_context>(1);
    asio::executor_work_guard<asio::io_context::executor_type> work = asio::make_work_guard(*io);
    std::optional<ServerList> servers;
    std::unique_ptr<ThreadBlockWorker> worker;
    std::unique_ptr<LocalNode> localNode;
    std::optional<Error> localFailure;
    std::string localStep = "building";  ///< until it is ready
    std::atomic<bool> over = false;
    std::vector<std::string> messages;
    bool everReady = false, localFailureTold = false, waitingTold = false;
    double started = 0, waitingSince = 0, idleSince = 0;
};

Farm::Farm(const FarmOptions& options, std::shared_ptr<const Scene> scene, const JobDefinition& job,
           Coordinator& coordinator)
    : impl_(std::make_unique<Impl>(options, std::move(scene), job, coordinator)) {}

Farm::~Farm() = default;

void Farm::runFor(double seconds) {
    const double end = wire::monotonicSeconds() + seconds;
    const bool wasReady = impl_->everReady;
    do {
        impl_->step(end);
    } while (wire::monotonicSeconds() < end && !impl_->coordinator.complete() && impl_->everReady == wasReady);
}

bool Farm::everReady() const { return impl_->everReady; }
size_t Farm::readyNodes() const { return impl_->readyNodes(); }
std::string Farm::hopeless() const { return impl_->hopeless(); }
double Farm::idleSeconds() const { return wire::monotonicSeconds() - impl_->idleSince; }
std::string Farm::complaints() const { return impl_->servers->complaints(); }

void Farm::shutDown() {
    impl_->servers->stop();
    const double end = wire::monotonicSeconds() + shutDownSeconds;
    while (!impl_->servers->stopped() && wire::monotonicSeconds() < end)
        impl_->io->run_one_for(std::chrono::milliseconds(10));
}

std::vector<NodeReport> Farm::nodes() const { return impl_->reports(); }

std::optional<JobReady> Farm::localReady() const { return impl_->localNode ? impl_->localNode->ready() : std::nullopt; }

std::vector<std::string> Farm::takeMessages() { return std::exchange(impl_->messages, {}); }

}  // namespace antipode
