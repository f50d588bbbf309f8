// Sessions over real sockets: a server and its clients on one thread.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>

#include "proto/wire/connection.h"

namespace antipode::test {

/// A session made of functions, which remembers what happened to it.
class TestSession final : public wire::Session {
public:
    std::function<void(const wire::Frame&)> onFrame = [](const wire::Frame&) {};
    std::function<void()> onTick = [] {};

    void heard(double) override { ++hearings; }
    void receive(const wire::Frame& frame, double) override {
        ++received;
        onFrame(frame);
    }
    void tick(double) override {
        ++ticks;
        onTick();
    }
    void disconnected(const std::string& why, double) override {
        ++endings;
        reason = why;
    }
    bool ended() const { return endings > 0; }

    uint64_t hearings = 0, received = 0, ticks = 0;
    int endings = 0;
    std::string reason;
};

/// Equal in type, message and payload.
bool equal(const wire::Frame& a, const wire::Frame& b);

/// Runs until the condition holds; false where it does not within the time.
bool runUntil(asio::io_context& context, double seconds, const std::function<bool()>& condition);

/// Accepts on a loopback port and runs a session on each connection, which `prepare` gives its functions.
class LoopbackServer {
public:
    using Prepare = std::function<void(TestSession& session, wire::Connection& connection)>;
    LoopbackServer(asio::io_context& context, const wire::Security& security, Prepare prepare,
                   const wire::ConnectionLimits& limits = {});

    double handshakeSeconds = wire::Liveness{}.helloSeconds;

    uint16_t port() const { return acceptor_.local_endpoint().port(); }

    /// One per accepted connection; those that failed in their handshake have only a reason.
    std::vector<std::shared_ptr<TestSession>> sessions;
    uint64_t received() const;  ///< frames of all sessions

private:
    asio::awaitable<void> accept();
    asio::awaitable<void> serve(asio::ip::tcp::socket socket);

    asio::io_context& context_;
    const wire::Security& security_;
    Prepare prepare_;
    wire::ConnectionLimits limits_;
    asio::ip::tcp::acceptor acceptor_;
};

/// Sends every frame back.
void echo(TestSession& session, wire::Connection& connection);

/// Dials 127.0.0.1 and runs a session. Whatever fails ends the session with the error's sentence.
class LoopbackClient {
public:
    /// `prepare` is called when the connection stands. `name`: what the server's certificate must say.
    LoopbackClient(asio::io_context& context, uint16_t port, const wire::Security& security,
                   LoopbackServer::Prepare prepare, const std::string& name = "127.0.0.1");

    TestSession session;
    std::unique_ptr<wire::Connection> connection;

private:
    asio::awaitable<void> run(uint16_t port, const wire::Security& security, LoopbackServer::Prepare prepare,
                              std::string name);
};

}  // namespace antipode::test
