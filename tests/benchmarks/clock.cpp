#include "tests/benchmarks/clock.h"

#include <algorithm>
#include <chrono>

#include <sys/resource.h>

namespace antipode::benchmark {
namespace {

double cpuSeconds(int who) {
    rusage usage{};
    ::getrusage(who, &usage);
    const auto seconds = [](const timeval& time) { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace

double processCpuSeconds() { return cpuSeconds(RUSAGE_SELF); }
double childrenCpuSeconds() { return cpuSeconds(RUSAGE_CHILDREN); }

double wallSeconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double Samples::lowest() const { return *std::min_element(values_.begin(), values_.end()); }

double Samples::median() const {
    std::vector<double> sorted = values_;
    std::sort(sorted.begin(), sorted.end());
    const size_t middle = sorted.size() / 2;
    return sorted.size() % 2 ? sorted[middle] : 0.5 * (sorted[middle - 1] + sorted[middle]);
}

}  // namespace antipode::benchmark
