#include "support/fault_proxy.h"

#include <atomic>
#include <chrono>
#include <future>
#include <list>
#include <mutex>
#include <random>
#include <string>
#include <thread>

#include <asio/co_spawn.hpp>
#include <asio/detached.hpp>
#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <asio/post.hpp>
#include <asio/redirect_error.hpp>
#include <asio/steady_timer.hpp>
#include <asio/use_awaitable.hpp>
#include <asio/write.hpp>

namespace antipode::test {
namespace {

using asio::ip::tcp;

enum class Fault { None, Split, Coalesce, Delay, Stall, Flip, Duplicate, Drop, Truncate, Reset };

/// The faults of one direction of one connection, segment by segment.
class Schedule {
public:
    Schedule(const FaultOptions& options, uint64_t connection, uint64_t direction)
        : options_(options), random_(options.seed * 0x9E3779B97F4A7C15ull + connection * 2 + direction) {}

    struct Segment {
        uint32_t bytes;
        Fault fault;
        double fraction;  ///< in [0, 1): which bit, how long
    };

    Segment next() {
        std::uniform_int_distribution<uint32_t> length(1, 2 * options_.meanSegmentBytes);
        std::uniform_real_distribution<double> unit;
        Segment segment{length(random_), Fault::None, 0};
        double draw = unit(random_);
        segment.fraction = unit(random_);
        const std::pair<Fault, double> faults[] = {
            {Fault::Split, options_.split}, {Fault::Coalesce, options_.coalesce},
            {Fault::Delay, options_.delay}, {Fault::Stall, options_.stall},
            {Fault::Flip, options_.flip},   {Fault::Duplicate, options_.duplicate},
            {Fault::Drop, options_.drop},   {Fault::Truncate, options_.truncate},
            {Fault::Reset, options_.reset}};
        for (const auto& [fault, probability] : faults) {
            if (draw < probability) {
                segment.fault = fault;
                break;
            }
            draw -= probability;
        }
        const bool harmful = segment.fault >= Fault::Stall;
        if (harmful && offset_ < options_.unharmedBytes) segment.fault = Fault::None;
        offset_ += segment.bytes;
        return segment;
    }

private:
    const FaultOptions& options_;
    std::mt19937_64 random_;
    uint64_t offset_ = 0;
};

struct Link {
    explicit Link(tcp::socket accepted) : client(std::move(accepted)), target(client.get_executor()) {}

    void close() {
        asio::error_code ignored;
        client.close(ignored);
        target.close(ignored);
    }
    void reset() {
        asio::error_code ignored;
        for (tcp::socket* socket : {&client, &target}) socket->set_option(asio::socket_base::linger(true, 0), ignored);
        close();
    }

    tcp::socket client, target;
};

}  // namespace

struct FaultProxy::Impl {
    Impl(uint16_t target, const FaultOptions& chosen)
        : options(chosen), targetPort(target), acceptor(context, tcp::endpoint(asio::ip::address_v4::loopback(), 0)) {
        asio::co_spawn(context, accept(), asio::detached);
        thread = std::thread([this] { context.run(); });
    }
    ~Impl() { stop(); }

    void stop() {
        if (!thread.joinable()) return;
        asio::post(context, [this] {
            acceptor.close();
            closeLinks();
            context.stop();
        });
        thread.join();
    }

    void closeLinks() {
        for (const std::weak_ptr<Link>& weak : links)
            if (const std::shared_ptr<Link> link = weak.lock()) link->close();
    }

    asio::awaitable<void> accept() {
        for (uint64_t number = 0;; ++number) {
            tcp::socket socket = co_await acceptor.async_accept(asio::use_awaitable);
            auto link = std::make_shared<Link>(std::move(socket));
            links.remove_if([](const std::weak_ptr<Link>& old) { return old.expired(); });
            links.push_back(link);
            count([](FaultCounters& c) { ++c.connections; });
            asio::co_spawn(context, open(link, number), asio::detached);
        }
    }

    asio::awaitable<void> open(std::shared_ptr<Link> link, uint64_t number) {
        asio::error_code code;
        auto token = asio::redirect_error(asio::use_awaitable, code);
        const tcp::endpoint address(asio::ip::address_v4::loopback(), targetPort);
        co_await held(toTargetHeld);
        co_await link->target.async_connect(address, token);
        if (code) {
            link->reset();
            co_return;
        }
        for (tcp::socket* socket : {&link->client, &link->target}) socket->set_option(tcp::no_delay(true), code);
        asio::co_spawn(context, pipe(link, link->client, link->target, toTargetHeld, Schedule(options, number, 0)),
                       asio::detached);
        asio::co_spawn(context, pipe(link, link->target, link->client, toClientHeld, Schedule(options, number, 1)),
                       asio::detached);
    }

