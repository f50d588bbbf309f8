#include "server/listener.h"

#include <list>

#include <asio/co_spawn.hpp>
#include <asio/detached.hpp>
#include <spdlog/spdlog.h>

#include "proto/wire/accept_loop.h"
#include "proto/wire/connection.h"
#include "renderengine/error.h"

namespace antipode {
namespace {

using asio::ip::tcp;

/// Somebody who has connected.
struct Visitor {
    std::string peer;
    std::optional<wire::Stream> stream;            ///< during the handshake
    std::unique_ptr<wire::Connection> connection;  ///< afterwards
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
    Impl(asio::io_context& ioContext, const wire::Endpoint& endpoint, const wire::Security& transport,
         ServerContext& shared)
        : io(ioContext), security(transport), context(shared), acceptor(openAcceptor(io, endpoint)) {}

    asio::io_context& io;
    const wire::Security& security;
    ServerContext& context;
    tcp::acceptor acceptor;
    std::list<std::shared_ptr<Visitor>> visitors;  ///< in the order of their arrival
    Totals past;                                   ///< of connections that have ended

    size_t count(bool introduced) const {
        size_t n = 0;
        for (const auto& visitor : visitors) n += !visitor->evicted && visitor->introduced() == introduced;
        return n;
    }

    void evictStrangers() {
        size_t excess = count(false);
        for (const auto& visitor : visitors) {
            if (excess <= mostStrangers) return;
            if (visitor->evicted || visitor->introduced()) continue;
            visitor->evicted = true;
            visitor->end("too many connections that do not introduce themselves");
            --excess;
        }
    }

    void welcome(tcp::socket socket) {
        ++past.accepted;
        auto visitor = std::make_shared<Visitor>();
        visitor->stream.emplace(std::move(socket), security);
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
        if (!visitor->session) spdlog::info("{}: not let in: {}", visitor->peer, reason);
        if (visitor->connection) {
            past.bytesReceived += visitor->connection->bytesReceived();
            past.bytesSent += visitor->connection->bytesSent();
        }
        visitors.remove(visitor);
    }
};

Listener::Listener(asio::io_context& io, const wire::Endpoint& endpoint, const wire::Security& security,
                   ServerContext& context)
    : impl_(std::make_shared<Impl>(io, endpoint, security, context)) {}

Listener::~Listener() { stopAccepting(); }

uint16_t Listener::port() const { return impl_->acceptor.local_endpoint().port(); }

void Listener::start() {
    const auto welcome = [impl = impl_](tcp::socket socket) { impl->welcome(std::move(socket)); };
    const auto complain = [](const std::string& why) { spdlog::warn("cannot accept a connection: {}", why); };
    asio::co_spawn(impl_->io, wire::acceptAll(impl_->acceptor, welcome, complain), asio::detached);
}

void Listener::stopAccepting() {
    asio::error_code ignored;
    impl_->acceptor.close(ignored);
}

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
