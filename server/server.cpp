#include "server/server.h"

#include <csignal>
#include <cstdlib>
#include <random>

#include <asio/executor_work_guard.hpp>
#include <asio/post.hpp>
#include <asio/signal_set.hpp>
#include <asio/steady_timer.hpp>
#include <asio/thread_pool.hpp>
#include <spdlog/spdlog.h>
#include <sys/resource.h>

#include "renderengine/version.h"
#include "terminal/metrics_page.h"
#include "renderengine/devices.h"
#include "renderengine/engine.h"
#include "renderengine/error.h"
#include "server/listener.h"
#include "server/relay/network_children.h"
#include "terminal/exit_codes.h"

namespace antipode {
namespace {

constexpr auto tickInterval = std::chrono::milliseconds(250), relayInterval = std::chrono::milliseconds(10);
constexpr double lastWordsSeconds = 2;

/// Connections are descriptors, and the default limit is small.
void raiseDescriptorLimit() {
    rlimit limit{};
    if (::getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur == limit.rlim_max) return;
    limit.rlim_cur = limit.rlim_max;
    ::setrlimit(RLIMIT_NOFILE, &limit);
}

/// What clients are told first; what renders they learn once the job is ready.
farm::Device relayDevice() {
    farm::Device device;
    device.set_name("relay");
    device.set_kind("relay");
    device.set_driver("none");
    device.set_device_class("relay");
    return device;
}

farm::Welcome makeWelcome(const farm::Device& device, const ServerOptions& options) {
    farm::Welcome welcome;
    welcome.set_build(versionText);
    welcome.set_kernel_hash(options.kernelHash);
    *welcome.mutable_device() = device;
    welcome.set_lease_depth(options.limits.leaseDepth);
    return welcome;
}

void writeLog(const std::string& client, const std::string& event) { spdlog::info("{}: {}", client, event); }

}  // namespace

struct Server::Impl {
    /// Without a factory, a relay.
    Impl(const ServerOptions& serverOptions, const farm::Device& described, RendererFactory factory)
        : options(serverOptions),
          security(readSecurity()),
          cache(options.cacheFolder, options.cacheBytes),
          relay(factory ? nullptr : makeRelay()),
          device(factory ? std::make_unique<ThreadBlockWorker>(std::move(factory)) : nullptr),
          queue(relay ? static_cast<BlockWorker&>(*relay) : *device, options.limits,
                [this](std::function<void()> call) { post("the worker", std::move(call)); }),
          context{queue, cache, makeWelcome(described, options), {}, false, inBackground(loader), writeLog},
          listener(io, options.listen, security, context) {
        context.watch = watch;
        if (options.metrics) metrics = std::make_unique<MetricsPage>(*options.metrics);
    }

    /// Connections refer to what is destroyed before the io_context: none may be left in it.
    ~Impl() {
        loader.join();
        end();
        adder.join();
        io.restart();
        io.run();
    }

    /// To the event loop, for somebody on another thread.
    void post(const char* whom, std::function<void()> call) {
        asio::post(io, [this, whom, call = std::move(call)] {
            watch.run([whom] { return std::string("an answer to ") + whom; }, call);
        });
    }

    Background inBackground(asio::thread_pool& thread) {
        return [this, &thread](std::function<void()> work, std::function<void()> done) {
            asio::post(thread, [this, work = std::move(work), done = std::move(done)]() mutable {
                work();
                post("another thread", std::move(done));
            });
        };
    }

    std::unique_ptr<RelayWorker> makeRelay() {
        // What is unfit is to be told now, and not when the first job comes.
        const wire::Security asClient(options.relayed.security, wire::Security::Role::Client);
        if (!options.relayed.serversFile.empty()) const ServersFile file(options.relayed.serversFile);
        RelayOptions ofRelay;
        ofRelay.build = versionText;
        ofRelay.kernelHash = options.kernelHash;
        ofRelay.name = "relay on port " + options.listen.port;
        ofRelay.verifyFraction = options.relayedVerifyFraction;
        ofRelay.verifySeed = std::random_device{}();
        ofRelay.blocks = options.limits.leaseDepth;
        ofRelay.watch = watch;
        return std::make_unique<RelayWorker>(std::move(ofRelay), networkChildren(io, options.relayed),
                                             inBackground(adder), wire::monotonicSeconds,
                                             [](const std::string& event) { spdlog::info("{}", event); });
    }

