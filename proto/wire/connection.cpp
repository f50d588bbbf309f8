#include "proto/wire/connection.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <optional>
#include <vector>

#include <asio/co_spawn.hpp>
#include <asio/redirect_error.hpp>
#include <asio/steady_timer.hpp>
#include <asio/this_coro.hpp>
#include <asio/use_awaitable.hpp>

#include "proto/farm.pb.h"

namespace antipode::wire {
namespace {

constexpr size_t readBytes = 64 << 10;
constexpr size_t writeBytes = 16 << 10;  ///< per write, a TLS record: small frames together, large ones in parts
constexpr double tickSeconds = 0.25;
constexpr double lastWordsSeconds = 0.25;  ///< for reading what the peer said before it stopped to listen

asio::awaitable<void> pause(asio::steady_timer& timer, double seconds) {
    timer.expires_after(std::chrono::microseconds(int64_t(std::clamp(seconds, 0., 3600.) * 1e6)));
    asio::error_code cancelled;
    auto token = asio::redirect_error(asio::use_awaitable, cancelled);
    co_await timer.async_wait(token);
}

}  // namespace

double monotonicSeconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A connection goes through three states: open; closing, from close() on, when what is queued still goes out and what
/// comes is thrown away; closed, when the socket is. Everything runs on one strand, so a timer that is cancelled finds
/// its coroutine either waiting for it or about to look at the state.
struct Connection::Impl {
    Impl(Stream connected, const ConnectionLimits& chosen, LoopWatch turns)
        : limits(chosen), watch(std::move(turns)), stream(std::move(connected)) {}

    void send(const Frame& frame) {
        if (closing || writeFailed) return;
        std::string bytes = encodeFrame(frame);
        if (bytes.size() > limits.queuedBytes - queuedBytes) return end("more is queued than the peer ever takes");
        queuedBytes += bytes.size();
        queue.push_back(std::move(bytes));
        wakeWriter();
    }

    void close(const std::string& why) {
        if (closing) return;
        closing = true;
        reason = why;
        setDeadline(limits.flushSeconds);
        wakeWriter();
    }

    /// Closes at once. The reason counts unless an earlier one led here.
    void end(const std::string& why) {
        if (!closing) reason = why;
        closing = closed = true;
        queue.clear();
        queuedBytes = 0;
        stream.close();
        wakeWriter();
        wakeRun();
    }

    asio::awaitable<void> read(Session& session) {
        FrameReader frames;
        std::vector<char> buffer(readBytes);
        const asio::mutable_buffer space = asio::buffer(buffer);
        while (!closed) {
            size_t bytes = 0;
            try {
                bytes = co_await stream.readSome(space);
            } catch (const asio::system_error& error) {
                // A peer that has finished sending may still take what is queued.
                if (!closing) end(error.what());
                co_return;
            }
            bytesReceived += bytes;
            if (closing) continue;
            guarded([&] {
                session.heard(monotonicSeconds());
                frames.feed({buffer.data(), bytes});
                while (!closing) {
                    const std::optional<Frame> frame = frames.next();
                    if (!frame) break;
                    watch.run([&] { return "frame " + std::to_string(int(frame->type)) + " of " + stream.peer(); },
                              [&] { session.receive(*frame, monotonicSeconds()); });
                }
            });
        }
    }

    asio::awaitable<void> write(Session& session) {
        std::string block;
        while (!closed) {
            if (queue.empty()) {
                if (closing) break;
                co_await pause(*writerTimer, 3600);
                continue;
            }
            takeBlock(block);
            const asio::const_buffer bytes = asio::buffer(block);
            writeStart = monotonicSeconds();
            try {
                co_await stream.write(bytes);
            } catch (const asio::system_error& error) {
                writeFailed = error.what();
                setDeadline(lastWordsSeconds);
                break;
            }
            writeStart.reset();
            if (closed) break;
            queuedBytes -= block.size();
            bytesSent += block.size();
            if (!closing && queuedBytes < maxPayloadBytes) tick(session);
        }
        writeStart.reset();
        // The peer sees the end and ends too; closing with bytes unread would reset the connection and take from the
        // peer what it has not read yet.
        if (!closed) stream.finishSending();
    }

