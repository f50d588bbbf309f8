// What the farm does when its parts fail: real processes on loopback, with renderers that count.
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include <unistd.h>

#include "tests/farm/processes/farm_fixture.h"
#include "tests/support/fault_proxy.h"

using namespace antipode::test;

namespace {

using Arguments = std::vector<std::string>;

class FarmFaults : public FarmProcesses {
protected:
    static Arguments job(uint64_t iterations) { return {"--iterations", std::to_string(iterations)}; }
    static Arguments on(ServerProcess& server) { return {"--server", server.address()}; }
};

}  // namespace

TEST_F(FarmFaults, AKilledServerComesBack) {
    auto server = std::make_unique<ServerProcess>(countingServer("server"));
    const int port = server->port();
    Process render = client("farm", job(300) + on(*server));
    ASSERT_TRUE(server->process().says("opens a job", 10)) << server->process().output();
    server->process().signal(SIGKILL);
    ASSERT_TRUE(render.says("127.0.0.1", 10));
    server.reset();
    ServerProcess again = countingServer("again", 0.01, "honest", {}, port);
    EXPECT_EQ(hashOf("farm", render), countedHash(300));
}

TEST_F(FarmFaults, AStoppedServerIsOvertakenAndCannotSpoilAnything) {
    ServerProcess frozen = countingServer("frozen"), other = countingServer("other");
    Process render = client("farm", job(1500) + on(frozen) + on(other));
    ASSERT_TRUE(frozen.process().says("opens a job", 10));
    frozen.process().signal(SIGSTOP);
    std::this_thread::sleep_for(std::chrono::seconds(3));
    frozen.process().signal(SIGCONT);
    EXPECT_EQ(hashOf("farm", render), countedHash(1500));
}

TEST_F(FarmFaults, AHungDeviceWithALivelyConnection) {
    ServerProcess hung = countingServer("hung", 0.01, "hanging"), good = countingServer("good");
    Process render = client("farm", job(200) + on(hung) + on(good));
    EXPECT_EQ(hashOf("farm", render, 40), countedHash(200));
}

TEST_F(FarmFaults, AServerWhoseDeviceIsLostEndsToBeStartedAnew) {
    ServerProcess lost = countingServer("lost", 0.01, "failing"), good = countingServer("good", 0.05);
    Process render = client("farm", job(200) + on(lost) + on(good));
    EXPECT_EQ(lost.process().wait(20), 75) << lost.process().output();
    EXPECT_TRUE(lost.process().says("failed in the middle of a block", 0)) << lost.process().output();
    EXPECT_EQ(hashOf("farm", render), countedHash(200));
    EXPECT_TRUE(render.says("refuses: The server's device failed in the middle of a block", 0)) << render.output();
}

TEST_F(FarmFaults, ASlowServerIsOvertaken) {
    // What it may cost is a matter of the simulation, where time is exact.
    ServerProcess fast = countingServer("fast", 0.02), slow = countingServer("slow", 1.0);
    Process render = client("farm", job(300) + on(fast) + on(slow));
    EXPECT_EQ(hashOf("farm", render), countedHash(300));
}

TEST_F(FarmFaults, ALyingServerIsFoundByCrossChecking) {
    ServerProcess a = countingServer("a"), b = countingServer("b"), liar = countingServer("liar", 0.01, "liar");
    Process render = client("farm", job(400) + on(a) + on(b) + on(liar) + Arguments{"--verify", "0.5"});
    EXPECT_EQ(hashOf("farm", render), countedHash(400));
    EXPECT_TRUE(render.says(liar.address(), 0)) << render.output();
    EXPECT_TRUE(render.says("quarantine", 0)) << render.output();
}

