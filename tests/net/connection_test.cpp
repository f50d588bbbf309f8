#include "proto/wire/connection.h"

#include <gtest/gtest.h>

#include <asio/bind_cancellation_slot.hpp>
#include <asio/co_spawn.hpp>
#include <asio/detached.hpp>
#include <asio/write.hpp>

#include "proto/farm.pb.h"
#include "renderengine/error.h"
#include "tests/net/credentials.h"
#include "tests/net/loopback.h"

namespace antipode::test {
namespace {

using asio::ip::tcp;
using wire::Connection;
using wire::Frame;
using wire::FrameType;
using wire::Security;
using Role = Security::Role;

Frame chunk(size_t bytes, char fill = 'x') { return {FrameType::ResultChunk, "", std::string(bytes, fill)}; }

class ConnectionTest : public testing::Test {
protected:
    /// A connected socket whose other end is a session of `server`.
    tcp::socket rawClient(const LoopbackServer& server) {
        tcp::socket socket(context);
        socket.connect({asio::ip::address_v4::loopback(), server.port()});
        return socket;
    }
    bool until(double seconds, const std::function<bool()>& condition) { return runUntil(context, seconds, condition); }

    asio::io_context context;
    const Security plainServer{{}, Role::Server}, plainClient{{}, Role::Client};
};

TEST_F(ConnectionTest, CarriesFramesOfAllBoundaryLengths) {
    const wire::SecurityOptions secret = credentials().secret("9c1f04e7ab52d836");
    const Security tlsServer(secret, Role::Server), tlsClient(secret, Role::Client);
    constexpr size_t most = wire::maxPayloadBytes;
    std::vector<Frame> frames;
    // Around the sizes of buffers, of TLS records and of writes, header included and not.
    for (const size_t edge : {size_t(1), size_t(16384), size_t(65536), size_t(262144), most})
        for (const size_t header : {size_t(0), wire::frameHeaderBytes})
            for (const int step : {-1, 0, 1}) {
                const size_t bytes = std::min(edge - header + step, most);
                if (bytes > most || edge + step < header) continue;
                frames.push_back({FrameType::BlobChunk, std::string(bytes, 'm'), ""});
                frames.push_back({FrameType::BlobChunk, "m", std::string(bytes, 'p')});
            }
    frames.push_back({FrameType::ResultChunk, std::string(most, 'm'), std::string(most, 'p')});
    frames.push_back({FrameType::Heartbeat, "", ""});
    ASSERT_GT(frames.size(), 40u);

    for (const bool tls : {false, true}) {
        SCOPED_TRACE(tls ? "TLS" : "plain");
        LoopbackServer server(context, tls ? tlsServer : plainServer, echo);
        size_t returned = 0, wrong = 0;
        const auto exchange = [&](TestSession& session, Connection& connection) {
            session.onFrame = [&](const Frame& frame) {
                if (!equal(frame, frames.at(returned))) ++wrong;
                if (++returned == frames.size()) connection.close("done");
            };
            for (const Frame& frame : frames) connection.send(frame);
        };
        LoopbackClient client(context, server.port(), tls ? tlsClient : plainClient, exchange);
        EXPECT_TRUE(until(5, [&] { return client.session.ended() && server.sessions[0]->ended(); }));
        ASSERT_EQ(client.session.reason, "done");
        EXPECT_EQ(returned, frames.size());
        EXPECT_EQ(wrong, 0u);
        EXPECT_EQ(client.connection->bytesSent(), client.connection->bytesReceived());
        EXPECT_EQ(client.connection->queuedBytes(), 0u);
        EXPECT_EQ(client.connection->peer(), "127.0.0.1:" + std::to_string(server.port()));
    }
}

TEST_F(ConnectionTest, KeepsTheOrderOfManySmallFrames) {
    uint64_t next = 0, wrong = 0;
    const auto expectCount = [&](TestSession& session, Connection&) {
        session.onFrame = [&](const Frame& frame) { wrong += frame.message != std::to_string(next++); };
    };
    const auto count = [](TestSession&, Connection& connection) {
        for (int i = 0; i < 20000; ++i) connection.send({FrameType::Progress, std::to_string(i), ""});
        connection.close("sent");
    };
    LoopbackServer server(context, plainServer, expectCount);
    LoopbackClient client(context, server.port(), plainClient, count);
    EXPECT_TRUE(until(3, [&] { return client.session.ended() && server.sessions[0]->ended(); }));
    EXPECT_EQ(next, 20000u);
    EXPECT_EQ(wrong, 0u);
}

TEST_F(ConnectionTest, TicksAFewTimesASecond) {
    LoopbackServer server(context, plainServer, echo);
    const tcp::socket client = rawClient(server);
    until(1.15, [] { return false; });
    EXPECT_GE(server.sessions.at(0)->ticks, 3u);
    EXPECT_LE(server.sessions.at(0)->ticks, 5u);
}

TEST_F(ConnectionTest, TicksWhenTheQueueHasDrained) {
    // A chunk per tick; by the clock alone these would take 50 seconds.
    int left = 200;
    const auto upload = [&](TestSession& session, Connection& connection) {
        session.onTick = [&] {
            if (connection.queuedBytes() >= wire::maxPayloadBytes) return;
            if (left-- > 0)
                connection.send(chunk(wire::maxPayloadBytes / 2));
            else
                connection.close("uploaded");
        };
    };
    LoopbackServer server(context, plainServer, [](TestSession&, Connection&) {});
    LoopbackClient client(context, server.port(), plainClient, upload);
    EXPECT_TRUE(until(5, [&] { return client.session.ended() && server.sessions[0]->ended(); }));
    EXPECT_EQ(server.received(), 200u);
}

TEST_F(ConnectionTest, FlushesBeforeItCloses) {
    const auto flood = [](TestSession&, Connection& connection) {
        for (int i = 0; i < 32; ++i) connection.send(chunk(wire::maxPayloadBytes, char('a' + i % 26)));
        connection.close("all sent");
        connection.close("once more");
        connection.send(chunk(1));  // too late
    };
    LoopbackServer server(context, plainServer, flood);
    LoopbackClient client(context, server.port(), plainClient, [](TestSession&, Connection& connection) {
        // Unread when the server closes: it must not turn the end into a reset that swallows what is under way.
        connection.send(chunk(100));
    });
    EXPECT_TRUE(until(3, [&] { return client.session.ended() && server.sessions[0]->ended(); }));
    EXPECT_EQ(client.session.received, 32u);
    EXPECT_EQ(server.received(), 0u);
    EXPECT_EQ(server.sessions[0]->reason, "all sent");
    EXPECT_EQ(server.sessions[0]->endings, 1);
    EXPECT_EQ(client.session.reason, "the peer closed the connection: End of file");
}

TEST_F(ConnectionTest, ClosesInTimeWhereThePeerDoesNotRead) {
    const auto flood = [](TestSession&, Connection& connection) {
        for (int i = 0; i < 32; ++i) connection.send(chunk(wire::maxPayloadBytes));
        connection.close("flushing");
    };
    LoopbackServer server(context, plainServer, flood);
    const tcp::socket deaf = rawClient(server);
    const double start = wire::monotonicSeconds();
    EXPECT_TRUE(until(4, [&] { return !server.sessions.empty() && server.sessions[0]->ended(); }));
    EXPECT_NEAR(wire::monotonicSeconds() - start, wire::ConnectionLimits{}.flushSeconds, 0.3);
    EXPECT_EQ(server.sessions[0]->reason, "flushing");
}

TEST_F(ConnectionTest, KeepsTheQueueOfASlowReaderShort) {
    size_t longest = 0;
    const auto upload = [&](TestSession& session, Connection& connection) {
        session.onTick = [&] {
            if (connection.queuedBytes() < wire::maxPayloadBytes) connection.send(chunk(wire::maxPayloadBytes));
            longest = std::max(longest, connection.queuedBytes());
        };
    };
    LoopbackServer server(context, plainServer, upload);
    tcp::socket slow = rawClient(server);
    std::vector<char> buffer(65536);
    size_t read = 0;
    for (int i = 0; i < 40; ++i) {
        until(0.05, [] { return false; });
        if (slow.available() > 0) read += slow.read_some(asio::buffer(buffer));
    }
    EXPECT_GT(read, 500000u);
    EXPECT_LE(longest, 2 * wire::maxPayloadBytes + 2 * wire::frameHeaderBytes);
    EXPECT_FALSE(server.sessions[0]->ended());
}

TEST_F(ConnectionTest, EndsASessionThatQueuesWithoutBound) {
    size_t longest = 0;
    const auto flood = [&](TestSession&, Connection& connection) {
        for (int i = 0; i < 100; ++i) {
            connection.send(chunk(wire::maxPayloadBytes));
            longest = std::max(longest, connection.queuedBytes());
        }
    };
    LoopbackServer server(context, plainServer, flood);
    const tcp::socket deaf = rawClient(server);
    EXPECT_TRUE(until(3, [&] { return !server.sessions.empty() && server.sessions[0]->ended(); }));
    EXPECT_EQ(server.sessions[0]->endings, 1);
    EXPECT_NE(server.sessions[0]->reason.find("queued"), std::string::npos);
    EXPECT_LE(longest, wire::ConnectionLimits{}.queuedBytes);
    EXPECT_GT(longest, wire::ConnectionLimits{}.queuedBytes * 9 / 10);
}

TEST_F(ConnectionTest, EndsWhereTheNetworkStalls) {
    wire::ConnectionLimits limits;
    limits.stallSeconds = 0.5;
    const auto flood = [](TestSession&, Connection& connection) {
        for (int i = 0; i < 32; ++i) connection.send(chunk(wire::maxPayloadBytes));
    };
    LoopbackServer server(context, plainServer, flood, limits);
    const tcp::socket deaf = rawClient(server);
    EXPECT_TRUE(until(2, [&] { return !server.sessions.empty() && server.sessions[0]->ended(); }));
    EXPECT_EQ(server.sessions[0]->reason, "the peer does not take what it is sent");
}

TEST_F(ConnectionTest, TellsOfBytesThatAreNoFrameYet) {
    LoopbackServer server(context, plainServer, echo);
    tcp::socket slow = rawClient(server);
    const std::string frame = wire::encodeFrame(chunk(3000));
    for (size_t sent = 0; sent < 2000; sent += 500) {
        asio::write(slow, asio::buffer(frame.data() + sent, 500));
        const uint64_t before = server.sessions.empty() ? 0 : server.sessions[0]->hearings;
        EXPECT_TRUE(until(1, [&] { return !server.sessions.empty() && server.sessions[0]->hearings > before; }));
    }
    EXPECT_EQ(server.received(), 0u);
}

TEST_F(ConnectionTest, AnswersABrokenProtocolWithARefusal) {
    const auto strict = [](TestSession& session, Connection&) {
        session.onFrame = [](const Frame&) { throw wire::ProtocolError("a lease that nobody has"); };
    };
    farm::Refusal refusal;
    const auto offend = [&](TestSession& session, Connection& connection) {
        session.onFrame = [&](const Frame& frame) { refusal = wire::parseMessage<farm::Refusal>(frame); };
        connection.send({FrameType::Truncate, "", ""});
        connection.send({FrameType::Truncate, "", ""});
    };
    LoopbackServer server(context, plainServer, strict);
    LoopbackClient client(context, server.port(), plainClient, offend);
    EXPECT_TRUE(until(2, [&] { return client.session.ended() && server.sessions[0]->ended(); }));
    EXPECT_EQ(refusal.code(), farm::Refusal::PROTOCOL);
    EXPECT_EQ(refusal.sentence(), "a lease that nobody has");
    EXPECT_EQ(server.received(), 1u);
    EXPECT_EQ(server.sessions[0]->endings, 1);
    EXPECT_EQ(server.sessions[0]->reason, "protocol error: a lease that nobody has");
}

TEST_F(ConnectionTest, RefusesGarbage) {
    LoopbackServer server(context, plainServer, echo);
    tcp::socket socket = rawClient(server);
    asio::write(socket, asio::buffer(std::string("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n")));
    EXPECT_TRUE(until(1, [&] { return !server.sessions.empty() && socket.available() > 0; }));
    std::string answer(socket.available(), '\0');
    socket.read_some(asio::buffer(answer));
    wire::FrameReader reader;
    reader.feed(answer);
    const std::optional<Frame> frame = reader.next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->type, FrameType::Refusal);
    socket.close();
    EXPECT_TRUE(until(1, [&] { return server.sessions[0]->ended(); }));
    EXPECT_EQ(server.received(), 0u);
}

TEST_F(ConnectionTest, SurvivesWhatSessionsThrow) {
    const std::function<void()> throwers[] = {[] { throw Error(ErrorCode::Output, "The disk is full."); },
                                              [] { throw std::bad_alloc(); },
                                              [] { throw std::system_error(ENOSPC, std::generic_category()); }};
    for (const std::function<void()>& thrower : throwers)
        for (const bool inTick : {false, true}) {
            const auto prepare = [&](TestSession& session, Connection&) {
                if (inTick)
                    session.onTick = thrower;
                else
                    session.onFrame = [&](const Frame&) { thrower(); };
            };
            std::string sentence;
            try {
                thrower();
            } catch (const std::exception& error) {
                sentence = error.what();
            }
            LoopbackServer server(context, plainServer, prepare);
            LoopbackClient client(context, server.port(), plainClient, [](TestSession&, Connection& connection) {
                connection.send({FrameType::Heartbeat, "", ""});
            });
            EXPECT_TRUE(until(2, [&] { return client.session.ended() && server.sessions[0]->ended(); }));
            EXPECT_EQ(server.sessions[0]->reason, sentence);
            EXPECT_EQ(server.sessions[0]->endings, 1);
            EXPECT_EQ(client.session.received, 0u);
        }
}

TEST_F(ConnectionTest, HearsARefusalWhileItUploads) {
    const auto refuse = [](TestSession& session, Connection& connection) {
        session.onFrame = [&](const Frame&) {
            connection.send({FrameType::Refusal, "", ""});
            connection.close("refused");
        };
    };
    bool heard = false;
    const auto upload = [&](TestSession& session, Connection& connection) {
        session.onFrame = [&](const Frame& frame) { heard |= frame.type == FrameType::Refusal; };
        session.onTick = [&] {
            if (connection.queuedBytes() < wire::maxPayloadBytes) connection.send(chunk(wire::maxPayloadBytes));
        };
        session.onTick();
    };
    for (int i = 0; i < 10; ++i) {
        heard = false;
        LoopbackServer server(context, plainServer, refuse);
        LoopbackClient client(context, server.port(), plainClient, upload);
        EXPECT_TRUE(until(3, [&] { return client.session.ended() && server.sessions[0]->ended(); }));
        EXPECT_TRUE(heard);
    }
}

TEST_F(ConnectionTest, HearsLastWordsAfterAReset) {
    // The peer's words are in the socket when a write finds the connection reset.
    tcp::acceptor acceptor(context, {asio::ip::address_v4::loopback(), 0});
    bool heard = false;
    const auto upload = [&](TestSession& session, Connection& connection) {
        session.onFrame = [&](const Frame& frame) { heard |= frame.type == FrameType::Refusal; };
        for (int i = 0; i < 8; ++i) connection.send(chunk(wire::maxPayloadBytes));
    };
    LoopbackClient client(context, acceptor.local_endpoint().port(), plainClient, upload);
    EXPECT_TRUE(until(1, [&] { return client.connection != nullptr; }));
    tcp::socket peer = acceptor.accept();
    EXPECT_TRUE(until(1, [&] { return peer.available() > 0; }));
    asio::write(peer, asio::buffer(wire::encodeFrame({FrameType::Refusal, "", ""})));
    peer.close();  // with bytes unread: a reset
    EXPECT_TRUE(until(2, [&] { return client.session.ended(); }));
    EXPECT_TRUE(heard);
    EXPECT_EQ(client.session.endings, 1);
}

TEST_F(ConnectionTest, EndsOnceWhenItIsCancelled) {
    LoopbackServer server(context, plainServer, echo);
    tcp::socket socket = rawClient(server);
    TestSession session;
    Connection connection(wire::Stream(std::move(socket), plainClient));
    asio::cancellation_signal signal;
    bool returned = false;
    const auto ended = [&](std::exception_ptr failure) { returned = !failure; };
    asio::co_spawn(context, connection.run(session), asio::bind_cancellation_slot(signal.slot(), ended));
    until(0.3, [] { return false; });
    signal.emit(asio::cancellation_type::terminal);
    EXPECT_TRUE(until(1, [&] { return returned; }));
    EXPECT_EQ(session.endings, 1);
    EXPECT_EQ(session.reason, "cancelled");
}

}  // namespace
}  // namespace antipode::test
