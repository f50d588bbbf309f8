// Who is let in, and that who is not is told why and leaves the server as it was.
#include <gtest/gtest.h>

#include <asio/connect.hpp>

#include "proto/farm.pb.h"
#include "proto/wire/stream.h"
#include "tests/net/credentials.h"
#include "tests/net/loopback.h"

namespace antipode::test {
namespace {

using wire::Frame;
using wire::FrameType;
using wire::Security;
using wire::SecurityOptions;
using Role = Security::Role;

const Frame hello{FrameType::Hello, "who is there", ""};

/// What the peer answered to `hello`: itself, or a refusal's sentence.
std::string answerIn(const Frame& frame) {
    if (equal(frame, hello)) return "echo";
    farm::Refusal refusal;
    return frame.type == FrameType::Refusal && refusal.ParseFromString(frame.message) ? refusal.sentence()
                                                                                      : "another frame";
}

/// Sends a frame, and closes when it is answered.
void greet(TestSession& session, wire::Connection& connection) {
    session.onFrame = [&connection](const Frame& frame) { connection.close(answerIn(frame)); };
    connection.send(hello);
}

struct Pair {
    std::string name;
    SecurityOptions client, server;
    std::string clientWords = {}, serverWords = {};  ///< what each says where they refuse each other
    std::string dialled = "127.0.0.1";
};

void expectEcho(asio::io_context& context, uint16_t port, const Security& security) {
    LoopbackClient client(context, port, security, greet);
    EXPECT_TRUE(runUntil(context, 3, [&] { return client.session.ended(); }));
    EXPECT_EQ(client.session.reason, "echo");
    EXPECT_EQ(client.session.endings, 1);
}

TEST(Handshake, LetsFriendsIn) {
    const Credentials& c = credentials();
    const SecurityOptions secret = c.secret("9c1f04e7ab52d836");
    const Pair friends[] = {{"plain", {}, {}},
                            {"secret", secret, secret},
                            {"secret with newline", c.secret("9c1f04e7ab52d836\n"), secret},
                            {"certificates", c.client(), c.server()}};
    for (const Pair& pair : friends) {
        SCOPED_TRACE(pair.name);
        const Security clientSide(pair.client, Role::Client), serverSide(pair.server, Role::Server);
        asio::io_context context;
        LoopbackServer server(context, serverSide, echo);
        for (int i = 0; i < 3; ++i) expectEcho(context, server.port(), clientSide);
        EXPECT_TRUE(runUntil(context, 1, [&] { return server.sessions.back()->ended(); }));
        EXPECT_EQ(server.received(), 3u);
        for (const auto& session : server.sessions)
            EXPECT_EQ(session->reason, "the peer closed the connection: End of file");
    }
}

TEST(Handshake, ChecksTheNameThatWasDialled) {
    const Credentials& c = credentials();
    const Security client(c.client(), Role::Client);
    const Security server(c.certificate({"DNS:node7.farm,IP:::1"}, c.ca, c.ca), Role::Server);
    asio::io_context context;
    LoopbackServer listener(context, server, echo);
    const std::pair<const char*, bool> names[] = {{"node7.farm", true}, {"::1", true},        {"node8.farm", false},
                                                  {"farm", false},      {"127.0.0.1", false}, {"", false}};
    for (const auto& [name, right] : names) {
        SCOPED_TRACE(name);
        LoopbackClient dialler(context, listener.port(), client, greet, name);
        EXPECT_TRUE(runUntil(context, 2, [&] { return dialler.session.ended(); }));
        EXPECT_EQ(dialler.session.reason == "echo", right) << dialler.session.reason;
    }
}

TEST(Handshake, RefusesStrangersAndServesFriendsAfterwards) {
    const Credentials& c = credentials();
    const SecurityOptions secret = c.secret("9c1f04e7ab52d836"), otherSecret = c.secret("9c1f04e7ab52d837");
    const CertificateOptions serverSays{"IP:127.0.0.1"}, clientSays{"", "clientAuth"};
    CertificateOptions oldServer = serverSays, oldClient = clientSays;
    oldServer.secondsFromNow = oldClient.secondsFromNow = -60;
    const Pair strangers[] = {
        {"other secret", otherSecret, secret, "does not accept our secret", "the client has another secret"},
        {"no secret", {}, secret, "takes TLS alone: give --psk-file", "does not speak TLS"},
        {"needless secret", secret, {}, "the server does not speak TLS", "protocol error"},
        {"secret to certificates", secret, c.server(), "a secret is expected", "does not accept our certificate"},
        {"certificate to secret", c.client(), secret, "does not accept our certificate", "does not know the secret"},
        {"plain to certificates", {}, c.server(), "takes TLS alone: give --psk-file", "does not speak TLS"},
        {"certificate to plain", c.client(), {}, "does not speak TLS", "protocol error"},
        {"client of another CA", c.certificate(clientSays, c.otherCa, c.ca), c.server(),
         "does not accept our certificate", "unable to get local issuer"},
        {"server of another CA", c.client(), c.certificate(serverSays, c.otherCa, c.ca), "unable to get local issuer",
         "does not accept our certificate"},
        {"expired client", c.certificate(oldClient, c.ca, c.ca), c.server(), "does not accept our certificate",
         "certificate has expired"},
        {"expired server", c.client(), c.certificate(oldServer, c.ca, c.ca), "certificate has expired",
         "does not accept our certificate"},
        {"client as server", c.client(), c.certificate({"IP:127.0.0.1", "clientAuth"}, c.ca, c.ca), "purpose",
         "does not accept our certificate"},
        {"server as client", c.certificate(serverSays, c.ca, c.ca), c.server(), "does not accept our certificate",
         "purpose"},
        {"wrong address", c.client(), c.certificate({"IP:127.0.0.2"}, c.ca, c.ca), "IP address mismatch",
         "does not accept our certificate"},
        {"wrong name", c.client(), c.certificate({"DNS:localhost"}, c.ca, c.ca), "node7", "our certificate", "node7"},
    };
    for (const Pair& pair : strangers) {
        SCOPED_TRACE(pair.name);
        const Security clientSide(pair.client, Role::Client), serverSide(pair.server, Role::Server);
        asio::io_context context;
        LoopbackServer server(context, serverSide, echo);
        LoopbackClient stranger(context, server.port(), clientSide, greet, pair.dialled);
        const auto over = [&] {
            return stranger.session.ended() && !server.sessions.empty() && server.sessions[0]->ended();
        };
        EXPECT_TRUE(runUntil(context, 2, over));
        EXPECT_NE(stranger.session.reason.find(pair.clientWords), std::string::npos) << stranger.session.reason;
        ASSERT_EQ(server.sessions.size(), 1u);
        EXPECT_NE(server.sessions[0]->reason.find(pair.serverWords), std::string::npos) << server.sessions[0]->reason;
        EXPECT_EQ(server.received(), 0u);
        // Only who speaks no TLS, and so reads what is plain, can be told what is missing.
        EXPECT_EQ(stranger.session.received, pair.client.any() ? 0u : 1u);

        SecurityOptions ours = pair.server.certFile.empty() ? pair.server : c.client();
        const bool canBeServed = pair.server.certFile.empty() || pair.serverWords != "does not accept our certificate";
        if (canBeServed && pair.dialled == "127.0.0.1")
            expectEcho(context, server.port(), Security(ours, Role::Client));
    }
}

TEST(Handshake, GivesUpASilentPeerAndServesOthersMeanwhile) {
    const SecurityOptions secret = credentials().secret("9c1f04e7ab52d836");
    const Security clientSide(secret, Role::Client), serverSide(secret, Role::Server);
    asio::io_context context;
    LoopbackServer server(context, serverSide, echo);
    server.handshakeSeconds = 1;
    asio::ip::tcp::socket silent(context);
    silent.connect({asio::ip::address_v4::loopback(), server.port()});
    const double start = wire::monotonicSeconds();
    expectEcho(context, server.port(), clientSide);
    EXPECT_TRUE(runUntil(context, 4, [&] { return server.sessions[0]->ended(); }));
    EXPECT_NEAR(wire::monotonicSeconds() - start, server.handshakeSeconds, 0.5);
    EXPECT_NE(server.sessions[0]->reason.find("does not answer in TLS"), std::string::npos);
}

TEST(Connect, SaysWhatCannotBeReached) {
    asio::io_context context;
    asio::ip::tcp::acceptor acceptor(context, {asio::ip::address_v4::loopback(), 0});
    const uint16_t port = acceptor.local_endpoint().port();
    acceptor.close();
    const Security plain({}, Role::Client);
    LoopbackClient client(context, port, plain, greet);
    EXPECT_TRUE(runUntil(context, 2, [&] { return client.session.ended(); }));
    EXPECT_NE(client.session.reason.find("cannot connect to 127.0.0.1:" + std::to_string(port)), std::string::npos);
    EXPECT_NE(client.session.reason.find("refused"), std::string::npos);
}

}  // namespace
}  // namespace antipode::test
