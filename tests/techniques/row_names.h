// Names that rows of hard cases have in common.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "renderengine/devices.h"
#include "support/hard_case.h"

namespace antipode::test {

/// The device that engines run on where no selector is given.
inline std::string deviceName() { return selectDevice("").name; }

/// Names the parameters of tests that run in both precisions.
inline std::string precisionName(const testing::TestParamInfo<Precision>& precision) {
    return precision.param == Precision::Double ? "Double" : "Float";
}

}  // namespace antipode::test