// It has done the whole job before the others are there, and its image does not pass for one.
TEST_F(FarmFaults, ABrokenDeviceThatAnswersZerosAtOnceIsFoundOut) {
    ServerProcess black = countingServer("black", 0.01, "black");
    const auto list = [&](const std::vector<ServerProcess*>& servers) {
        std::ofstream file(folder.file("servers.new"));
        for (ServerProcess* server : servers) file << server->address() << "\n";
        file.close();
        std::rename(folder.file("servers.new").c_str(), folder.file("servers").c_str());
    };
    list({&black});
    Process render = client("farm", job(100) + Arguments{"--servers-file", "servers", "--verify", "0.001"});
    ASSERT_TRUE(render.says("waits for a further node", 20)) << render.output();
    ServerProcess a = countingServer("a"), b = countingServer("b");
    list({&black, &a, &b});
    EXPECT_EQ(hashOf("farm", render, 40), countedHash(100));
}

TEST_F(FarmFaults, AnImageThatNobodyVerifiesIsAFailure) {
    ServerProcess alone = countingServer("alone");
    Process render = client("farm", job(4) + on(alone) + Arguments{"--verify", "1", "--wait", "2"});
    EXPECT_EQ(render.wait(30), 1) << render.output();
    EXPECT_TRUE(render.says("The image is not verified", 0)) << render.output();
    EXPECT_EQ(stats("farm")["iterations"], 4) << "what there is, is written";
}

TEST_F(FarmFaults, ADrainedServerLosesNothing) {
    ServerProcess leaving = countingServer("leaving"), staying = countingServer("staying");
    Process render = client("farm", job(600) + on(leaving) + on(staying));
    ASSERT_TRUE(leaving.process().says("opens a job", 10));
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    leaving.process().signal(SIGTERM);
    EXPECT_EQ(leaving.process().wait(10), 0) << leaving.process().output();
    EXPECT_EQ(hashOf("farm", render), countedHash(600));
}

TEST_F(FarmFaults, ASecondSignalStopsAtOnce) {
    ServerProcess server = countingServer("server", 0.01, "hanging");
    Process render = client("farm", job(4) + on(server));
    ASSERT_TRUE(server.process().says("opens a job", 10));
    server.process().signal(SIGTERM);
    ASSERT_TRUE(server.process().says("draining", 5));
    server.process().signal(SIGTERM);
    EXPECT_EQ(server.process().wait(5), 128 + SIGTERM);
}

TEST_F(FarmFaults, AnInterruptedClientWritesWhatIsCommitted) {
    ServerProcess server = countingServer("server");
    Process render = client("farm", job(100000) + on(server));
    ASSERT_TRUE(server.process().says("opens a job", 10));
    std::this_thread::sleep_for(std::chrono::seconds(1));
    render.signal(SIGINT);
    ASSERT_EQ(render.wait(10), 0) << render.output();
    EXPECT_TRUE(stats("farm")["interrupted"]);
    EXPECT_GT(stats("farm")["iterations"], 0);
    EXPECT_TRUE(std::ifstream(folder.file("farm.exr")));
}

TEST_F(FarmFaults, RepeatsOfASignalWithinASecondAreOne) {
    ServerProcess server = countingServer("server");
    Process render = client("farm", job(100000) + on(server));
    ASSERT_TRUE(server.process().says("opens a job", 10));
    std::this_thread::sleep_for(std::chrono::seconds(1));
    for (const int number : {SIGINT, SIGINT, SIGTERM, SIGINT}) render.signal(number);
    ASSERT_EQ(render.wait(10), 0) << render.output();
    EXPECT_TRUE(stats("farm")["interrupted"]);
    EXPECT_EQ(stats("farm")["sums_sha256"], countedHash(stats("farm")["iterations"]));
}

TEST_F(FarmFaults, ALaterSecondSignalEndsTheClientAtOnce) {
    ServerProcess server = countingServer("server"), slow = countingServer("slow", 20);
    // The slow server's iteration keeps the client from ending before its farewell time of three seconds is over.
    Process render = client("farm", job(100000) + on(server) + on(slow));
    ASSERT_TRUE(server.process().says("opens a job", 10) && slow.process().says("opens a job", 10));
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));
    render.signal(SIGINT);
    std::this_thread::sleep_for(std::chrono::milliseconds(1300));
    render.signal(SIGINT);
    ASSERT_EQ(render.wait(1), -SIGINT) << render.output();
    EXPECT_FALSE(std::ifstream(folder.file("farm.exr")));
}

