// Expects a ProtocolError by words of its message.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "proto/wire/frame.h"

namespace antipode::wire::testing {

template <class Action>
void expectProtocolError(const std::string& words, Action&& action) {
    try {
        action();
        ADD_FAILURE() << "expected a protocol error that says '" << words << "'";
    } catch (const ProtocolError& error) {
        EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
}

}  // namespace antipode::wire::testing
