// Time that benchmarks measure.
#pragma once

#include <vector>

namespace antipode::benchmark {

/// User and system seconds of all threads of this process so far.
double processCpuSeconds();
/// User and system seconds of all child processes that have ended and been waited for.
double childrenCpuSeconds();
/// Seconds on a clock that never goes back.
double wallSeconds();

/// Seconds of one piece of work.
struct Duration {
    double cpu = 0, wall = 0;
};

template <class Work>
Duration timed(const Work& work) {
    const double cpu = processCpuSeconds(), wall = wallSeconds();
    work();
    return {processCpuSeconds() - cpu, wallSeconds() - wall};
}

/// Repeated measurements of one thing; neither is defined without any.
class Samples {
public:
    void add(double value) { values_.push_back(value); }
    double lowest() const;
    double median() const;

private:
    std::vector<double> values_;
};

}  // namespace antipode::benchmark