TEST_F(FarmFaults, EverySignalThatEndsJobsSavesThem) {
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
        ServerProcess server = countingServer("server" + std::to_string(number));
        Process render = client("farm", job(100000) + on(server));
        ASSERT_TRUE(server.process().says("opens a job", 10));
        std::this_thread::sleep_for(std::chrono::seconds(1));
        std::filesystem::remove(folder.file("farm.exr"));
        render.signal(number);
        ASSERT_EQ(render.wait(10), 0) << number << render.output();
        EXPECT_TRUE(std::ifstream(folder.file("farm.exr"))) << number;
    }
}

TEST_F(FarmFaults, BeforeAnythingIsRenderedASignalEndsTheClientAtOnce) {
    // Connecting for ever: nobody listens there.
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
        Process render = client("farm" + std::to_string(number), job(10) + Arguments{"--server", "127.0.0.1:1"});
        ASSERT_TRUE(render.says("127.0.0.1:1", 10)) << render.output();
        render.signal(number);
        EXPECT_EQ(render.wait(1), 1) << render.output();
        EXPECT_TRUE(render.says("nothing was rendered, nothing is written", 0)) << render.output();
        EXPECT_FALSE(render.says("Finishing", 0)) << render.output();
    }
}

TEST_F(FarmFaults, SigUsr1WritesAndGoesOn) {
    ServerProcess server = countingServer("server");
    Process render = client("farm", job(100000) + on(server) + Arguments{"--checkpoint", "job.checkpoint"});
    ASSERT_TRUE(server.process().says("opens a job", 10));
    for (int round = 0; round < 2; ++round) {
        std::this_thread::sleep_for(std::chrono::seconds(1));
        for (const char* file : {"farm.exr", "farm.png", "job.checkpoint"}) std::filesystem::remove(folder.file(file));
        render.signal(SIGUSR1);
        for (int i = 0; i < 500 && !std::filesystem::exists(folder.file("job.checkpoint")); ++i) ::usleep(10000);
        for (const char* file : {"farm.exr", "farm.png", "job.checkpoint"})
            EXPECT_TRUE(std::filesystem::exists(folder.file(file))) << file << "\n" << render.output();
        ASSERT_TRUE(render.running()) << render.output();
    }
    render.signal(SIGTERM);
    EXPECT_EQ(render.wait(10), 0) << render.output();
}

