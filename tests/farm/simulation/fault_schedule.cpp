#include "tests/farm/simulation/fault_schedule.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace antipode::simulation {
namespace {

/// After the last fault: reconnects wait 30 s at most, silence takes 10 s, patience with a node 120 s, and with each
/// doubling of the number of blocks that are left some of it again.
constexpr double recoverySeconds = 3600;
/// What the job would take if its slowest server rendered all of it, once and as cross-checks and in vain.
constexpr double renderings = 4;

}  // namespace

FaultSchedule::FaultSchedule(uint64_t seed) : farm_(seed, false) { drawFarm(); }

double FaultSchedule::someTime() { return 0.1 * std::exp(farm_.random().uniform() * std::log(300)); }

void FaultSchedule::drawFarm() {
    Random& random = farm_.random();
    faultEnd_ = random.uniform(5, 120);
    meanPause_ = random.uniform(0.5, 15);
    farm_.quality.latency = std::exp(random.uniform(std::log(1e-4), std::log(0.3)));
    farm_.quality.bytesPerSecond = std::exp(random.uniform(std::log(3e3), std::log(1e8)));

    const uint32_t servers = 1 + random.index(5);
    const bool classes = chance(0.2), cold = chance(0.1);
    // To find out who lies takes two honest servers of the class and all blocks checked.
    liar_ = servers >= 3 && !classes && chance(0.3);
    const bool verifiable = servers >= 2 && !classes;
    double rate = 0;  // of all servers together, iterations per second
    for (uint32_t i = 0; i < servers; ++i) {
        ServerModel model;
        model.device.secondsPerIteration = std::exp(random.uniform(std::log(0.01), std::log(0.8)));
        if (chance(0.1)) model.device.secondsPerIteration *= 50;
        slowest_ = std::max(slowest_, model.device.secondsPerIteration);
        rate += 1 / model.device.secondsPerIteration;
        model.device.buildSeconds = random.uniform(0, 3);
        model.startSeconds = random.uniform(0, 5);
        model.loadSeconds = random.uniform(0, 3);
        model.device.lies = liar_ && i == 0;
        model.limits.leaseDepth = 1 + random.index(3);
        model.limits.orphanSeconds = chance(0.5) ? 120 : 2;
        if (classes && i % 2) model.deviceClass = "other";
        farm_.addServer(model, cold);
    }
    for (uint32_t clients = chance(0.2) ? 2 : 1; clients > 0; --clients) {
        // Most jobs last about as long as the faults do.
        ClientModel model = tinyJob(1 + uint64_t(std::min(600.0, random.uniform(0, 1.5) * faultEnd_ * rate)));
        iterations_ += *model.options.iterations;
        model.options.targetSeconds = std::exp(random.uniform(std::log(0.1), std::log(10)));
        model.options.verifyFraction = liar_ ? 1 : verifiable && chance(0.2) ? random.uniform() : 0;
        // All come back in the end, however late.
        model.options.verifyPatienceSeconds = std::numeric_limits<double>::infinity();
        model.options.verifySeed = random.index(1000);
        model.budgetBytes = (1 + random.index(3)) * 24 * 6;
        model.checkpointSeconds = random.uniform(0.5, 10);
        if (chance(0.3)) {
            model.device.emplace();
            model.device->secondsPerIteration = std::exp(random.uniform(std::log(0.1), std::log(3)));
        }
        farm_.addClient(model);
    }
    const std::vector<SimulatedServer*> offered =
        servers >= 2 && !liar_ && !classes && chance(0.4) ? drawRelays() : std::vector<SimulatedServer*>();
    for (const auto& client : farm_.clients()) {
        for (SimulatedServer* each : offered) client->useServer(*each);
        if (!offered.empty()) continue;
        for (const auto& server : farm_.servers()) client->useServer(*server);
    }
    scheduleNext();
}

/// Puts some servers behind relays, one perhaps behind another one; returns what clients see. At least two nodes, so
/// that what they check can be checked.
std::vector<SimulatedServer*> FaultSchedule::drawRelays() {
    Random& random = farm_.random();
    std::vector<std::vector<SimulatedServer*>> groups(2 + random.index(2));
    for (const auto& server : farm_.servers()) groups[random.index(uint32_t(groups.size()))].push_back(server.get());
    std::vector<SimulatedServer*> offered;
    for (const auto& group : groups) {
        if (group.empty()) continue;
        ServerModel model;
        model.relayed = group;
        model.startSeconds = random.uniform(0, 5);
        model.limits.leaseDepth = 1 + random.index(4);
        model.limits.orphanSeconds = chance(0.5) ? 120 : 2;
        if (group.size() >= 2 && chance(0.3)) model.relayedVerifyFraction = random.uniform();
        offered.push_back(&farm_.addServer(model));
        if (!chance(0.2)) continue;
        model.relayed = {offered.back()};
        model.relayedVerifyFraction = 0;
        offered.back() = &farm_.addServer(model);
    }
    if (offered.size() == 1) offered.push_back(&farm_.addServer({}));
    return offered;
}

