#include "farm/nodes/remote_node.h"

#include <asio/ip/tcp.hpp>
#include <asio/read.hpp>

#include "tests/nodes/remote_session_fixture.h"

namespace antipode::test {
namespace {

using asio::ip::tcp;

class RemoteNodeTest : public RemoteSessionTest {
protected:
    /// Runs handlers until the condition holds, five seconds at most.
    template <class Condition>
    bool runUntil(const Condition& condition) {
        const double end = wire::monotonicSeconds() + 5;
        while (!condition() && wire::monotonicSeconds() < end) {
            io.restart();
            io.run_one_for(std::chrono::milliseconds(10));
        }
        return condition();
    }

    asio::io_context io;
    tcp::acceptor acceptor{io, tcp::endpoint(asio::ip::make_address("127.0.0.1"), 0)};
    RemoteNode node{io,
                    {"127.0.0.1", std::to_string(acceptor.local_endpoint().port())},
                    std::make_shared<const wire::Security>(wire::SecurityOptions(), wire::Security::Role::Client),
                    std::shared_ptr<RemoteContext>(std::shared_ptr<void>(), &*context)};
};

TEST_F(RemoteNodeTest, ConnectsAndSaysGoodbyeWhenStopped) {
    node.start();
    ASSERT_TRUE(runUntil([&] { return node.status().connections == 1; }));
    tcp::socket server = acceptor.accept();
    EXPECT_EQ(node.status().state, "greeting");
    node.stop();
    server.close();
    EXPECT_TRUE(runUntil([&] { return node.stopped(); }));
}

TEST_F(RemoteNodeTest, StoppedWhileItConnectsItDoesNotJoin) {
    node.start();
    io.run_one();  // the coroutine has begun and waits for the connection
    ASSERT_FALSE(node.stopped());
    node.stop();
    ASSERT_TRUE(runUntil([&] { return node.stopped(); }));
    EXPECT_EQ(node.status().connections, 0u);
    tcp::socket server = acceptor.accept();
    asio::error_code end;
    char byte = 0;
    EXPECT_EQ(asio::read(server, asio::buffer(&byte, 1), end), 0u) << "the server was greeted";
    EXPECT_EQ(end, asio::error::eof);
}

}  // namespace
}  // namespace antipode::test