TEST_F(FarmFaults, OneCommandLineStartsAndGoesOn) {
    ServerProcess server = countingServer("server");
    const Arguments kept{"--checkpoint", "job.checkpoint"};
    Process start = client("farm", job(100000) + on(server) + kept);
    ASSERT_TRUE(server.process().says("opens a job", 10));
    std::this_thread::sleep_for(std::chrono::seconds(1));
    start.signal(SIGTERM);
    ASSERT_EQ(start.wait(10), 0) << start.output();
    const uint64_t rendered = stats("farm")["iterations"], wanted = rendered + 50;

    Process again = client("again", job(wanted) + on(server) + kept);
    EXPECT_EQ(hashOf("again", again), countedHash(wanted));
    EXPECT_EQ(stats("again")["resumed_iterations"], rendered);

    // All of it is there: no server is asked, and none is waited for.
    Process done = client("done", job(wanted) + Arguments{"--server", "127.0.0.1:1"} + kept);
    EXPECT_EQ(hashOf("done", done, 5), countedHash(wanted));
    EXPECT_TRUE(std::ifstream(folder.file("done.exr")));

    const auto content = [&] {
        std::ifstream file(folder.file("job.checkpoint"));
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    const std::string before = content();
    Process other = client("other", job(wanted) + on(server) + kept + Arguments{"--seed", "2"});
    EXPECT_EQ(other.wait(10), 2) << other.output();
    EXPECT_TRUE(other.says("seed is 1, not 2", 0) && other.says("'job.checkpoint' is left as it is", 0))
        << other.output();
    Process fewer = client("fewer", job(3) + on(server) + kept);
    EXPECT_EQ(fewer.wait(10), 2) << fewer.output();
    Process replaced = client("replaced", job(wanted) + on(server) + kept + Arguments{"--resume", "elsewhere"});
    EXPECT_EQ(replaced.wait(10), 2) << replaced.output();
    EXPECT_EQ(content(), before);

    std::ofstream(folder.file("notes.txt")) << "not a checkpoint";
    Process mistaken = client("mistaken", job(3) + on(server) + Arguments{"--checkpoint", "notes.txt"});
    EXPECT_EQ(mistaken.wait(10), 1) << mistaken.output();
    EXPECT_EQ(std::filesystem::file_size(folder.file("notes.txt")), 16u);
}

TEST_F(FarmFaults, WaitBoundsHowLongAServerIsWaitedFor) {
    std::ofstream(folder.file("none")) << "# nobody yet\n";
    const std::vector<std::pair<Arguments, std::string>> cases{
        {{"--servers-file", "none", "--wait", "1"}, "1.0 s (--wait): no server is named"},
        {{"--servers-file", "none", "--time", "1"}, "1.0 s (--time): no server is named"},
        {{"--server", "127.0.0.1:1", "--wait", "1"}, "(--wait): 127.0.0.1:1: cannot connect"},
        {{"--server", "127.0.0.1:1", "--time", "1", "--wait", "30"}, "1.0 s (--time)"}};
    for (const auto& [options, words] : cases) {
        Process render = client("farm", options);
        EXPECT_EQ(render.wait(5), 1) << render.output();
        EXPECT_TRUE(render.says(words, 0)) << words << "\n" << render.output();
        EXPECT_FALSE(std::ifstream(folder.file("farm.exr")));
    }
}

TEST_F(FarmFaults, WhatIsThereIsWrittenWhenTheWaitIsOver) {
    auto server = std::make_unique<ServerProcess>(countingServer("server"));
    Process render = client("farm", job(100000) + on(*server) + Arguments{"--wait", "2"});
    ASSERT_TRUE(server->process().says("opens a job", 10));
    std::this_thread::sleep_for(std::chrono::seconds(1));
    server->process().signal(SIGKILL);
    EXPECT_EQ(render.wait(10), 1) << render.output();
    EXPECT_TRUE(render.says("(--wait)", 0)) << render.output();
    EXPECT_TRUE(std::ifstream(folder.file("farm.exr")));
    EXPECT_EQ(stats("farm")["sums_sha256"], countedHash(stats("farm")["iterations"]));
}

TEST_F(FarmFaults, TheTimeEndsARenderWhoseServersAreGone) {
    auto server = std::make_unique<ServerProcess>(countingServer("server"));
    Process render = client("farm", Arguments{"--time", "3"} + on(*server));
    ASSERT_TRUE(server->process().says("opens a job", 10));
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));
    server->process().signal(SIGKILL);
    EXPECT_EQ(render.wait(12), 0) << render.output();
    EXPECT_TRUE(std::ifstream(folder.file("farm.exr")));
}

TEST_F(FarmFaults, ATimeLimitLeavesAPrefixOfAllIterations) {
    ServerProcess a = countingServer("a"), b = countingServer("b", 0.07);
    Process render = client("farm", Arguments{"--time", "2"} + on(a) + on(b));
    const std::string hash = hashOf("farm", render);
    EXPECT_EQ(hash, countedHash(stats("farm")["iterations"]));
    EXPECT_FALSE(stats("farm")["interrupted"]);
}

