// Takes connections for as long as somebody listens.
#pragma once

#include <functional>
#include <string>

#include <asio/awaitable.hpp>
#include <asio/ip/tcp.hpp>

namespace antipode::wire {

/// Returns when the acceptor, which outlives it, is closed. `welcome` gets each connection; what it throws costs that
/// connection and no other. `complain` is told why one could not be taken; the next is tried a tenth of a second later.
asio::awaitable<void> acceptAll(asio::ip::tcp::acceptor& acceptor, std::function<void(asio::ip::tcp::socket)> welcome,
                                std::function<void(const std::string& why)> complain);

}  // namespace antipode::wire
