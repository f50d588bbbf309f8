// How likely so few successes are: whether an interval holds as often as it says.
#pragma once

#include <cmath>

namespace antipode::test {

/// P(X ≤ hits) of n independent trials that succeed with probability p in (0, 1); exact. 0 for hits < 0.
inline double binomialBelow(int hits, int n, double p) {
    double sum = 0;
    for (int k = 0; k <= hits; ++k)
        sum += std::exp(std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1) + k * std::log(p) +
                        (n - k) * std::log1p(-p));
    return sum;
}

}  // namespace antipode::test