TEST_F(FarmFaults, ServersComeAndGoThroughTheServersFile) {
    std::vector<ServerProcess> servers;
    for (int i = 0; i < 8; ++i) servers.push_back(countingServer("server" + std::to_string(i), 0.02));
    const auto list = [&](size_t count) {
        std::ofstream file(folder.file("servers.new"));
        file << "# render nodes\n";
        for (size_t i = 0; i < count; ++i) file << servers[i].address() << "\n";
        file.close();
        std::rename(folder.file("servers.new").c_str(), folder.file("servers").c_str());
    };
    list(1);
    Process render = client("farm", job(2000) + Arguments{"--servers-file", "servers"});
    for (const size_t count : {8, 0, 3}) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2500));
        list(count);
    }
    EXPECT_EQ(hashOf("farm", render), countedHash(2000));
}

TEST_F(FarmFaults, AServerThatMayNotBeUsedChangesNothing) {
    ServerProcess server = countingServer("server", 0.02);
    const auto list = [&](const std::string& more) {
        std::ofstream(folder.file("servers")) << server.address() << "\n" << more << "\n";
    };
    list("");
    Process render = client("farm", job(300) + Arguments{"--servers-file", "servers"});
    ASSERT_TRUE(server.process().says("opens a job", 10));
    list("192.0.2.1:7010");
    EXPECT_TRUE(render.says("192.0.2.1:7010 can be reached by others", 5)) << render.output();
    EXPECT_EQ(hashOf("farm", render), countedHash(300));
    EXPECT_EQ(stats("farm")["nodes"][0]["connections"], 1);
}

TEST_F(FarmFaults, ACheckpointThatCannotBeWrittenCostsNoImage) {
    ServerProcess server = countingServer("server", 0.02);
    std::filesystem::create_directory(folder.file("disk"));
    Process render = client("farm", job(100) + on(server) + Arguments{"--checkpoint", "disk/job.checkpoint"});
    ASSERT_TRUE(server.process().says("opens a job", 10));
    std::filesystem::remove_all(folder.file("disk"));
    EXPECT_EQ(render.wait(30), 1) << render.output();
    EXPECT_TRUE(render.says("job.checkpoint", 0)) << render.output();
    EXPECT_EQ(stats("farm")["sums_sha256"], countedHash(100));
    EXPECT_TRUE(std::ifstream(folder.file("farm.exr")));
}

TEST_F(FarmFaults, TwoClientsShareAServer) {
    ServerProcess server = countingServer("server");
    Process first = client("first", job(200) + on(server)), second = client("second", job(200) + on(server));
    EXPECT_EQ(hashOf("first", first), countedHash(200));
    EXPECT_EQ(hashOf("second", second), countedHash(200));
}

TEST_F(FarmFaults, ABadNetworkChangesNothing) {
    ServerProcess server = countingServer("server", 0.005);
    uint64_t faults = 0;
    for (const uint64_t seed : {1, 2, 3, 4}) {
        FaultOptions options;
        options.seed = seed;
        options.meanSegmentBytes = 96;
        options.split = options.coalesce = options.delay = 0.1;
        options.flip = options.duplicate = options.drop = options.truncate = options.reset = 0.005;
        FaultProxy proxy(uint16_t(server.port()), options);
        Process render = client("farm", job(300) + Arguments{"--server", "127.0.0.1:" + std::to_string(proxy.port())});
        EXPECT_EQ(hashOf("farm", render, 120), countedHash(300)) << "seed " << seed;
        const FaultCounters counters = proxy.counters();
        faults += counters.flip + counters.duplicate + counters.drop + counters.truncate + counters.reset;
    }
    EXPECT_GT(faults, 0u) << "the proxy broke nothing";
}

TEST_F(FarmFaults, APulledCableIsNoticed) {
    ServerProcess server = countingServer("server", 0.01), other = countingServer("other", 0.05);
    FaultProxy proxy(uint16_t(server.port()), {});
    Process render =
        client("farm", job(300) + on(other) + Arguments{"--server", "127.0.0.1:" + std::to_string(proxy.port())});
    ASSERT_TRUE(server.process().says("opens a job", 10));
    proxy.blackHole();
    EXPECT_EQ(hashOf("farm", render), countedHash(300));
}
