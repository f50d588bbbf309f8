#include "server/doorkeeper.h"

#include <algorithm>

namespace antipode {
namespace {

constexpr size_t mostKnown = 4096;

}  // namespace

void Doorkeeper::Budget::refill(double now) {
    connections = std::min(burst, connections + perSecond * std::max(0.0, now - since));
    since = now;
}

bool Doorkeeper::admits(const std::string& address, double now) {
    auto known = budgets_.find(address);
    if (known == budgets_.end()) {
        if (budgets_.size() >= mostKnown && now - forgotAt_ >= 1) forgetTheQuiet(now);
        if (budgets_.size() < mostKnown) known = budgets_.emplace(address, Budget{burst, now}).first;
    }
    Budget& budget = known == budgets_.end() ? others_ : known->second;
    budget.refill(now);
    if (budget.connections < 1) return false;
    --budget.connections;
    return true;
}

void Doorkeeper::forgetTheQuiet(double now) {
    forgotAt_ = now;
    std::erase_if(budgets_, [now](const auto& entry) {
        Budget budget = entry.second;
        budget.refill(now);
        return budget.connections >= burst;
    });
}

size_t whoGoes(const std::vector<std::string>& addresses) {
    std::map<std::string, size_t> counts;
    for (const std::string& address : addresses) ++counts[address];
    size_t first = 0;
    for (size_t i = 1; i < addresses.size(); ++i)
        if (counts[addresses[i]] > counts[addresses[first]]) first = i;
    return first;
}

}  // namespace antipode