void FaultSchedule::run() {
    farm_.loop().at(farm_.loop().now() + faultEnd_, [this] { heal(); });
    const double longest = faultEnd_ + recoverySeconds + renderings * slowest_ * double(iterations_);
    // A client that was complete may be killed and have to go on, as long as there are faults.
    while (farm_.seconds() < longest && !(farm_.complete() && healed_)) {
        farm_.run(longest - farm_.seconds());
        if (!healed_) farm_.pass(faultEnd_ - farm_.seconds() + 1e-3);
    }
}

std::vector<std::string> FaultSchedule::failures() const {
    std::vector<std::string> all = farm_.failures();
    for (const auto& client : farm_.clients()) {
        if (const auto wrong = client->wrongResult()) all.push_back(*wrong);
    }
    return all;
}

void FaultSchedule::scheduleNext() {
    farm_.loop().after(-meanPause_ * std::log(1 - farm_.random().uniform()), [this] {
        if (healed_) return;
        strike();
        scheduleNext();
    });
}

void FaultSchedule::strike() {
    const double which = farm_.random().uniform();
    if (which < 0.5)
        strikeLink();
    else if (which < 0.9)
        strikeServer();
    else
        strikeClient();
}

void FaultSchedule::strikeLink() {
    Random& random = farm_.random();
    const auto links = farm_.openLinks();
    if (links.empty()) return;
    Link& link = *links[random.index(uint32_t(links.size()))];
    LinkEnd& sender = chance(0.5) ? link.client() : link.server();
    const uint32_t kind = random.index(6);
    farm_.loop().log("fault " + std::to_string(kind) + " on " + link.name());
    switch (kind) {
        case 0: return link.cut(0.01, 0.01);
        case 1: return link.cut(someTime(), someTime());
        case 2: return chance(0.5) ? link.cut(never, 0.01) : link.cut(0.01, never);
        case 3: return sender.hold(chance(0.3) ? never : farm_.loop().now() + someTime());
        case 4: link.tainted = true; return sender.corruptNext();
        case 5:
            // An offer that the server made then, perhaps to another client or in another life of this one.
            if (!staleOffer_.empty()) {
                link.tainted = true;
                link.server().inject(staleOffer_);
            }
            staleOffer_ = link.server().lastOffer();
            return;
    }
}

void FaultSchedule::strikeServer() {
    Random& random = farm_.random();
    SimulatedServer& server = *farm_.servers()[random.index(uint32_t(farm_.servers().size()))];
    const uint32_t kind = random.index(6);
    farm_.loop().log("fault " + std::to_string(kind) + " of " + server.name());
    const double after = someTime();
    switch (kind) {
        case 0:
        case 1: server.kill(kind == 0); return farm_.loop().after(after, [&server] { server.start(); });
        case 2: server.pause(); return farm_.loop().after(after, [&server] { server.resume(); });
        case 3: return server.hang(chance(0.3) ? 300 : after);
        case 4: return server.failDevice();
        case 5: server.drain(); return farm_.loop().after(30 + after, [&server] { server.start(); });
    }
}

void FaultSchedule::strikeClient() {
    Random& random = farm_.random();
    SimulatedClient& client = *farm_.clients()[random.index(uint32_t(farm_.clients().size()))];
    // What a checkpoint holds is not doubted again, so a restart would keep what a liar has in it.
    const uint32_t kind = liar_ ? 2 : random.index(3);
    farm_.loop().log("fault " + std::to_string(kind) + " of " + client.name());
    if (kind == 2) {
        client.pause();
        return farm_.loop().after(someTime(), [&client] { client.resume(); });
    }
    client.kill(kind == 0);
    farm_.loop().after(someTime(), [&client] { client.start(); });
}

/// Whatever is down comes back; connections that hang are left to time out.
void FaultSchedule::heal() {
    healed_ = true;
    farm_.loop().log("no more faults");
    for (const auto& server : farm_.servers()) {
        server->resume();
        if (!server->listening()) server->kill(true);
        server->start();
    }
    for (const auto& client : farm_.clients()) {
        client->resume();
        client->start();
    }
}

}  // namespace antipode::simulation
