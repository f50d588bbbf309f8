// Who may knock at a server, and which stranger goes when there are too many.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace antipode {

/// Pure. An address may connect `burst` times at once and `perSecond` times a second in the long run: a farm's machines
/// come nowhere near, and a handshake costs milliseconds. What is remembered is bounded.
class Doorkeeper {
public:
    static constexpr double burst = 1024, perSecond = 64;

    /// Whether a connection from there is heard at all. `now`: monotonic seconds.
    bool admits(const std::string& address, double now);
    size_t known() const { return budgets_.size(); }

private:
    struct Budget {
        double connections = burst, since = 0;
        void refill(double now);
    };
    void forgetTheQuiet(double now);

    std::map<std::string, Budget> budgets_;  ///< of addresses that are not at their full burst
    double forgotAt_ = -1;                   ///< once a second: it takes a look at all of them
    Budget others_;                          ///< of all that do not fit in
};

/// Which of the strangers, whose addresses come in the order of their arrival, goes: the oldest of the address that has
/// the most. So one address shuts out itself and nobody else. There must be one.
size_t whoGoes(const std::vector<std::string>& addresses);

}  // namespace antipode
