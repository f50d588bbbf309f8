// Faults drawn from a seed: what can happen to the processes of a farm and to the network between them.
#pragma once

#include "tests/farm/simulation/simulated_farm.h"

namespace antipode::simulation {

/// A farm with its jobs and its faults, all of it a function of the seed.
class FaultSchedule {
public:
    explicit FaultSchedule(uint64_t seed);

    SimulatedFarm& farm() { return farm_; }
    /// Runs the jobs to their end. Faults are over after some time, but for liars and slow servers; the bound on the
    /// virtual time includes all of it.
    void run();
    /// All that went wrong.
    std::vector<std::string> failures() const;

private:
    void drawFarm();
    std::vector<SimulatedServer*> drawRelays();
    void scheduleNext();
    void strike();
    void strikeLink();
    void strikeServer();
    void strikeClient();
    void heal();

    double someTime();  ///< tenths of seconds to half a minute
    bool chance(double probability) { return farm_.random().uniform() < probability; }

    SimulatedFarm farm_;
    double faultEnd_ = 0, meanPause_ = 0;
    double slowest_ = 0;       ///< seconds per iteration of the slowest server
    uint64_t iterations_ = 0;  ///< of all jobs
    bool healed_ = false, liar_ = false;
    std::string staleOffer_;
};

}  // namespace antipode::simulation
