// How what takes long before the first iteration tells where it is, and is ended.
#pragma once

#include <functional>

namespace antipode {

/// Called on the engine's own thread before each part of its set-up, with what comes next ("compiling kernels"). What
/// it throws ends the set-up.
using SetUpStep = std::function<void(const char* next)>;

}  // namespace antipode
