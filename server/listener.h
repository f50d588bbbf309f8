// Accepts clients and runs a session for each.
#pragma once

#include <cstdint>
#include <memory>

#include <asio/io_context.hpp>

#include "proto/wire/stream.h"
#include "server/server_session.h"

namespace antipode {

/// Strangers (connections that have not said Hello yet) are bounded: when there are too many, one of the address that
/// has the most goes, the oldest, so that slow or silent ones never keep a client out, wherever it is (Doorkeeper).
/// What a log tells of them is bounded, too. All calls on the io_context's thread.
class Listener {
public:
    static constexpr size_t mostStrangers = 256;
    /// Listens from construction on. Throws Error(Usage) where that is impossible.
    Listener(asio::io_context& io, const wire::Endpoint& endpoint, std::shared_ptr<const wire::Security> security,
             ServerContext& context);
    ~Listener();
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;

    uint16_t port() const;
    /// Begins to accept.
    void start();
    void stopAccepting();
    /// Ends all connections: who makes another has to prove itself by these.
    void secure(std::shared_ptr<const wire::Security> security);
    /// Now and then. `now`: monotonic seconds.
    void tick(double now);
    /// Ends all connections.
    void closeAll(const std::string& reason);

    struct Totals {
        size_t clients = 0, strangers = 0;
        uint64_t accepted = 0, bytesReceived = 0, bytesSent = 0;
    };
    Totals totals() const;

private:
    struct Impl;
    std::shared_ptr<Impl> impl_;  ///< shared with the coroutines
};

}  // namespace antipode
