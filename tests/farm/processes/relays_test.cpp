// Relays as processes: what they render is what their servers would have rendered for the client itself.
#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

#include <sys/stat.h>

#include "tests/farm/processes/farm_fixture.h"

using namespace antipode::test;

namespace {

using Arguments = std::vector<std::string>;

class FarmRelayProcesses : public FarmProcesses {
protected:
    static Arguments job(uint64_t iterations) { return {"--iterations", std::to_string(iterations)}; }
    static Arguments on(ServerProcess& server) { return {"--server", server.address()}; }
};

}  // namespace

TEST_F(FarmRelayProcesses, TwoLevelsOfThemHaveTheSameHash) {
    ServerProcess a = countingServer("a"), b = countingServer("b"), c = countingServer("c");
    ServerProcess inner = relay("inner", {&a, &b}), outer = relay("outer", {&inner, &c});
    Process render = client("farm", job(400) + on(outer));
    EXPECT_EQ(hashOf("farm", render), countedHash(400)) << outer.process().output();
    for (ServerProcess* server : {&a, &b, &c}) EXPECT_TRUE(server->process().says("opens a job", 0));
}

TEST_F(FarmRelayProcesses, AServerThatIsKilledInMidBlockIsReplaced) {
    auto dies = std::make_unique<ServerProcess>(countingServer("dies"));
    ServerProcess stays = countingServer("stays");
    const int port = dies->port();
    ServerProcess between = relay("relay", {dies.get(), &stays});
    Process render = client("farm", job(400) + on(between));
    ASSERT_TRUE(dies->process().says("opens a job", 10)) << between.process().output();
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    dies->process().signal(SIGKILL);
    ASSERT_TRUE(between.process().says("127.0.0.1:" + std::to_string(port), 10));
    dies.reset();
    ServerProcess again = countingServer("again", 0.01, "honest", {}, port);
    EXPECT_EQ(hashOf("farm", render), countedHash(400));
    EXPECT_EQ(stats("farm")["nodes"][0]["lost_iterations"], 0) << "a block of the relay was lost with its server";
}

TEST_F(FarmRelayProcesses, WhenARelayIsKilledTheClientGoesOnElsewhere) {
    ServerProcess a = countingServer("a"), b = countingServer("b");
    ServerProcess dies = relay("dies", {&a}), stays = relay("stays", {&b});
    Process render = client("farm", job(400) + on(dies) + on(stays));
    ASSERT_TRUE(a.process().says("opens a job", 10) && b.process().says("opens a job", 10));
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    dies.process().signal(SIGKILL);
    EXPECT_EQ(hashOf("farm", render), countedHash(400));
}

TEST_F(FarmRelayProcesses, ALyingServerIsFoundByTheRelay) {
    ServerProcess a = countingServer("a"), b = countingServer("b"), liar = countingServer("liar", 0.01, "liar");
    ServerProcess between = relay("relay", {&a, &b, &liar}, {"--relay-verify", "1"});
    Process render = client("farm", job(200) + on(between));
    EXPECT_EQ(hashOf("farm", render), countedHash(200));
    EXPECT_TRUE(between.process().says("Node " + liar.address() + " is not used any more", 0))
        << between.process().output();
}

TEST_F(FarmRelayProcesses, SigtermDrainsAndLosesNothing) {
    ServerProcess a = countingServer("a"), b = countingServer("b");
    ServerProcess leaves = relay("leaves", {&a}), stays = relay("stays", {&b});
    Process render = client("farm", job(400) + on(leaves) + on(stays));
    ASSERT_TRUE(a.process().says("opens a job", 10) && b.process().says("opens a job", 10));
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    leaves.process().signal(SIGTERM);
    EXPECT_EQ(leaves.process().wait(15), 0) << leaves.process().output();
    EXPECT_TRUE(a.process().says("the client is done", 5)) << "its server was not told";
    EXPECT_EQ(hashOf("farm", render), countedHash(400));
}

TEST_F(FarmRelayProcesses, TheSecretIsNeededOnBothSides) {
    std::ofstream(folder.file("secret")) << "correct horse battery staple 4711";
    std::ofstream(folder.file("other")) << "wrong pony capacitor nail 1174 !";
    for (const char* file : {"secret", "other"}) ::chmod(folder.file(file).c_str(), 0600);
    const Arguments secret = {"--psk-file", "secret"};
    ServerProcess server = countingServer("server", 0.01, "honest", secret);
    ServerProcess good = relay("good", {&server}, secret), bad = relay("bad", {&server}, {"--psk-file", "other"});
    Process render = client("farm", job(50) + on(good) + secret);
    EXPECT_EQ(hashOf("farm", render), countedHash(50));
    Process refused = client("refused", job(50) + on(bad) + Arguments{"--psk-file", "other"});
    EXPECT_EQ(refused.wait(30), 1) << refused.output();
    EXPECT_TRUE(refused.says("None of the relay's servers takes the job", 0)) << refused.output();
}

TEST_F(FarmRelayProcesses, WhatDoesNotFitTogetherIsSaid) {
    for (const auto& [options, sentence] : std::vector<std::pair<Arguments, std::string>>{
             {{"--relay", "127.0.0.1:7011", "--device", "0"}, "A relay has no device"},
             {{"--relay-verify", "1"}, "--relay-verify goes with --relay"},
             {{"--relay", "192.0.2.1:7010"}, "--psk-file"},
             {{"--relay-file", "missing"}, "missing"}}) {
        Process server(Arguments{ANTIPODE_SERVER, "--cache", "cache"} + options, folder.file("."), folder.file("log"));
        EXPECT_TRUE(server.wait(10).value_or(0) != 0) << sentence;
        EXPECT_TRUE(server.says(sentence, 0)) << server.output();
    }
}
