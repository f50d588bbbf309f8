#include "proto/wire/accept_loop.h"

#include <stdexcept>
#include <vector>

#include <asio/co_spawn.hpp>
#include <asio/detached.hpp>
#include <gtest/gtest.h>

#include "tests/net/loopback.h"

namespace antipode::test {
namespace {

using asio::ip::tcp;

TEST(AcceptLoop, GoesOnAfterAnException) {
    asio::io_context context;
    tcp::acceptor acceptor(context, {asio::ip::address_v4::loopback(), 0});
    int came = 0;
    std::vector<std::string> complaints;
    bool over = false;
    asio::co_spawn(context,
                   wire::acceptAll(
                       acceptor,
                       [&](tcp::socket) {
                           if (++came == 1) throw std::runtime_error("no memory for a stream");
                       },
                       [&](const std::string& why) { complaints.push_back(why); }),
                   [&](const std::exception_ptr& failure) { over = failure == nullptr; });
    std::vector<tcp::socket> clients;
    for (int i = 0; i < 3; ++i) {
        clients.emplace_back(context);
        clients.back().connect(acceptor.local_endpoint());
    }
    EXPECT_TRUE(runUntil(context, 2, [&] { return came == 3; }));
    EXPECT_EQ(complaints, std::vector<std::string>{"no memory for a stream"});
    acceptor.close();
    EXPECT_TRUE(runUntil(context, 1, [&] { return over; }));
}

}  // namespace
}  // namespace antipode::test
