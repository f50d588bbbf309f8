#include "proto/wire/accept_loop.h"

#include <chrono>
#include <exception>

#include <asio/redirect_error.hpp>
#include <asio/steady_timer.hpp>
#include <asio/use_awaitable.hpp>

namespace antipode::wire {
namespace {

/// Out of descriptors or memory, most likely: those who leave make room.
constexpr auto pauseAfterFailure = std::chrono::milliseconds(100);

}  // namespace

asio::awaitable<void> acceptAll(asio::ip::tcp::acceptor& acceptor, std::function<void(asio::ip::tcp::socket)> welcome,
                                std::function<void(const std::string&)> complain) {
    asio::steady_timer pause(acceptor.get_executor());
    while (acceptor.is_open()) {
        std::string why;
        try {
            asio::error_code error;
            auto socket = co_await acceptor.async_accept(asio::redirect_error(asio::use_awaitable, error));
            if (error == asio::error::operation_aborted) co_return;
            if (!error) {
                welcome(std::move(socket));
                continue;
            }
            why = error.message();
        } catch (const std::exception& error) {
            why = error.what();
        }
        complain(why);
        pause.expires_after(pauseAfterFailure);
        asio::error_code ignored;
        co_await pause.async_wait(asio::redirect_error(asio::use_awaitable, ignored));
    }
}

}  // namespace antipode::wire