    /// What servers say is answered within this time, and leases follow one another.
    void scheduleRelayTick() {
        if (!relay) return;
        relayTicker.expires_after(relay->idle() ? tickInterval : relayInterval);
        relayTicker.async_wait([this](const asio::error_code& error) {
            if (error || ended) return;
            watch.run([] { return "the relay's tick"; }, [this] { relay->tick(); });
            scheduleRelayTick();
        });
    }

    void tick() {
        const double now = wire::monotonicSeconds();
        queue.tick(now);
        listener.tick(now);
        publishMetrics();
        if (!queue.deviceLoss().empty()) return endLost(now);
        if (context.draining && (now > drainEnd || (queue.idle() && listener.totals().clients == 0))) end();
    }

    /// Gives clients the time to read why.
    void endLost(double now) {
        if (!lostSince) {
            spdlog::error("{} The process ends with exit code {}, to be started anew.", queue.deviceLoss(),
                          int(exitDeviceLost));
            lostSince = now;
            listener.stopAccepting();
        }
        if (listener.totals().clients == 0 || now - *lostSince > lastWordsSeconds) end();
    }

    void scheduleTick() {
        ticker.expires_after(tickInterval);
        ticker.async_wait([this](const asio::error_code& error) {
            if (error || ended) return;
            watch.run([] { return "the server's tick"; }, [this] { tick(); });
            scheduleTick();
        });
    }

    /// Leaves the io_context without work once the connections have closed, which takes them two seconds at most.
    void end() {
        ended = true;
        listener.stopAccepting();
        listener.closeAll("the server is going down");
        signals.cancel();
        ticker.cancel();
        relayTicker.cancel();
        if (relay) relay->stop();
    }

    void awaitSignal() {
        signals.async_wait([this](const asio::error_code& error, int signal) {
            if (error) return;
            if (signal == SIGHUP && options.security.any()) {
                reloadSecurity();
                return awaitSignal();
            }
            if (context.draining) {
                spdlog::warn("second signal: stopping at once");
                spdlog::shutdown();
                std::_Exit(128 + signal);
            }
            beginDrain();
            awaitSignal();
        });
    }

    std::shared_ptr<const wire::Security> readSecurity() const {
        return std::make_shared<const wire::Security>(options.security, wire::Security::Role::Server);
    }

    /// Goes on with the old ones where the new ones are unfit.
    void reloadSecurity() {
        try {
            security = readSecurity();
        } catch (const Error& error) {
            spdlog::error("SIGHUP: secret and certificates stay as they were: {}", error.what());
            return;
        }
        spdlog::info("SIGHUP: secret and certificates have been read again");
        listener.secure(security);
    }

    void beginDrain() {
        if (context.draining) return;
        spdlog::info("draining: no new leases, at most {} s for clients to fetch what is rendered",
                     options.drainSeconds);
        context.draining = true;
        drainEnd = wire::monotonicSeconds() + options.drainSeconds;
        listener.stopAccepting();
        queue.drain();
    }

