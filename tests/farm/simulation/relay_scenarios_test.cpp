// What relays promise, each promise in a farm of its own. Virtual seconds; nothing here is measured on a clock.
#include <gtest/gtest.h>

#include "tests/farm/simulation/simulated_farm.h"

namespace antipode::simulation {
namespace {

constexpr double iterationSeconds = 0.1;

ServerModel server(double secondsPerIteration = iterationSeconds) {
    ServerModel model;
    model.device.secondsPerIteration = secondsPerIteration;
    return model;
}

std::vector<SimulatedServer*> addServers(SimulatedFarm& farm, size_t count) {
    std::vector<SimulatedServer*> servers;
    while (servers.size() < count) servers.push_back(&farm.addServer(server()));
    return servers;
}

SimulatedServer& addRelay(SimulatedFarm& farm, const std::vector<SimulatedServer*>& servers, double verify = 0) {
    ServerModel model;
    model.relayed = servers;
    model.relayedVerifyFraction = verify;
    model.limits.leaseDepth = 4;
    return farm.addServer(model);
}

void expectSound(const SimulatedFarm& farm) {
    for (const std::string& failure : farm.failures()) ADD_FAILURE() << failure;
    for (const auto& client : farm.clients())
        if (const auto wrong = client->wrongResult()) ADD_FAILURE() << *wrong;
}

uint64_t committed(const SimulatedClient& client) { return client.coordinator().committed().count(); }

uint64_t rendered(SimulatedFarm& farm) {
    uint64_t iterations = 0;
    for (const auto& each : farm.servers()) iterations += each->iterations();
    return iterations;
}

/// Lets the farm run until so much of the client's job is done.
void runUntil(SimulatedFarm& farm, const SimulatedClient& client, uint64_t iterations) {
    while (committed(client) < iterations && farm.seconds() < 1000) farm.pass(0.1);
}

struct Outcome {
    double seconds;
    uint64_t rendered, results;
};

/// Directly, or through two relays of four servers each.
Outcome renderOn8Servers(uint64_t iterations, bool throughRelays) {
    SimulatedFarm farm(1);
    SimulatedClient& client = farm.addClient(tinyJob(iterations));
    for (int i = 0; i < 2; ++i) {
        const auto servers = addServers(farm, 4);
        if (throughRelays)
            client.useServer(addRelay(farm, servers));
        else
            for (SimulatedServer* each : servers) client.useServer(*each);
    }
    farm.run(10000);
    expectSound(farm);
    uint64_t results = 0;
    for (const NodeStatus& node : client.coordinator().nodes()) results += node.results;
    return {farm.seconds(), rendered(farm), results};
}

}  // namespace

TEST(FarmRelays, RenderTheSameImageInNearlyTheSameTime) {
    constexpr uint64_t iterations = 8000;
    const Outcome direct = renderOn8Servers(iterations, false), relayed = renderOn8Servers(iterations, true);
    RecordProperty("ratio", std::to_string(relayed.seconds / direct.seconds));
    EXPECT_LT(relayed.seconds, 1.1 * direct.seconds) << direct.seconds;
    EXPECT_LE(relayed.rendered, iterations + 100) << "work was done in vain";
    EXPECT_LT(relayed.results, direct.results / 2) << direct.results;
}

TEST(FarmRelays, AServerThatIsKilledInMidBlockCostsItsRelayNoBlock) {
    SimulatedFarm farm(2);
    SimulatedClient& client = farm.addClient(tinyJob(3000));
    const auto servers = addServers(farm, 4);
    client.useServer(addRelay(farm, servers));
    runUntil(farm, client, 500);
    servers[0]->kill(true), servers[1]->kill(false);
    farm.pass(20);
    servers[0]->start(), servers[1]->start();
    farm.run(1000);
    expectSound(farm);
    for (const NodeStatus& node : client.coordinator().nodes()) EXPECT_EQ(node.lost, 0u) << "a block was lost";
    EXPECT_GT(servers[0]->iterations(), 400u) << "it was not used again";
}

TEST(FarmRelays, WhenARelayDiesItsWorkGoesElsewhere) {
    SimulatedFarm farm(3);
    SimulatedClient& client = farm.addClient(tinyJob(3000));
    SimulatedServer& dies = addRelay(farm, addServers(farm, 3));
    client.useServer(dies);
    client.useServer(addRelay(farm, addServers(farm, 3)));
    runUntil(farm, client, 500);
    dies.kill(true);
    farm.run(1000);
    expectSound(farm);
}

TEST(FarmRelays, OneThatComesBackIsUsedAgain) {
    SimulatedFarm farm(4);
    SimulatedClient& client = farm.addClient(tinyJob(2000));
    SimulatedServer& relay = addRelay(farm, addServers(farm, 3));
    client.useServer(relay);
    runUntil(farm, client, 300);
    relay.kill(false);
    farm.pass(5);
    relay.start();
    farm.run(1000);
    expectSound(farm);
}

TEST(FarmRelays, ADrainedRelayLosesNothing) {
    SimulatedFarm farm(5);
    SimulatedClient& client = farm.addClient(tinyJob(3000));
    SimulatedServer &leaves = addRelay(farm, addServers(farm, 3)), &stays = addRelay(farm, addServers(farm, 3));
    client.useServer(leaves), client.useServer(stays);
    runUntil(farm, client, 1000);
    leaves.drain();
    farm.run(1000);
    expectSound(farm);
    EXPECT_FALSE(leaves.running());
    EXPECT_LE(rendered(farm), 3100u) << "what was rendered was thrown away";
}

TEST(FarmRelays, ARelayWithoutServersGivesItsBlocksBackAndAsksForNone) {
    SimulatedFarm farm(6);
    SimulatedClient& client = farm.addClient(tinyJob(6000));
    const auto servers = addServers(farm, 3);
    client.useServer(addRelay(farm, servers));
    client.useServer(addRelay(farm, addServers(farm, 3)));
    runUntil(farm, client, 1000);
    for (SimulatedServer* each : servers) each->kill(true);
    farm.pass(30);
    EXPECT_EQ(client.coordinator().nodes().front().leases, 0u);
    const uint64_t before = servers[0]->iterations();
    for (SimulatedServer* each : servers) each->start();
    farm.run(1000);
    expectSound(farm);
    EXPECT_GT(servers[0]->iterations(), before + 100);
}

TEST(FarmRelays, OneWhoseServersComeLateWaitsForThem) {
    SimulatedFarm farm(7);
    SimulatedClient& client = farm.addClient(tinyJob(200));
    ServerModel late = server();
    late.startSeconds = 40;
    client.useServer(addRelay(farm, {&farm.addServer(late)}));
    farm.run(1000);
    expectSound(farm);
}

TEST(FarmRelays, ALiarIsFoundByItsRelayBeforeItsSumsLeaveIt) {
    SimulatedFarm farm(8);
    SimulatedClient& client = farm.addClient(tinyJob(600));
    ServerModel lies = server();
    lies.device.lies = true;
    auto servers = addServers(farm, 3);
    servers.insert(servers.begin(), &farm.addServer(lies));
    client.useServer(addRelay(farm, servers, 1));
    farm.run(1000);
    expectSound(farm);
}

TEST(FarmRelays, ARelayWithALiarIsFoundByTheClient) {
    SimulatedFarm farm(9);
    ClientModel job = tinyJob(1500);
    job.options.verifyFraction = 1;
    SimulatedClient& client = farm.addClient(job);
    ServerModel lies = server();
    lies.device.lies = true;
    client.useServer(addRelay(farm, {&farm.addServer(lies), &farm.addServer(server())}));
    for (int i = 0; i < 2; ++i) client.useServer(addRelay(farm, addServers(farm, 2)));
    farm.run(2000);
    expectSound(farm);
    EXPECT_EQ(client.coordinator().nodes().front().state, NodeStatus::State::Quarantined);
}

TEST(FarmRelays, ServersOfAnotherClassAreLeftOut) {
    SimulatedFarm farm(10);
    SimulatedClient& client = farm.addClient(tinyJob(500));
    ServerModel other = server();
    other.deviceClass = "other";
    other.startSeconds = 3;
    SimulatedServer& misfit = farm.addServer(other);
    auto servers = addServers(farm, 2);
    servers.push_back(&misfit);
    client.useServer(addRelay(farm, servers));
    farm.run(1000);
    expectSound(farm);
    EXPECT_EQ(misfit.iterations(), 0u);
    EXPECT_EQ(client.coordinator().nodes().front().description.deviceClass, "fake");
}

TEST(FarmRelays, TwoClientsShareARelay) {
    SimulatedFarm farm(11);
    SimulatedServer& relay = addRelay(farm, addServers(farm, 4));
    for (const uint64_t iterations : {1000, 1500}) farm.addClient(tinyJob(iterations)).useServer(relay);
    farm.run(1000);
    expectSound(farm);
}

// Ten connections at the client, ten at each of ten relays, ten at each of a hundred more.
TEST(FarmRelays, AThousandServersNeedTenConnections) {
    SimulatedFarm farm(12);
    farm.quality.latency = 0.001;
    constexpr uint64_t iterations = 20000;
    SimulatedClient& client = farm.addClient(tinyJob(iterations));
    std::vector<SimulatedServer*> top;
    for (int i = 0; i < 10; ++i) {
        std::vector<SimulatedServer*> middle;
        for (int j = 0; j < 10; ++j) {
            std::vector<SimulatedServer*> servers;
            for (int k = 0; k < 10; ++k) servers.push_back(&farm.addServer(server(0.5)));
            middle.push_back(&addRelay(farm, servers));
        }
        top.push_back(&addRelay(farm, middle));
    }
    for (SimulatedServer* each : top) client.useServer(*each);
    farm.run(10000);
    expectSound(farm);
    EXPECT_EQ(client.coordinator().nodes().size(), 10u);
    uint64_t results = 0;
    for (const NodeStatus& node : client.coordinator().nodes()) results += node.results;
    RecordProperty("seconds", std::to_string(farm.seconds()));
    RecordProperty("results", std::to_string(results));
    EXPECT_LT(farm.seconds(), 30) << "ideal are 10 s";
}

}  // namespace antipode::simulation
