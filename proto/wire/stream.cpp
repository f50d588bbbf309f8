#include "proto/wire/stream.h"

#include <asio/read.hpp>
#include <asio/redirect_error.hpp>
#include <asio/ssl/error.hpp>
#include <asio/ssl/stream.hpp>
#include <asio/this_coro.hpp>
#include <asio/use_awaitable.hpp>
#include <asio/write.hpp>
#include <netinet/tcp.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>

#include "proto/farm.pb.h"
#include "proto/wire/deadline.h"
#include "proto/wire/frame.h"
#include "proto/wire/security.h"
#include "proto/wire/session.h"
#include "proto/wire/tls_errors.h"

namespace antipode::wire {
namespace {

using asio::ip::tcp;
using TlsStream = asio::ssl::stream<tcp::socket&>;

/// What the system takes of a slow stream beyond what is under way: whatever is said next waits behind it.
using UnsentBytes = asio::detail::socket_option::integer<IPPROTO_TCP, TCP_NOTSENT_LOWAT>;
constexpr int mostUnsentBytes = 128 << 10;

/// A server's certificate must be valid for the name or address that was dialled.
void expectName(SSL* ssl, const std::string& name) {
    SSL_set_hostflags(ssl, X509_CHECK_FLAG_NO_PARTIAL_WILDCARDS);
    asio::error_code notAnAddress;
    const asio::ip::address address = asio::ip::make_address(name, notAnAddress);
    bool set = false;
    if (notAnAddress) {
        set = SSL_set_tlsext_host_name(ssl, name.c_str()) == 1 && SSL_set1_host(ssl, name.c_str()) == 1;
    } else if (address.is_v4()) {
        const auto bytes = address.to_v4().to_bytes();
        set = X509_VERIFY_PARAM_set1_ip(SSL_get0_param(ssl), bytes.data(), bytes.size()) == 1;
    } else {
        const auto bytes = address.to_v6().to_bytes();
        set = X509_VERIFY_PARAM_set1_ip(SSL_get0_param(ssl), bytes.data(), bytes.size()) == 1;
    }
    // Without a name any certificate of the CA would pass.
    if (name.empty() || !set)
        throw asio::system_error(asio::error::invalid_argument, "'" + name + "' is no name that a server can prove");
}

/// Whether what should have been TLS's first record was none.
bool isPlain(const asio::error_code& code) {
    return code.category() == asio::error::get_ssl_category() &&
           ERR_GET_REASON(static_cast<unsigned>(code.value())) == SSL_R_WRONG_VERSION_NUMBER;
}

std::string nameOf(const tcp::socket& socket) {
    asio::error_code code;
    const tcp::endpoint endpoint = socket.remote_endpoint(code);
    if (code) return "unknown";
    return Endpoint{endpoint.address().to_string(), std::to_string(endpoint.port())}.text();
}

}  // namespace

struct Stream::Impl {
    Impl(tcp::socket connected, const Security& ways, std::string name)
        : socket(std::move(connected)), security(ways), peerName(std::move(name)), peer(nameOf(socket)) {
        // Both can fail only where the peer has gone already, which the first read will tell.
        asio::error_code ignored;
        socket.set_option(tcp::no_delay(true), ignored);
        socket.set_option(asio::socket_base::keep_alive(true), ignored);
        socket.set_option(UnsentBytes(mostUnsentBytes), ignored);
        Security::Impl& ours = security.impl();
        if (!ours.context) return;
        tls.emplace(socket, *ours.context);
        if (isClient() && !ours.bySecret) expectName(tls->native_handle(), peerName);
    }

    bool isClient() const { return security.impl().role == Security::Role::Client; }

    [[noreturn]] void fail(const asio::error_code& code) {
        // A stream that ends without TLS's farewell ends all the same: frames tell whether it was cut.
        if (code == asio::error::eof || code == asio::ssl::error::stream_truncated) {
            const bool puzzled = isClient() && !tls && !heard;
            throw asio::system_error(asio::error::eof,
                                     puzzled ? "the server closed the connection before it said anything; "
                                               "it may need a secret or certificates"
                                             : "the peer closed the connection");
        }
        rejected = tls && !heard && code.category() == asio::error::get_ssl_category();
        if (tls) throw explain(code, tls->native_handle(), security, peerName);
        throw asio::system_error(code);
    }

