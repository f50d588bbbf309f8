#include <algorithm>

#include <asio/connect.hpp>
#include <asio/io_context.hpp>
#include <asio/redirect_error.hpp>
#include <asio/this_coro.hpp>
#include <asio/use_awaitable.hpp>

#include "proto/wire/deadline.h"
#include "proto/wire/stream.h"
#include "renderengine/error.h"

namespace antipode::wire {
namespace {

using asio::ip::tcp;

constexpr auto connectTime = std::chrono::seconds(10);  ///< per address: there and back, of three seconds each way
constexpr int mostAddresses = 8;

[[noreturn]] void refuse(const std::string& option, const std::string& text, const std::string& why) {
    throw Error(ErrorCode::Usage, option + " takes HOST:PORT or [IPv6]:PORT, not '" + text + "': " + why + ".");
}

bool isPort(const std::string& text) {
    const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
    return !text.empty() && text.size() <= 5 && std::ranges::all_of(text, isDigit) && std::stoi(text) <= 65535;
}

bool isHostCharacter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-' ||
           c == '_';
}

}  // namespace

std::string Endpoint::text() const {
    return (host.find(':') == std::string::npos ? host : "[" + host + "]") + ":" + port;
}

Endpoint parseEndpoint(const std::string& option, const std::string& text, const std::string& defaultHost) {
    if (!defaultHost.empty() && isPort(text)) return {defaultHost, text};
    const size_t colon = text.rfind(':');
    if (colon == std::string::npos || text.ends_with(']')) refuse(option, text, "the port is missing");
    Endpoint endpoint{text.substr(0, colon), text.substr(colon + 1)};
    if (!isPort(endpoint.port)) refuse(option, text, "a port is a number from 0 to 65535");
    std::string& host = endpoint.host;
    if (host.empty()) refuse(option, text, "the host is missing");
    if (host.starts_with('[') && host.ends_with(']')) {
        host = host.substr(1, host.size() - 2);
        asio::error_code code;
        asio::ip::make_address_v6(host, code);
        if (code) refuse(option, text, "in brackets stands an IPv6 address");
    } else if (!std::ranges::all_of(host, isHostCharacter)) {
        refuse(option, text, "that is no host name; IPv6 addresses need brackets");
    }
    return endpoint;
}

bool isLoopback(const Endpoint& endpoint, const std::string& option) {
    asio::io_context context;
    tcp::resolver resolver(context);
    asio::error_code code;
    const auto results = resolver.resolve(endpoint.host, endpoint.port, tcp::resolver::numeric_service, code);
    if (code || results.empty())
        throw Error(ErrorCode::Usage,
                    option + ": '" + endpoint.host + "' stands for no address: " + code.message() + ".");
    return std::ranges::all_of(results, [](const auto& entry) { return entry.endpoint().address().is_loopback(); });
}

void requireSecured(const SecurityOptions& options, const Endpoint& endpoint, const std::string& option) {
    if (!options.any() && !isLoopback(endpoint, option))
        throw Error(ErrorCode::Usage,
                    option + " " + endpoint.text() +
                        " can be reached by others: add --psk-file FILE, or --tls-cert, --tls-key and "
                        "--tls-ca; only loopback goes without.");
}

asio::awaitable<tcp::socket> connect(Endpoint endpoint) {
    const asio::any_io_executor executor = co_await asio::this_coro::executor;
    tcp::resolver resolver(executor);
    asio::error_code code;
    auto token = asio::redirect_error(asio::use_awaitable, code);
    // The C library bounds the time that this takes.
    const tcp::resolver::results_type results =
        co_await resolver.async_resolve(endpoint.host, endpoint.port, tcp::resolver::numeric_service, token);
    if (code) throw asio::system_error(code, "'" + endpoint.host + "' cannot be resolved");
    int tried = 0;
    for (const auto& entry : results) {
        if (tried++ == mostAddresses) break;
        const tcp::endpoint address = entry.endpoint();
        tcp::socket socket(executor);
        const Deadline deadline(executor, socket, connectTime);
        co_await socket.async_connect(address, token);
        if (deadline.passed()) code = asio::error::timed_out;
        if (!code) co_return socket;
    }
    throw asio::system_error(code, "cannot connect to " + endpoint.text());
}

}  // namespace antipode::wire