    /// Copies one direction, and its end, segment by segment.
    asio::awaitable<void> pipe(std::shared_ptr<Link> link, tcp::socket& from, tcp::socket& to,
                               const std::atomic<bool>& hold, Schedule schedule) {
        asio::error_code code;
        auto token = asio::redirect_error(asio::use_awaitable, code);
        std::string buffer(16384, '\0'), out;
        while (true) {
            const Schedule::Segment segment = schedule.next();
            const uint32_t half = segment.bytes / 2;
            bool begun = false;
            for (uint32_t done = 0; done < segment.bytes;) {
                const size_t most = std::min<size_t>(buffer.size(), segment.bytes - done);
                const auto space = asio::buffer(buffer.data(), most);
                const size_t bytes = co_await from.async_read_some(space, token);
                co_await held(hold);
                if (code) {
                    co_await flush(*link, to, out);
                    if (code == asio::error::eof)
                        to.shutdown(tcp::socket::shutdown_send, code);
                    else
                        link->reset();
                    co_return;
                }
                const bool first = !begun;
                if (first) countFault(segment.fault);
                begun = true;
                out.append(buffer, 0, bytes);
                done += uint32_t(bytes);
                switch (segment.fault) {
                    case Fault::None: break;
                    case Fault::Split: co_await trickle(*link, to, out, first ? 256 : 0); break;
                    case Fault::Coalesce:
                        // What comes in the meantime gathers in the socket.
                        co_await sleep(options.delaySeconds / 2);
                        if (from.available(code) > 0 && done < segment.bytes && out.size() < 65536) continue;
                        break;
                    case Fault::Delay:
                        if (first) co_await sleep(segment.fraction * options.delaySeconds);
                        break;
                    case Fault::Stall:
                        if (first) co_await sleep(options.stallSeconds);
                        break;
                    case Fault::Flip:
                        if (first) out.front() = char(out.front() ^ (1 << int(segment.fraction * 8)));
                        break;
                    case Fault::Duplicate:
                        if (first) out.insert(0, out.substr(0, 64));
                        break;
                    case Fault::Drop: out.clear(); break;
                    case Fault::Truncate:
                        if (done < half) break;
                        out.resize(out.size() - std::min<size_t>(out.size(), done - half));
                        co_await flush(*link, to, out);
                        link->close();
                        co_return;
                    case Fault::Reset: link->reset(); co_return;
                }
                co_await flush(*link, to, out);
            }
        }
    }

    /// Writes and empties `out`.
    asio::awaitable<void> flush(Link& link, tcp::socket& to, std::string& out) {
        asio::error_code code;
        auto token = asio::redirect_error(asio::use_awaitable, code);
        const auto bytes = asio::buffer(out);
        co_await asio::async_write(to, bytes, token);
        if (code) link.reset();
        count([&out](FaultCounters& c) { c.bytes += out.size(); });
        out.clear();
    }

    /// Writes up to `most` bytes in small pieces and takes them off `out`.
    asio::awaitable<void> trickle(Link& link, tcp::socket& to, std::string& out, size_t most) {
        std::string piece;
        for (size_t sent = 0, size = 1; sent < most && !out.empty(); sent += size, size = size % 16 + 1) {
            piece = out.substr(0, size);
            out.erase(0, size);
            co_await flush(link, to, piece);
        }
    }

    asio::awaitable<void> sleep(double seconds) {
        asio::steady_timer timer(context, std::chrono::microseconds(int64_t(seconds * 1e6)));
        co_await timer.async_wait(asio::use_awaitable);
    }

    asio::awaitable<void> held(const std::atomic<bool>& hold) {
        while (hold) co_await sleep(0.002);
    }

    template <class Change>
    void count(const Change& change) {
        const std::lock_guard lock(mutex);
        change(counters);
    }

    void countFault(Fault fault) {
        count([fault](FaultCounters& c) {
            switch (fault) {
                case Fault::None: break;
                case Fault::Split: ++c.split; break;
                case Fault::Coalesce: ++c.coalesce; break;
                case Fault::Delay: ++c.delay; break;
                case Fault::Stall: ++c.stall; break;
                case Fault::Flip: ++c.flip; break;
                case Fault::Duplicate: ++c.duplicate; break;
                case Fault::Drop: ++c.drop; break;
                case Fault::Truncate: ++c.truncate; break;
                case Fault::Reset: ++c.reset; break;
            }
        });
    }

    const FaultOptions options;
    const uint16_t targetPort;
    std::atomic<bool> toTargetHeld = false, toClientHeld = false;
    std::list<std::weak_ptr<Link>> links;  ///< of the proxy's thread
    std::mutex mutex;
    FaultCounters counters;
    asio::io_context context;
    tcp::acceptor acceptor;
    const uint16_t port = acceptor.local_endpoint().port();
    std::thread thread;
};

FaultProxy::FaultProxy(uint16_t targetPort, const FaultOptions& options)
    : impl_(std::make_unique<Impl>(targetPort, options)) {}
FaultProxy::~FaultProxy() = default;

uint16_t FaultProxy::port() const { return impl_->port; }

FaultCounters FaultProxy::counters() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->counters;
}

void FaultProxy::cutAll() {
    std::promise<void> done;
    asio::post(impl_->context, [this, &done] {
        impl_->closeLinks();
        done.set_value();
    });
    done.get_future().wait();
}

void FaultProxy::blackHole() { impl_->toTargetHeld = impl_->toClientHeld = true; }
void FaultProxy::blackHoleOneWay() { impl_->toTargetHeld = true; }
void FaultProxy::stop() { impl_->stop(); }
void FaultProxy::restore() { impl_->toTargetHeld = impl_->toClientHeld = false; }

}  // namespace antipode::test