    /// A client of ours without security options gets an answer that it can read; a stranger learns that here is TLS.
    asio::awaitable<void> refusePlain() {
        farm::Refusal refusal;
        refusal.set_code(farm::Refusal::INCOMPATIBLE);
        refusal.set_sentence("This server takes TLS alone: give --psk-file, or --tls-cert, --tls-key and --tls-ca.");
        const std::string bytes = encodeFrame(makeFrame(FrameType::Refusal, refusal));
        asio::error_code ignored;
        co_await asio::async_write(socket, asio::buffer(bytes), asio::redirect_error(asio::use_awaitable, ignored));
        socket.shutdown(tcp::socket::shutdown_send, ignored);
    }

    tcp::socket socket;
    const Security& security;
    std::string peerName, peer;
    std::optional<TlsStream> tls;
    bool heard = false;  ///< something came
    bool rejected = false;
};

Stream::Stream(tcp::socket socket, const Security& security, std::string peerName)
    : impl_(std::make_unique<Impl>(std::move(socket), security, std::move(peerName))) {}
Stream::~Stream() = default;
Stream::Stream(Stream&&) noexcept = default;
Stream& Stream::operator=(Stream&&) noexcept = default;

asio::awaitable<void> Stream::handshake(double seconds) {
    Impl& impl = *impl_;
    if (!impl.tls) co_return;
    const asio::any_io_executor executor = co_await asio::this_coro::executor;
    const Deadline deadline(executor, impl.socket, std::chrono::milliseconds(int64_t(seconds * 1000)));
    asio::error_code code;
    auto token = asio::redirect_error(asio::use_awaitable, code);
    const auto side = impl.isClient() ? TlsStream::client : TlsStream::server;
    co_await impl.tls->async_handshake(side, token);
    if (deadline.passed()) throw asio::system_error(asio::error::timed_out, "the peer does not answer in TLS");
    if (!impl.isClient() && isPlain(code)) co_await impl.refusePlain();
    if (code) impl.fail(code);
    // OpenSSL counts the use of an external secret as a resumption; others are switched off.
    impl.rejected = impl.security.impl().bySecret && SSL_session_reused(impl.tls->native_handle()) != 1;
    if (impl.rejected)
        throw asio::system_error(asio::error::access_denied, "the peer has not proved that it knows the secret");
}

asio::awaitable<size_t> Stream::readSome(asio::mutable_buffer buffer) {
    Impl& impl = *impl_;
    asio::error_code code;
    auto token = asio::redirect_error(asio::use_awaitable, code);
    size_t bytes = 0;
    // A TLS record may be empty.
    while (bytes == 0 && !code) {
        if (impl.tls)
            bytes = co_await impl.tls->async_read_some(buffer, token);
        else
            bytes = co_await impl.socket.async_read_some(buffer, token);
    }
    if (code) impl.fail(code);
    impl.heard = true;
    co_return bytes;
}

asio::awaitable<void> Stream::write(asio::const_buffer buffer) {
    Impl& impl = *impl_;
    asio::error_code code;
    auto token = asio::redirect_error(asio::use_awaitable, code);
    if (impl.tls)
        co_await asio::async_write(*impl.tls, buffer, token);
    else
        co_await asio::async_write(impl.socket, buffer, token);
    if (code) impl.fail(code);
}

void Stream::finishSending() noexcept {
    asio::error_code ignored;
    impl_->socket.shutdown(tcp::socket::shutdown_send, ignored);
}

void Stream::close() noexcept {
    asio::error_code ignored;
    impl_->socket.close(ignored);
}

bool Stream::rejected() const { return impl_->rejected; }

std::string Stream::peer() const { return impl_->peer; }

}  // namespace antipode::wire
