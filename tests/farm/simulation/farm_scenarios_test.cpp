// What a farm promises, each promise in a farm of its own. Virtual seconds; nothing here is measured on a clock.
#include <gtest/gtest.h>

#include "proto/wire/block_codec.h"
#include "tests/farm/simulation/simulated_farm.h"

namespace antipode::simulation {
namespace {

ServerModel server(double secondsPerIteration) {
    ServerModel model;
    model.device.secondsPerIteration = secondsPerIteration;
    return model;
}

void expectSound(const SimulatedFarm& farm) {
    for (const std::string& failure : farm.failures()) ADD_FAILURE() << failure;
    for (const auto& client : farm.clients())
        if (const auto wrong = client->wrongResult()) ADD_FAILURE() << *wrong;
}

/// Of a job on servers with these seconds per iteration.
double secondsOf(const ClientModel& job, const std::vector<double>& servers) {
    SimulatedFarm farm(1);
    SimulatedClient& client = farm.addClient(job);
    for (const double seconds : servers) client.useServer(farm.addServer(server(seconds)));
    farm.run(100000);
    expectSound(farm);
    return farm.seconds();
}

uint64_t committed(const SimulatedClient& client) { return client.coordinator().committed().count(); }

uint64_t rendered(SimulatedFarm& farm) {
    uint64_t iterations = 0;
    for (const auto& each : farm.servers()) iterations += each->iterations();
    return iterations;
}

/// A scene whose blobs are of this size together, nearly.
std::shared_ptr<const wire::ScenePackage> sceneOf(size_t bytes) {
    Scene scene = test::tinyScene();
    Mesh& floor = scene.meshes.front();
    while (floor.positions.size() * sizeof(Vec3f) < bytes)
        floor.positions.push_back({0, float(floor.positions.size()), 0});
    return std::make_shared<wire::ScenePackage>(wire::packageScene(scene));
}

LinkQuality lineOf(double kilobitsPerSecond, double latency) {
    return {.latency = latency, .bytesPerSecond = kilobitsPerSecond * 1000 / 8};
}

}  // namespace

TEST(FarmScenarios, FourServersTakeAQuarterOfTheTime) {
    const ClientModel job = tinyJob(4000);
    const double one = secondsOf(job, {0.1}), four = secondsOf(job, {0.1, 0.1, 0.1, 0.1});
    RecordProperty("efficiency", std::to_string(one / (4 * four)));
    EXPECT_GE(one / (4 * four), 0.9) << one << " s and " << four << " s";
}

TEST(FarmScenarios, AServerAtAFiftiethOfTheSpeedCostsLittle) {
    const ClientModel job = tinyJob(2000);
    const double without = secondsOf(job, {0.1, 0.1, 0.1}), with = secondsOf(job, {0.1, 0.1, 0.1, 5.0});
    RecordProperty("ratio", std::to_string(with / without));
    EXPECT_LE(with / without, 1.3) << without << " s and " << with << " s";
}

TEST(FarmScenarios, FasterServersRenderMore) {
    SimulatedFarm farm(2);
    SimulatedClient& client = farm.addClient(tinyJob(2200));
    client.useServer(farm.addServer(server(0.1)));
    client.useServer(farm.addServer(server(1.0)));
    farm.run(1000);
    expectSound(farm);
    EXPECT_LT(farm.seconds(), 2200 / 11.0 * 1.1 + 5);
}

TEST(FarmScenarios, TheClientsOwnDeviceRendersWithTheServers) {
    SimulatedFarm farm(16);
    ClientModel job = tinyJob(1000);
    job.device = DeviceModel{0.1, 0.5, false};
    SimulatedClient& client = farm.addClient(job);
    client.useServer(farm.addServer(server(0.1)));
    farm.run(1000);
    expectSound(farm);
    EXPECT_LT(farm.seconds(), 60);
    EXPECT_NEAR(double(farm.servers()[0]->iterations()), 500, 60);
}

TEST(FarmScenarios, ServersComeAndGo) {
    SimulatedFarm farm(3);
    SimulatedClient& client = farm.addClient(tinyJob(3000));
    client.useServer(farm.addServer(server(0.2)));
    farm.pass(20);
    for (int i = 0; i < 7; ++i) client.useServer(farm.addServer(server(0.2)));
    farm.pass(20);
    const uint64_t ofEight = committed(client);
    EXPECT_GT(ofEight, 500u);
    for (size_t i = 0; i < farm.servers().size(); ++i) farm.servers()[i]->kill(i % 2 == 0);
    farm.pass(60);
    const uint64_t ofNone = committed(client);
    EXPECT_LT(ofNone, ofEight + 50);
    EXPECT_FALSE(client.complete());
    farm.pass(60);
    EXPECT_EQ(committed(client), ofNone);
    for (size_t i = 0; i < 3; ++i) farm.servers()[i]->start();
    farm.run(400);
    expectSound(farm);
}

TEST(FarmScenarios, LostBlocksAreRenderedAgainAndNothingElse) {
    SimulatedFarm farm(4);
    ClientModel job = tinyJob(1000);
    SimulatedClient& client = farm.addClient(job);
    for (int i = 0; i < 4; ++i) client.useServer(farm.addServer(server(0.1)));
    farm.pass(10);
    farm.servers()[0]->kill(true);
    farm.run(200);
    expectSound(farm);
    // Two leases of four seconds were lost; towards the end blocks are rendered twice where servers would idle.
    EXPECT_LT(rendered(farm), 1000u + 3 * 80);
}

TEST(FarmScenarios, AResultSurvivesItsConnection) {
    SimulatedFarm farm(5);
    ClientModel job = tinyJob(64);
    job.options.targetSeconds = 100;
    SimulatedClient& client = farm.addClient(job);
    client.useServer(farm.addServer(server(0.5)));
    for (int i = 0; i < 8; ++i) {
        farm.pass(5);
        for (Link* link : farm.openLinks()) link->cut(0.01, 0.01);
    }
    farm.run(200);
    expectSound(farm);
    // Of blocks in hand nothing is lost; some of those that waited are granted and begun twice.
    EXPECT_LT(rendered(farm), 64u + 32);
}

TEST(FarmScenarios, AHungDeviceLosesItsBlocksThoughItsServerIsAlive) {
    SimulatedFarm farm(6);
    SimulatedClient& client = farm.addClient(tinyJob(600));
    for (int i = 0; i < 3; ++i) client.useServer(farm.addServer(server(0.1)));
    farm.pass(5);
    farm.servers()[1]->hang(1e6);
    farm.run(200);
    expectSound(farm);
    EXPECT_TRUE(client.said("Node server2 makes no progress"));
    EXPECT_LT(farm.seconds(), 60);
}

TEST(FarmScenarios, APausedServerIsGivenUpAndWelcomeAgain) {
    SimulatedFarm farm(7);
    SimulatedClient& client = farm.addClient(tinyJob(1500));
    for (int i = 0; i < 2; ++i) client.useServer(farm.addServer(server(0.1)));
    farm.pass(5);
    farm.servers()[0]->pause();
    farm.pass(40);
    const uint64_t before = farm.servers()[0]->iterations();
    farm.servers()[0]->resume();
    farm.run(200);
    expectSound(farm);
    EXPECT_GT(farm.servers()[0]->iterations(), before + 100);
}

TEST(FarmScenarios, ALyingServerIsFoundOut) {
    SimulatedFarm farm(8);
    ClientModel job = tinyJob(400);
    job.options.verifyFraction = 0.2;
    SimulatedClient& client = farm.addClient(job);
    ServerModel liar = server(0.1);
    liar.device.lies = true;
    client.useServer(farm.addServer(liar));
    for (int i = 0; i < 2; ++i) client.useServer(farm.addServer(server(0.1)));
    farm.run(1000);
    expectSound(farm);
    EXPECT_TRUE(client.said("Node server1 is not used any more"));
    EXPECT_EQ(client.coordinator().nodes().at(0).state, NodeStatus::State::Quarantined);
}

TEST(FarmScenarios, WithoutVerificationALyingServerIsNotFoundOut) {
    SimulatedFarm farm(9);
    SimulatedClient& client = farm.addClient(tinyJob(400));
    ServerModel liar = server(0.1);
    liar.device.lies = true;
    client.useServer(farm.addServer(liar));
    farm.run(1000);
    EXPECT_TRUE(client.complete());
    EXPECT_TRUE(client.wrongResult());
}

// A client that is killed comes back as another run of the job: what servers still hold of the first is not for it.
TEST(FarmScenarios, ResultsOfAnEarlierRunAreFencedOff) {
    SimulatedFarm farm(10);
    ClientModel job = tinyJob(400);
    job.checkpointSeconds = 3;
    SimulatedClient& client = farm.addClient(job);
    for (int i = 0; i < 2; ++i) client.useServer(farm.addServer(server(0.2)));
    for (int run = 0; run < 5; ++run) {
        farm.pass(7.3);
        std::vector<std::string> offers;
        for (Link* link : farm.openLinks()) offers.push_back(link->server().lastOffer());
        client.kill(run % 2 == 0);
        farm.pass(1);
        client.start();
        farm.pass(3);
        const auto links = farm.openLinks();
        for (size_t i = 0; i < std::min(links.size(), offers.size()); ++i) {
            links[i]->tainted = true;
            links[i]->server().inject(offers[i]);
        }
    }
    farm.run(400);
    expectSound(farm);
}

TEST(FarmScenarios, ACheckpointSavesTheWork) {
    SimulatedFarm farm(11);
    ClientModel job = tinyJob(400);
    job.checkpointSeconds = 3;
    SimulatedClient& client = farm.addClient(job);
    client.useServer(farm.addServer(server(0.1)));
    farm.pass(30);
    const uint64_t before = committed(client);
    client.kill(true);
    farm.pass(1);
    client.start();
    EXPECT_GT(committed(client) + 100, before);
    farm.run(400);
    expectSound(farm);
}

TEST(FarmScenarios, TwoClientsShareAServer) {
    SimulatedFarm farm(12);
    SimulatedServer& only = farm.addServer(server(0.1));
    for (int i = 0; i < 2; ++i) farm.addClient(tinyJob(300)).useServer(only);
    farm.pass(30);
    const double a = double(committed(*farm.clients()[0])), b = double(committed(*farm.clients()[1]));
    EXPECT_NEAR(a / (a + b), 0.5, 0.2);
    farm.run(200);
    expectSound(farm);
}

TEST(FarmScenarios, ADrainingServerDeliversAndLeaves) {
    SimulatedFarm farm(13);
    SimulatedClient& client = farm.addClient(tinyJob(400));
    for (int i = 0; i < 2; ++i) client.useServer(farm.addServer(server(0.1)));
    farm.pass(10);
    farm.servers()[0]->drain();
    farm.pass(2);
    farm.pass(3);
    EXPECT_FALSE(farm.servers()[0]->running());
    farm.run(200);
    expectSound(farm);
    // What was in hand was cut short and fetched: nothing is rendered twice but at the end.
    EXPECT_LT(rendered(farm), 400u + 60);
}

TEST(FarmScenarios, ScenesTravelToServersThatLackThem) {
    SimulatedFarm farm(14);
    farm.quality.bytesPerSecond = 200;
    SimulatedClient& client = farm.addClient(tinyJob(50));
    client.useServer(farm.addServer(server(0.1), true));
    for (int i = 0; i < 4; ++i) {
        farm.pass(1.7);
        for (Link* link : farm.openLinks()) link->cut(0.01, 0.01);
    }
    farm.run(200);
    expectSound(farm);
}

// Large films over a network that is slower than the servers: results wait at the servers, in bounded memory.
TEST(FarmScenarios, ASlowClientDoesNotFillItsServers) {
    SimulatedFarm farm(15);
    farm.quality.bytesPerSecond = 100e3;
    ClientModel job = tinyJob(64);
    job.settings.width = 600;
    job.settings.height = 400;
    job.budgetBytes = 600 * 400 * 24;
    SimulatedClient& client = farm.addClient(job);
    for (int i = 0; i < 3; ++i) client.useServer(farm.addServer(server(0.01)));
    farm.pass(3);
    client.pause();
    farm.pass(5);
    client.resume();
    farm.run(2000);
    expectSound(farm);
    EXPECT_LT(farm.largestServerQueue(), 3u << 20);
}

/// Whoever commits first had once decided the scale, and sums without bounds had once left no room for others.
TEST(FarmScenarios, AWrongFirstResultPoisonsNothing) {
    for (const bool bombs : {false, true}) {
        SimulatedFarm farm(20);
        SimulatedClient& client = farm.addClient(tinyJob(300));
        ServerModel wrong = server(0.01);
        wrong.device.bombs = bombs;
        wrong.device.otherScale = !bombs;
        client.useServer(farm.addServer(wrong));
        farm.pass(3);
        ServerModel late = server(0.1);
        late.startSeconds = 2;
        client.useServer(farm.addServer(late));
        farm.run(200);
        expectSound(farm);
        EXPECT_TRUE(client.said("Node server1 is not used any more"));
        EXPECT_LE(farm.servers()[0]->iterations(), 8u) << "its refused blocks were asked for again and again";
    }
}

// What a modem carried: 39 seconds of upload, and as long for each result.
TEST(FarmScenarios, ASlowLineWorksSlowly) {
    SimulatedFarm farm(17);
    farm.quality = lineOf(64, 1.0);
    farm.scene = sceneOf(300 << 10);
    ClientModel job = tinyJob(24);
    job.settings.width = 160;
    job.settings.height = 120;
    job.noise = true;
    job.budgetBytes = 160 * 120 * 24;
    SimulatedClient& client = farm.addClient(job);
    ServerModel far = server(1.0);
    far.device.noise = true;
    client.useServer(farm.addServer(far, true));
    farm.run(3600);
    expectSound(farm);
    EXPECT_EQ(farm.linksMade(), 1u) << "the connection was given up";
    EXPECT_EQ(rendered(farm), 24u) << "what was rendered was rendered again";
    EXPECT_LT(farm.seconds(), 900);
}

TEST(FarmScenarios, EightServersShareOneSlowLine) {
    SimulatedFarm farm(18);
    farm.quality = lineOf(1e6, 0.02);
    farm.quality.line = std::make_shared<Line>(Line{4e6 / 8});
    farm.scene = sceneOf(2 << 20);
    SimulatedClient& client = farm.addClient(tinyJob(400));
    for (int i = 0; i < 8; ++i) client.useServer(farm.addServer(server(0.1), true));
    farm.run(300);
    expectSound(farm);
    EXPECT_EQ(farm.linksMade(), 8u) << "connections were given up";
    for (const auto& each : farm.servers()) EXPECT_GT(each->iterations(), 0u) << each->name() << " was shut out";
    EXPECT_LT(farm.seconds(), 60);
}

TEST(FarmScenarios, ThreeSecondsOfLatencyLetAServerIn) {
    SimulatedFarm farm(19);
    farm.quality = lineOf(1000, 3.0);
    SimulatedClient& client = farm.addClient(tinyJob(100));
    client.useServer(farm.addServer(server(0.1), true));
    farm.run(1200);
    expectSound(farm);
    EXPECT_EQ(farm.linksMade(), 1u);
}

}  // namespace antipode::simulation
