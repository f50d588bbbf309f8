#include "server/listener.h"

#include <algorithm>
#include <list>
#include <vector>

#include <asio/co_spawn.hpp>
#include <asio/detached.hpp>
#include <spdlog/spdlog.h>

#include "proto/wire/accept_loop.h"
#include "proto/wire/connection.h"
#include "renderengine/error.h"
#include "server/doorkeeper.h"
#include "server/log_throttle.h"

namespace antipode {
namespace {

using asio::ip::tcp;

/// Somebody who has connected.
struct Visitor {
    std::string peer, address;                       ///< with port; what it is counted by
    std::shared_ptr<const wire::Security> security;  ///< of its stream
    std::optional<wire::Stream> stream;              ///< during the handshake
    std::unique_ptr<wire::Connection> connection;    ///< afterwards
    std::unique_ptr<ServerSession> session;
    bool evicted = false;

    bool introduced() const { return session && session->introduced(); }

    void end(const std::string& reason) {
        if (connection)
            connection->close(reason);
        else if (stream)
            stream->close();
    }
};

/// What one machine has: an IPv4 address, or a network of IPv6, which gives each machine as many as it likes.
std::string addressOf(const tcp::socket& socket) {
    asio::error_code code;
    asio::ip::address address = socket.remote_endpoint(code).address();
    if (code) return "";
    if (address.is_v4()) return address.to_string();
    if (address.to_v6().is_v4_mapped()) return make_address_v4(asio::ip::v4_mapped, address.to_v6()).to_string();
    auto bytes = address.to_v6().to_bytes();
    std::fill(bytes.begin() + 8, bytes.end(), 0);
    return asio::ip::address_v6(bytes).to_string();
}

tcp::acceptor openAcceptor(asio::io_context& io, const wire::Endpoint& endpoint) {
    try {
        tcp::resolver resolver(io);
        const tcp::endpoint address = *resolver.resolve(endpoint.host, endpoint.port, tcp::resolver::passive).begin();
        return tcp::acceptor(io, address);
    } catch (const std::system_error& error) {
        throw Error(ErrorCode::Usage, "--listen: nobody can listen on " + endpoint.text() + ": " +
                                          error.code().message() +
                                          "; name an address of this machine and a free port.");
    }
}

}  // namespace

struct Listener::Impl : std::enable_shared_from_this<Impl> {
    Impl(asio::io_context& ioContext, const wire::Endpoint& endpoint, std::shared_ptr<const wire::Security> transport,
         ServerContext& shared)
        : io(ioContext), security(std::move(transport)), context(shared), acceptor(openAcceptor(io, endpoint)) {}

    asio::io_context& io;
    std::shared_ptr<const wire::Security> security;
    ServerContext& context;
    tcp::acceptor acceptor;
    std::list<std::shared_ptr<Visitor>> visitors;  ///< in the order of their arrival
    Totals past;                                   ///< of connections that have ended
    Doorkeeper door;
    LogThrottle log{[](const std::string& line) { spdlog::info("{}", line); }};  ///< of strangers

    size_t count(bool introduced) const {
        size_t n = 0;
        for (const auto& visitor : visitors) n += !visitor->evicted && visitor->introduced() == introduced;
        return n;
    }

    void evictStrangers() {
        std::vector<Visitor*> strangers;
        for (const auto& visitor : visitors)
            if (!visitor->evicted && !visitor->introduced()) strangers.push_back(visitor.get());
        while (strangers.size() > mostStrangers) {
            std::vector<std::string> addresses;
            addresses.reserve(strangers.size());
            for (const Visitor* visitor : strangers) addresses.push_back(visitor->address);
            const auto goes = strangers.begin() + std::ptrdiff_t(whoGoes(addresses));
            (*goes)->evicted = true;
            (*goes)->end("too many connections that do not introduce themselves");
            strangers.erase(goes);
        }
    }

    void welcome(tcp::socket socket) {
        ++past.accepted;
        const std::string address = addressOf(socket);
        const double now = wire::monotonicSeconds();
        if (!door.admits(address, now)) return log.say(address + ": not heard: it connects too often", now);
        auto visitor = std::make_shared<Visitor>();
        visitor->address = address;
        visitor->security = security;
        visitor->stream.emplace(std::move(socket), *visitor->security);
        visitor->peer = visitor->stream->peer();
        asio::co_spawn(io, serve(visitor), asio::detached);
        visitors.push_back(visitor);
        evictStrangers();
    }

    asio::awaitable<void> serve(std::shared_ptr<Visitor> visitor) {
        const auto self = shared_from_this();
        const double arrival = wire::monotonicSeconds();
        std::string reason = "it was closed";
        try {
            co_await visitor->stream->handshake();
            visitor->connection = std::make_unique<wire::Connection>(std::move(*visitor->stream),
                                                                     wire::ConnectionLimits{}, context.watch);
            visitor->session = std::make_unique<ServerSession>(context, *visitor->connection, arrival);
            co_await visitor->connection->run(*visitor->session);
        } catch (const std::exception& error) {
            reason = error.what();
        }
        if (!visitor->session) log.say(visitor->peer + ": not let in: " + reason, wire::monotonicSeconds());
        if (visitor->connection) {
            past.bytesReceived += visitor->connection->bytesReceived();
            past.bytesSent += visitor->connection->bytesSent();
        }
        visitors.remove(visitor);
    }
};

Listener::Listener(asio::io_context& io, const wire::Endpoint& endpoint, std::shared_ptr<const wire::Security> security,
                   ServerContext& context)
    : impl_(std::make_shared<Impl>(io, endpoint, std::move(security), context)) {}

Listener::~Listener() { stopAccepting(); }

uint16_t Listener::port() const { return impl_->acceptor.local_endpoint().port(); }

void Listener::start() {
    const auto welcome = [impl = impl_](tcp::socket socket) { impl->welcome(std::move(socket)); };
    const auto complain = [impl = impl_](const std::string& why) {
        impl->log.say("cannot accept a connection: " + why, wire::monotonicSeconds());
    };
    asio::co_spawn(impl_->io, wire::acceptAll(impl_->acceptor, welcome, complain), asio::detached);
}

void Listener::stopAccepting() {
    asio::error_code ignored;
    impl_->acceptor.close(ignored);
}

void Listener::secure(std::shared_ptr<const wire::Security> security) {
    impl_->security = std::move(security);
    closeAll("secret and certificates have been read again");
}

void Listener::tick(double now) { impl_->log.tick(now); }

void Listener::closeAll(const std::string& reason) {
    for (const auto& visitor : impl_->visitors) visitor->end(reason);
}

Listener::Totals Listener::totals() const {
    Totals totals = impl_->past;
    totals.clients = impl_->count(true);
    totals.strangers = impl_->count(false);
    for (const auto& visitor : impl_->visitors) {
        if (!visitor->connection) continue;
        totals.bytesReceived += visitor->connection->bytesReceived();
        totals.bytesSent += visitor->connection->bytesSent();
    }
    return totals;
}

}  // namespace antipode
