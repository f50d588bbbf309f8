// A byte stream between client and server: plain TCP on loopback, TLS 1.3 elsewhere.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include <asio/awaitable.hpp>
#include <asio/buffer.hpp>
#include <asio/ip/tcp.hpp>

#include "proto/wire/session.h"

namespace antipode::wire {

/// HOST:PORT, with [brackets] around IPv6 addresses; PORT alone where `host` says what it stands for then. Throws
/// Error(Usage) naming `option`.
struct Endpoint {
    std::string host;
    std::string port;  ///< decimal, 0 … 65535
    std::string text() const;
};
Endpoint parseEndpoint(const std::string& option, const std::string& text, const std::string& host = "");

/// How peers prove who they are. At most one of the two ways is set.
struct SecurityOptions {
    std::string pskFile;                    ///< a secret of at least 16 bytes; for a client perhaps one of its own
    std::string certFile, keyFile, caFile;  ///< PEM: mutual TLS
    /// Of a server, who is not let in any more: names of clients with secrets of their own, one a line, or, with
    /// certificates, the CA's revocation list (PEM).
    std::string revokedFile = {};
    bool any() const { return !pskFile.empty() || !certFile.empty(); }
};

/// Secrets and certificates, read once. Thread-safe afterwards.
class Security {
public:
    enum class Role { Server, Client };
    /// Throws Error(Usage) for options that do not fit together, Error(Input) for files that are missing or unfit.
    Security(const SecurityOptions& options, Role role);
    ~Security();
    Security(const Security&) = delete;
    Security& operator=(const Security&) = delete;

    bool encrypted() const;

    struct Impl;
    Impl& impl() const { return *impl_; }

private:
    std::unique_ptr<Impl> impl_;
};

/// The secret in a file, without the line's end. Throws Error(Input) for a file that is missing, that others can read,
/// or whose secret is shorter than 16 bytes or easy to guess.
std::string readSecretFile(const std::string& path);

/// What a client called `name` is given in a file, made of the servers' secret: servers let it in, and no other client
/// can pose as a server to it. Throws Error(Usage) for a name of other than 1 to 64 letters, digits, dots and hyphens,
/// Error(Input) for a file that is missing or unfit.
std::string makeClientSecret(const std::string& pskFile, const std::string& name);

/// Whether all addresses that the endpoint's host stands for are loopback. Throws Error(Usage), naming `option`, where
/// it stands for none.
bool isLoopback(const Endpoint& endpoint, const std::string& option);
/// Throws Error(Usage) unless a secret or a certificate is set or all addresses that `host` stands for are loopback.
void requireSecured(const SecurityOptions& options, const Endpoint& endpoint, const std::string& option);

/// A connected socket with or without TLS. One reader and one writer coroutine at a time. All throw asio::system_error.
class Stream {
public:
    /// `security` outlives the stream. `peerName`: what the certificate of a server must be valid for.
    Stream(asio::ip::tcp::socket socket, const Security& security, std::string peerName = "");
    ~Stream();
    Stream(Stream&&) noexcept;
    Stream& operator=(Stream&&) noexcept;

    /// Does nothing without TLS. Gives up after so many seconds with asio::error::timed_out.
    asio::awaitable<void> handshake(double seconds = Liveness{}.helloSeconds);
    /// At least one byte; the end of the stream is asio::error::eof.
    asio::awaitable<size_t> readSome(asio::mutable_buffer buffer);
    asio::awaitable<void> write(asio::const_buffer buffer);
    /// Tells the peer that nothing follows.
    void finishSending() noexcept;
    /// Closes the socket at once; whoever waits is thrown out.
    void close() noexcept;
    /// Whether TLS failed before the peer had said anything: the two do not accept each other's secret or certificates.
    bool rejected() const;
    /// "127.0.0.1:40312".
    std::string peer() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Resolves and connects, within ten seconds per address. Throws asio::system_error.
asio::awaitable<asio::ip::tcp::socket> connect(Endpoint endpoint);

}  // namespace antipode::wire
