// Expects an Error by its code and by words of its message.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "renderengine/error.h"

namespace antipode::test {

/// Expects that `action` throws Error of this code whose message contains `words`.
template <class Action>
void expectError(ErrorCode code, const std::string& words, Action&& action) {
    try {
        action();
        ADD_FAILURE() << "expected an error that says '" << words << "'";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), code) << error.what();
        EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
}

}  // namespace antipode::test