    asio::awaitable<void> run(Session& session) {
        // Cancelling this coroutine must not leave the two others behind.
        co_await asio::this_coro::throw_if_cancelled(false);
        const asio::any_io_executor executor = co_await asio::this_coro::executor;
        writerTimer.emplace(executor);
        runTimer.emplace(executor);
        spawn(executor, read(session));
        spawn(executor, write(session));
        double nextTick = monotonicSeconds() + tickSeconds;
        while (running > 0) {
            const asio::cancellation_state cancellation = co_await asio::this_coro::cancellation_state;
            if (cancellation.cancelled() != asio::cancellation_type::none) end("cancelled");
            const double now = monotonicSeconds();
            if (deadline && now >= *deadline) end(writeFailed.value_or(reason));
            if (writeStart && now > *writeStart + limits.stallSeconds) end("the peer does not take what it is sent");
            if (now >= nextTick) {
                if (!closing) tick(session);
                nextTick = now + tickSeconds;
            }
            const double next = deadline && !closed ? std::min(nextTick, *deadline) : nextTick;
            if (running > 0) co_await pause(*runTimer, next - monotonicSeconds());
        }
        end(writeFailed.value_or("closed"));
        session.disconnected(reason, monotonicSeconds());
    }

    void spawn(const asio::any_io_executor& executor, asio::awaitable<void> task) {
        ++running;
        const auto ended = [this](const std::exception_ptr& failure) {
            --running;
            if (failure) end(sentenceOf(failure));
            wakeRun();
        };
        asio::co_spawn(executor, std::move(task), ended);
    }

    static std::string sentenceOf(const std::exception_ptr& failure) {
        try {
            std::rethrow_exception(failure);
        } catch (const std::exception& error) {
            return error.what();
        }
    }

    void tick(Session& session) {
        guarded([&] {
            watch.run([&] { return "the tick of " + stream.peer(); }, [&] { session.tick(monotonicSeconds()); });
        });
    }

    /// Calls the session: what it throws ends the connection and nothing else.
    template <class Call>
    void guarded(const Call& call) {
        try {
            call();
        } catch (const ProtocolError& error) {
            farm::Refusal refusal;
            refusal.set_code(farm::Refusal::PROTOCOL);
            refusal.set_sentence(error.what());
            send(makeFrame(FrameType::Refusal, refusal));
            close(std::string("protocol error: ") + error.what());
        } catch (const std::exception& error) {
            close(error.what());
        }
    }

    /// The next bytes of the queue, at most `writeBytes`; they count as queued until they are written.
    void takeBlock(std::string& block) {
        block.clear();
        while (!queue.empty() && block.size() < writeBytes) {
            const std::string& front = queue.front();
            const size_t bytes = std::min(front.size() - frontTaken, writeBytes - block.size());
            block.append(front, frontTaken, bytes);
            frontTaken += bytes;
            if (frontTaken < front.size()) break;
            queue.pop_front();
            frontTaken = 0;
        }
    }

    void setDeadline(double seconds) {
        const double time = monotonicSeconds() + seconds;
        deadline = std::min(deadline.value_or(time), time);
        wakeRun();
    }
    void wakeWriter() {
        if (writerTimer) writerTimer->cancel();
    }
    void wakeRun() {
        if (runTimer) runTimer->cancel();
    }

    const ConnectionLimits limits;
    const LoopWatch watch;
    Stream stream;
    std::deque<std::string> queue;  ///< encoded frames
    size_t frontTaken = 0;          ///< bytes of the front that are in a block already
    size_t queuedBytes = 0;
    uint64_t bytesReceived = 0, bytesSent = 0;

    bool closing = false, closed = false;
    std::string reason;
    std::optional<std::string> writeFailed;  ///< how
    std::optional<double> deadline;          ///< when the socket is closed
    std::optional<double> writeStart;        ///< of the write under way
    int running = 0;                         ///< of reader and writer
    std::optional<asio::steady_timer> writerTimer, runTimer;
};

Connection::Connection(Stream stream, const ConnectionLimits& limits, LoopWatch watch)
    : impl_(std::make_unique<Impl>(std::move(stream), limits, std::move(watch))) {}
Connection::~Connection() = default;

void Connection::send(Frame frame) { impl_->send(frame); }
size_t Connection::queuedBytes() const { return impl_->queuedBytes; }
void Connection::close(const std::string& reason) { impl_->close(reason); }

asio::awaitable<void> Connection::run(Session& session) { return impl_->run(session); }

uint64_t Connection::bytesReceived() const { return impl_->bytesReceived; }
uint64_t Connection::bytesSent() const { return impl_->bytesSent; }
std::string Connection::peer() const { return impl_->stream.peer(); }
bool Connection::rejected() const { return impl_->stream.rejected(); }

}  // namespace antipode::wire
