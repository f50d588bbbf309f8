// The device that the tests in this folder run on.
#pragma once

#include "vulkan/device.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace antipode {

/// Opens the best device under the validation layer with barrier checks, and fails the test on any of its messages.
class DeviceTest : public testing::Test {
protected:
    DeviceTest() {
        // The layer is part of these tests, so they fail, rather than pass unwatched, where it is missing.
        setenv("ANTIPODE_VALIDATION", "sync", 1);
        device = std::make_unique<Device>("");
    }

    void TearDown() override {
        for (const std::string& message : device->instance().validationMessages()) ADD_FAILURE() << message;
    }

    std::unique_ptr<Device> device;
};

}  // namespace antipode