    void publishMetrics() {
        if (!metrics) return;
        const RenderQueue::Totals work = queue.totals();
        const Listener::Totals net = listener.totals();
        using enum Metric::Kind;
        std::vector<Metric> values{
            {"antipode_server_iterations_total", "Iterations rendered", Counter, {}, double(work.iterations)},
            {"antipode_server_blocks_total", "Blocks of iterations rendered", Counter, {}, double(work.blocks)},
            {"antipode_server_busy_seconds_total", "Time that the device rendered", Counter, {}, work.busySeconds},
            {"antipode_server_jobs", "Jobs that are open", Gauge, {}, double(work.jobs)},
            {"antipode_server_waiting_results",
             "Results that wait for their client",
             Gauge,
             {},
             double(work.waitingResults)},
            {"antipode_server_connections", "Connections by kind", Gauge, {{"kind", "client"}}, double(net.clients)},
            {"antipode_server_connections", "", Gauge, {{"kind", "stranger"}}, double(net.strangers)},
            {"antipode_server_accepted_total", "Connections accepted", Counter, {}, double(net.accepted)},
            {"antipode_server_received_bytes_total", "Bytes received", Counter, {}, double(net.bytesReceived)},
            {"antipode_server_sent_bytes_total", "Bytes sent", Counter, {}, double(net.bytesSent)},
            {"antipode_server_cache_bytes", "Bytes in the scene cache", Gauge, {}, double(cache.bytes())},
            {"antipode_server_draining", "Whether the server is going down", Gauge, {}, context.draining ? 1.0 : 0.0},
        };
        if (relay) {
            const RelayWorker::Totals relayed = relay->totals();
            values.push_back({"antipode_relay_servers",
                              "Servers that have a job of this relay, each as often as it has one",
                              Gauge,
                              {},
                              double(relayed.servers)});
            values.push_back(
                {"antipode_relay_width", "Iterations that they render side by side", Gauge, {}, double(relayed.width)});
            values.push_back(
                {"antipode_relay_blocks_total", "Blocks put together", Counter, {}, double(relayed.blocks)});
        }
        metrics->publish(values);
    }

    ServerOptions options;
    const wire::LoopWatch watch =
        wire::LoopWatch::ofThisBuild([](const std::string& sentence) { spdlog::warn("{}", sentence); });
    asio::io_context io{1};
    asio::thread_pool loader{1};  ///< assembles scenes
    asio::thread_pool adder{1};   ///< hashes a relay's sums, which may not wait for a scene
    asio::steady_timer ticker{io}, relayTicker{io};
    asio::signal_set signals{io, SIGINT, SIGTERM, SIGHUP};
    std::shared_ptr<const wire::Security> security;
    SceneCache cache;
    const std::unique_ptr<RelayWorker> relay;  ///< one of the two
    const std::unique_ptr<ThreadBlockWorker> device;
    RenderQueue queue;
    ServerContext context;
    Listener listener;
    std::unique_ptr<MetricsPage> metrics;
    double drainEnd = 0;
    std::optional<double> lostSince;  ///< the device
    bool ended = false;
};

Server::Server(const ServerOptions& options, const farm::Device& device, RendererFactory factory) {
    raiseDescriptorLimit();
    impl_ = std::make_unique<Impl>(options, device, std::move(factory));
}

Server::Server(const ServerOptions& options) : Server(options, relayDevice(), nullptr) {}

Server::~Server() = default;

uint16_t Server::port() const { return impl_->listener.port(); }

void Server::run() {
    const farm::Device& device = impl_->context.welcome.device();
    if (impl_->relay)
        spdlog::info("antipode-server {} as a relay", versionText);
    else
        spdlog::info("antipode-server {} on {} ({})", versionText, device.name(), device.driver());
    spdlog::info("listening on {}:{}, {}", impl_->options.listen.host, port(),
                 impl_->security->encrypted() ? "encrypted" : "without encryption, loopback only");
    impl_->listener.start();
    impl_->awaitSignal();
    impl_->scheduleTick();
    impl_->scheduleRelayTick();
    impl_->io.run();
    spdlog::info("stopped");
}

bool Server::deviceLost() const { return impl_->lostSince.has_value(); }

void Server::drain() {
    asio::post(impl_->io, [this] { impl_->beginDrain(); });
}

farm::Device describeDevice(const DeviceInfo& device) {
    farm::Device message;
    message.set_name(device.name);
    message.set_kind(device.kind);
    message.set_driver(device.driver);
    message.set_memory_bytes(device.memoryBytes);
    message.set_device_class(deviceClass(device));
    return message;
}

}  // namespace antipode
