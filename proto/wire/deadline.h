// A time limit on what a coroutine waits for.
#pragma once

#include <chrono>
#include <memory>

#include <asio/any_io_executor.hpp>
#include <asio/ip/tcp.hpp>
#include <asio/steady_timer.hpp>

namespace antipode::wire {

/// Closes a socket when the time is up, unless it is destroyed before; whoever waits on the socket is thrown out. All
/// on one strand.
class Deadline {
public:
    Deadline(const asio::any_io_executor& executor, asio::ip::tcp::socket& socket, std::chrono::milliseconds time)
        : state_(std::make_shared<State>(State{&socket})), timer_(executor, time) {
        // The handler may run after the timer is gone, but not after it is told so.
        timer_.async_wait([state = state_](const asio::error_code& code) {
            if (code || !state->socket) return;
            state->passed = true;
            asio::error_code ignored;
            state->socket->close(ignored);
        });
    }
    ~Deadline() { state_->socket = nullptr; }
    Deadline(const Deadline&) = delete;
    Deadline& operator=(const Deadline&) = delete;

    bool passed() const { return state_->passed; }

private:
    struct State {
        asio::ip::tcp::socket* socket;
        bool passed = false;
    };
    std::shared_ptr<State> state_;
    asio::steady_timer timer_;
};

}  // namespace antipode::wire
