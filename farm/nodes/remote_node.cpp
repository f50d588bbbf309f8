#include "farm/nodes/remote_node.h"

#include <algorithm>
#include <optional>
#include <random>

#include <asio/co_spawn.hpp>
#include <asio/detached.hpp>
#include <asio/redirect_error.hpp>
#include <asio/steady_timer.hpp>
#include <asio/use_awaitable.hpp>

#include "proto/wire/connection.h"

namespace antipode {
namespace {

/// A handshake can be spoilt once.
constexpr int rejectionsForGood = 3;
/// A supervisor starts a server anew whose device failed; one that fails every time does not bear this job.
constexpr int deviceFailuresForGood = 3;
constexpr double shortestPauseSeconds = 0.5, longestPauseSeconds = 30;

bool isForGood(farm::Refusal::Code code) {
    using farm::Refusal;
    return code == Refusal::INCOMPATIBLE || code == Refusal::TOO_LARGE || code == Refusal::BAD_SCENE ||
           code == Refusal::BAD_JOB;
}

std::string describePhase(const RemoteSession& session) {
    switch (session.phase()) {
        case RemoteSession::Phase::Greeting: return "greeting";
        case RemoteSession::Phase::Uploading:
            return "uploading " +
                   std::to_string(100 * session.uploadedBytes() / std::max<uint64_t>(session.uploadBytes(), 1)) + " %";
        case RemoteSession::Phase::Building: return "building";
        case RemoteSession::Phase::Ready: return "ready";
        case RemoteSession::Phase::Ended: return "ending";
    }
    return "";
}

}  // namespace

struct RemoteNode::Impl : std::enable_shared_from_this<Impl> {
    Impl(asio::io_context& ioContext, wire::Endpoint server, std::shared_ptr<const wire::Security> transport,
         std::shared_ptr<RemoteContext> shared)
        : io(ioContext), endpoint(std::move(server)), security(std::move(transport)), context(std::move(shared)) {
        status.name = endpoint.text();
        status.state = "connecting";
    }

    asio::io_context& io;
    wire::Endpoint endpoint;
    const std::shared_ptr<const wire::Security> security;
    const std::shared_ptr<RemoteContext> context;
    RemoteStatus status;
    bool stopping = false, running = false;
    std::minstd_rand jitter{std::random_device{}()};

    // Alive while the coroutine is where they are.
    wire::Connection* connection = nullptr;
    RemoteSession* session = nullptr;
    asio::steady_timer* pause = nullptr;

    asio::awaitable<void> keepConnected() {
        const auto self = shared_from_this();
        running = true;
        double pauseSeconds = shortestPauseSeconds;
        bool everReady = false;
        int rejections = 0, deviceFailures = 0;
        while (!stopping) {
            status.state = "connecting";
            const RemoteEnd end = co_await visit();
            if (stopping) break;
            if (end.wasReady) pauseSeconds = shortestPauseSeconds;
            everReady |= end.wasReady;
            rejections = end.rejected ? rejections + 1 : 0;
            deviceFailures += end.refusal == farm::Refusal::DEVICE_FAILED;
            // One that has been of use may be about to get its secret back.
            status.refusedForGood = isForGood(end.refusal) || (rejections >= rejectionsForGood && !everReady) ||
                                    deviceFailures >= deviceFailuresForGood;
            status.state = end.refusal == farm::Refusal::UNKNOWN && !end.rejected ? "lost" : "refused";
            status.detail = end.reason;
            if (status.refusedForGood) pauseSeconds = longestPauseSeconds;
            co_await wait(pauseSeconds * std::uniform_real_distribution(0.5, 1.0)(jitter));
            pauseSeconds = std::min(2 * pauseSeconds, longestPauseSeconds);
        }
        running = false;
    }

    /// Shows a connection to status() and stop() for as long as it lives.
    struct Shown {
        Shown(Impl& shownBy, wire::Connection& open, RemoteSession& conversation) : node(shownBy) {
            node.connection = &open;
            node.session = &conversation;
            ++node.status.connections;
        }
        ~Shown() {
            node.status.bytesReceived += node.connection->bytesReceived();
            node.status.bytesSent += node.connection->bytesSent();
            node.connection = nullptr;
            node.session = nullptr;
        }
        Shown(const Shown&) = delete;
        Shown& operator=(const Shown&) = delete;

        Impl& node;
    };

    /// One connection, from beginning to end.
    asio::awaitable<RemoteEnd> visit() {
        RemoteEnd end;
        std::optional<wire::Stream> stream;
        try {
            asio::ip::tcp::socket socket = co_await wire::connect(endpoint);
            stream.emplace(std::move(socket), *security, endpoint.host);
            co_await stream->handshake();
            if (stopping) co_return end;  // meanwhile
            wire::Connection open(std::move(*stream), {}, context->watch);
            stream.reset();
            RemoteSession conversation(*context, open, status.name, wire::monotonicSeconds());
            const Shown shown(*this, open, conversation);
            co_await open.run(conversation);
            end = conversation.end();
            end.rejected = open.rejected();
        } catch (const std::exception& error) {
            end.reason = error.what();
            end.rejected = stream && stream->rejected();
        }
        co_return end;
    }

    asio::awaitable<void> wait(double seconds) {
        asio::steady_timer timer(
            io, std::chrono::duration_cast<asio::steady_timer::duration>(std::chrono::duration<double>(seconds)));
        pause = &timer;
        asio::error_code cancelled;
        co_await timer.async_wait(asio::redirect_error(asio::use_awaitable, cancelled));
        pause = nullptr;
    }
};

RemoteNode::RemoteNode(asio::io_context& io, wire::Endpoint endpoint, std::shared_ptr<const wire::Security> security,
                       std::shared_ptr<RemoteContext> context)
    : impl_(std::make_shared<Impl>(io, std::move(endpoint), std::move(security), std::move(context))) {}

RemoteNode::~RemoteNode() = default;

void RemoteNode::start() { asio::co_spawn(impl_->io, impl_->keepConnected(), asio::detached); }

void RemoteNode::stop() {
    impl_->stopping = true;
    if (impl_->session) impl_->session->finish();
    if (impl_->pause) impl_->pause->cancel();
}

bool RemoteNode::stopped() const { return !impl_->running; }

RemoteStatus RemoteNode::status() const {
    RemoteStatus status = impl_->status;
    if (impl_->session) {
        const RemoteSession::Phase phase = impl_->session->phase();
        status.atWork = phase != RemoteSession::Phase::Greeting && phase != RemoteSession::Phase::Ended;
        status.state = describePhase(*impl_->session);
        status.detail.clear();
        status.device = impl_->session->welcome().device().name();
        status.bytesReceived += impl_->connection->bytesReceived();
        status.bytesSent += impl_->connection->bytesSent();
    }
    return status;
}

}  // namespace antipode
