#include "tests/net/loopback.h"

#include <asio/co_spawn.hpp>
#include <asio/detached.hpp>
#include <asio/use_awaitable.hpp>

namespace antipode::test {

using asio::ip::tcp;

bool equal(const wire::Frame& a, const wire::Frame& b) {
    return a.type == b.type && a.message == b.message && a.payload == b.payload;
}

bool runUntil(asio::io_context& context, double seconds, const std::function<bool()>& condition) {
    const double end = wire::monotonicSeconds() + seconds;
    while (!condition()) {
        if (wire::monotonicSeconds() >= end) return false;
        context.restart();
        context.run_one_for(std::chrono::milliseconds(10));
    }
    return true;
}

LoopbackServer::LoopbackServer(asio::io_context& context, const wire::Security& security, Prepare prepare,
                               const wire::ConnectionLimits& limits)
    : context_(context),
      security_(security),
      prepare_(std::move(prepare)),
      limits_(limits),
      acceptor_(context, tcp::endpoint(asio::ip::address_v4::loopback(), 0)) {
    asio::co_spawn(context_, accept(), asio::detached);
}

asio::awaitable<void> LoopbackServer::accept() {
    while (true) {
        tcp::socket socket = co_await acceptor_.async_accept(asio::use_awaitable);
        asio::co_spawn(context_, serve(std::move(socket)), asio::detached);
    }
}

asio::awaitable<void> LoopbackServer::serve(tcp::socket socket) {
    const auto session = std::make_shared<TestSession>();
    sessions.push_back(session);
    wire::Stream stream(std::move(socket), security_);
    try {
        co_await stream.handshake(handshakeSeconds);
    } catch (const std::exception& error) {
        session->disconnected(error.what(), 0);
        co_return;
    }
    wire::Connection connection(std::move(stream), limits_);
    prepare_(*session, connection);
    co_await connection.run(*session);
}

uint64_t LoopbackServer::received() const {
    uint64_t sum = 0;
    for (const auto& session : sessions) sum += session->received;
    return sum;
}

void echo(TestSession& session, wire::Connection& connection) {
    session.onFrame = [&connection](const wire::Frame& frame) { connection.send(frame); };
}

LoopbackClient::LoopbackClient(asio::io_context& context, uint16_t port, const wire::Security& security,
                               LoopbackServer::Prepare prepare, const std::string& name) {
    asio::co_spawn(context, run(port, security, std::move(prepare), name), asio::detached);
}

asio::awaitable<void> LoopbackClient::run(uint16_t port, const wire::Security& security,
                                          LoopbackServer::Prepare prepare, std::string name) {
    try {
        const wire::Endpoint endpoint{"127.0.0.1", std::to_string(port)};
        tcp::socket socket = co_await wire::connect(endpoint);
        wire::Stream stream(std::move(socket), security, name);
        co_await stream.handshake();
        connection = std::make_unique<wire::Connection>(std::move(stream));
    } catch (const std::exception& error) {
        session.disconnected(error.what(), 0);
        co_return;
    }
    prepare(session, *connection);
    co_await connection->run(session);
}

}  // namespace antipode::test
