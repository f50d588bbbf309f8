// Invariant 1 with real processes and the real engine: one hash, whatever happens to the farm.
#include <csignal>
#include <fstream>

#include "tests/farm/processes/farm_fixture.h"
#include "tests/film/exr_channels.h"

using namespace antipode::test;

namespace {

using Arguments = std::vector<std::string>;

class OneImage : public FarmProcesses {
protected:
    void SetUp() override {
        if (!hasDevice()) GTEST_SKIP() << "This machine has no usable device.";
        FarmProcesses::SetUp();
        expected = standaloneHash(job);
    }

    const Arguments job{"--iterations", "48", "--seed", "11", "--quiet"};
    std::string expected;
};

}  // namespace

TEST_F(OneImage, OneTwoAndFourServers) {
    std::vector<ServerProcess> servers;
    for (const size_t count : {1, 2, 4}) {
        Arguments options = job;
        while (servers.size() < count) servers.push_back(realServer("server" + std::to_string(servers.size())));
        for (ServerProcess& server : servers) options.insert(options.end(), {"--server", server.address()});
        Process render = client("farm", options);
        EXPECT_EQ(hashOf("farm", render), expected) << count << " servers";
    }
}

/// All that can be asked for at once, each block rendered twice: the same channels under the same names, and the
/// image's own hash as without layers; by independent numbers, since Sobol's are others for other residue classes.
TEST_F(OneImage, LayersAreThoseOfOneMachine) {
    const Arguments independent{"--sampler", "independent"};
    const std::string plain = standaloneHash(job + independent);
    const Arguments layers =
        independent + Arguments{"--layers", "albedo,N,Z,P,coverage,emitter-hit,next-event,splat,connection,merge",
                                "--residue-classes", "3"};
    EXPECT_EQ(standaloneHash(job + layers), plain);
    ServerProcess one = realServer("one"), two = realServer("two");
    Process render =
        client("farm", job + layers + Arguments{"--server", one.address(), "--server", two.address(), "--verify", "1"});
    ASSERT_EQ(hashOf("farm", render), plain);

    const auto alone = channelsOf(folder.file("alone.exr")), farm = channelsOf(folder.file("farm.exr"));
    EXPECT_TRUE(farm == alone);
    for (const char* name : {"R", "albedo.G", "N.X", "Z", "P.Z", "coverage.A", "emitter_hit.R", "next_event.G",
                             "splat.B", "connection.R", "merge.R", "residue0.R", "residue2.B"})
        EXPECT_TRUE(alone.contains(name)) << name;
    EXPECT_EQ(alone.size(), 3u + 3 + 3 + 1 + 3 + 1 + 5 * 3 + 3 * 3);
}

/// Whoever rendered which block: classes are a function of the iteration.
TEST_F(OneImage, TheErrorIsThatOfOneMachineToTheBit) {
    const auto alone = stats("alone")["error"];
    ASSERT_GT(alone["percent"], 0);
    ASSERT_GT(alone["bias_high"], 0);
    ServerProcess one = realServer("one"), two = realServer("two");
    for (const Arguments& more : {Arguments{"--server", one.address(), "--local"},
                                  Arguments{"--server", one.address(), "--server", two.address(), "--verify", "1"}}) {
        Process render = client("farm", job + more);
        ASSERT_EQ(hashOf("farm", render), expected);
        EXPECT_EQ(stats("farm")["error"], alone);
    }
    EXPECT_EQ(standaloneHash(job + Arguments{"--no-error"}), expected);
    EXPECT_FALSE(stats("alone").contains("error"));
}

TEST_F(OneImage, TheBiasIsThatOfOneMachine) {
    const Arguments wide = job + Arguments{"--layers", "bias", "--technique", "bpm", "--radius-factor", "8"};
    const std::string alone = standaloneHash(wide);
    const auto told = stats("alone")["error"];
    EXPECT_GT(told["bias_high"], 0);
    ServerProcess one = realServer("one"), two = realServer("two");
    Process render = client("farm", wide + Arguments{"--server", one.address(), "--server", two.address()});
    ASSERT_EQ(hashOf("farm", render), alone);
    EXPECT_EQ(stats("farm")["error"], told);
    EXPECT_TRUE(channelsOf(folder.file("farm.exr")) == channelsOf(folder.file("alone.exr")));
    EXPECT_TRUE(channelsOf(folder.file("alone.exr")).contains("bias.Y"));
}

/// The target is looked at after numbers of iterations that no arrival decides.
TEST_F(OneImage, ATargetErrorEndsAfterTheSameIteration) {
    const Arguments untilTarget{"--target-error", "30", "--seed", "11", "--quiet"};
    const std::string alone = standaloneHash(untilTarget);
    const auto expectedStats = stats("alone");
    EXPECT_EQ(expectedStats["stopped_by"], "target-error");
    EXPECT_LE(expectedStats["error"]["percent"], 30);
    ServerProcess one = realServer("one"), two = realServer("two");
    Process render =
        client("farm", untilTarget + Arguments{"--server", one.address(), "--server", two.address(), "--local"});
    EXPECT_EQ(hashOf("farm", render), alone);
    EXPECT_EQ(stats("farm")["iterations"], expectedStats["iterations"]);
    EXPECT_EQ(stats("farm")["error"], expectedStats["error"]);
    EXPECT_EQ(stats("farm")["stopped_by"], "target-error");
}

TEST_F(OneImage, ServersBesideTheLocalDevice) {
    ServerProcess server = realServer("server");
    Process render = client("farm", job + Arguments{"--server", server.address(), "--local"});
    EXPECT_EQ(hashOf("farm", render), expected);
    EXPECT_EQ(stats("farm")["nodes"].size(), 2u);
}

TEST_F(OneImage, AServerKilledInMidRun) {
    ServerProcess victim = realServer("victim"), survivor = realServer("survivor");
    const Arguments longJob{"--iterations", "96",      "--seed", "11",       "--technique",
                            "vcm",          "--width", "96",     "--height", "64"};
    const std::string alone = standaloneHash(longJob);
    Process render = client("farm", longJob + Arguments{"--server", victim.address(), "--server", survivor.address()});
    ASSERT_TRUE(victim.process().says("opens a job", 20)) << victim.process().output();
    victim.process().signal(SIGKILL);
    EXPECT_EQ(hashOf("farm", render, 120), alone);
}

TEST_F(OneImage, AClientKilledAndResumed) {
    ServerProcess server = realServer("server");
    const Arguments options =
        Arguments{"--iterations", "200", "--seed", "11", "--checkpoint-every", "0.05", "--server", server.address()};
    const std::string alone = standaloneHash({"--iterations", "200", "--seed", "11", "--quiet"});
    {
        Process first = client("first", options + Arguments{"--checkpoint", "job.checkpoint"});
        const std::string checkpoint = folder.file("job.checkpoint");
        for (int i = 0; i < 2000 && !std::ifstream(checkpoint); ++i) ::usleep(10000);
        first.signal(SIGKILL);
        ASSERT_EQ(first.wait(10), -SIGKILL);
        ASSERT_TRUE(std::ifstream(checkpoint)) << first.output();
    }
    Process second = client("second", options + Arguments{"--resume", "job.checkpoint"});
    EXPECT_EQ(hashOf("second", second), alone);
    EXPECT_GT(stats("second")["resumed_iterations"], 0);
}
