// The worst of several measurements.
#pragma once

#include <cmath>
#include <string>

namespace antipode {

struct Worst {
    double value = 0;   ///< the greatest, not below 0; NaN where one was
    std::string where;  ///< what was said of it

    void add(double measured, const std::string& said = {}) {
        if (!(measured > value || std::isnan(measured))) return;
        value = measured;
        where = said;
    }
};

}  // namespace antipode
