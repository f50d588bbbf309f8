// deploy/make-certs, and that servers and clients take what it makes.
#include <gtest/gtest.h>

#include <cstdlib>

#include <sys/stat.h>
#include <sys/wait.h>

#include "tests/net/credentials.h"
#include "tests/net/loopback.h"

namespace antipode::test {
namespace {

using wire::Security;
using Role = Security::Role;

int makeCerts(const std::string& arguments) {
    const int status =
        std::system(("'" ANTIPODE_SOURCE_DIR "/deploy/make-certs' " + arguments + " >/dev/null 2>&1").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(MakeCerts, MakesWhatServersAndClientsTake) {
    const TemporaryFolder folder;
    const std::string directory = folder.file("certs");
    ASSERT_EQ(makeCerts("'" + directory + "' 127.0.0.1 node7.farm ::1"), 0);
    for (const char* key : {"ca", "client", "server-127.0.0.1", "server-node7.farm", "server---1"}) {
        struct stat status {};
        ASSERT_EQ(::stat((directory + "/" + key + ".key").c_str(), &status), 0) << key;
        EXPECT_EQ(status.st_mode & 0777, 0600u) << key;
    }
    const auto certificate = [&](const std::string& name) {
        return wire::SecurityOptions{"", directory + "/" + name + ".pem", directory + "/" + name + ".key",
                                     directory + "/ca.pem"};
    };
    const Security client(certificate("client"), Role::Client);
    const std::pair<const char*, const char*> servers[] = {
        {"server-127.0.0.1", "127.0.0.1"}, {"server-node7.farm", "node7.farm"}, {"server---1", "::1"}};
    for (const auto& [file, name] : servers) {
        const Security server(certificate(file), Role::Server);
        asio::io_context context;
        LoopbackServer listener(context, server, echo);
        LoopbackClient dialler(
            context, listener.port(), client,
            [](TestSession& session, wire::Connection& connection) {
                session.onFrame = [&](const wire::Frame&) { connection.close("echo"); };
                connection.send({wire::FrameType::Heartbeat, "", ""});
            },
            name);
        EXPECT_TRUE(runUntil(context, 2, [&] { return dialler.session.ended(); }));
        EXPECT_EQ(dialler.session.reason, "echo");
    }
}

TEST(MakeCerts, ARelayIsServerAndClientAndAServerIsNoClient) {
    const TemporaryFolder folder;
    const std::string directory = folder.file("certs");
    ASSERT_EQ(makeCerts("'" + directory + "' 127.0.0.1"), 0);
    ASSERT_EQ(makeCerts("--relay '" + directory + "' localhost"), 0);
    const auto welcomes = [&](const std::string& dials) {
        const auto certificate = [&](const std::string& name) {
            return wire::SecurityOptions{"", directory + "/" + name + ".pem", directory + "/" + name + ".key",
                                         directory + "/ca.pem"};
        };
        const Security server(certificate("server-127.0.0.1"), Role::Server), client(certificate(dials), Role::Client);
        asio::io_context context;
        LoopbackServer listener(context, server, echo);
        LoopbackClient dialler(
            context, listener.port(), client,
            [](TestSession& session, wire::Connection& connection) {
                session.onFrame = [&](const wire::Frame&) { connection.close("echo"); };
                connection.send({wire::FrameType::Heartbeat, "", ""});
            },
            "127.0.0.1");
        EXPECT_TRUE(runUntil(context, 2, [&] { return dialler.session.ended(); }));
        return dialler.session.reason == "echo";
    };
    EXPECT_TRUE(welcomes("server-localhost"));
    EXPECT_FALSE(welcomes("server-127.0.0.1"));
}

TEST(MakeCerts, AddsServersAndReplacesNothing) {
    const TemporaryFolder folder;
    const std::string directory = folder.file("certs");
    const auto content = [&](const std::string& name) {
        std::ifstream file(directory + "/" + name, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    ASSERT_EQ(makeCerts("'" + directory + "' a"), 0);
    const std::string ca = content("ca.pem"), client = content("client.pem"), server = content("server-a.pem");
    EXPECT_EQ(makeCerts("'" + directory + "' b a"), 1);
    EXPECT_EQ(content("server-b.pem"), "");
    EXPECT_EQ(makeCerts("--days 3 '" + directory + "' b"), 0);
    EXPECT_NE(content("server-b.pem"), "");
    EXPECT_EQ(content("ca.pem"), ca);
    EXPECT_EQ(content("client.pem"), client);
    EXPECT_EQ(content("server-a.pem"), server);
    EXPECT_NE(ca, "");
}

TEST(MakeCerts, RefusesWhatItDoesNotUnderstand) {
    const TemporaryFolder folder;
    const std::string directory = "'" + folder.file("certs") + "'";
    const std::string argumentLists[] = {
        "",      directory, directory + " 'a b'", directory + " -x", directory + " a/b", "--days 0 " + directory + " a",
        "--days"};
    for (const std::string& arguments : argumentLists) EXPECT_EQ(makeCerts(arguments), 2) << arguments;
    EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace antipode::test
