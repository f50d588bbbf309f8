// Rows of tests/HARD_CASES.md, written by the tests that check them (deploy/hard-cases.sh makes the page).
#pragma once

#include <string>

#include "renderengine/settings.h"

namespace antipode {

/// What a hard case measures, and how much of it is allowed.
struct HardCase {
    std::string group;       ///< "Near-singular geometry": one of those that tests/hard_cases.py lists
    std::string difficulty;  ///< what is hard about it, a phrase
    std::string quantity;    ///< what is measured, with its unit where it has one: "largest |t| of 9 tests"
    double bound = 0;        ///< greatest value that passes; 0 where anything at all is wrong ("differing bytes")
};

/// Expects measured ≤ bound (a NaN fails), and appends the row to the file that the environment variable
/// ANTIPODE_HARD_CASES names, where it is set. The case is named after the running test. `device` is what the kernels
/// ran on, "host" where none did.
void expectWithin(const HardCase& hardCase, double measured, const std::string& device = "host",
                  Precision precision = Precision::Float);

}  // namespace antipode
