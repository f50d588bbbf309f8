// The jobs that are compared with SmallVCM's.
#pragma once

#include "renderengine/engine.h"

namespace antipode::benchmark {

/// The engine for scenes/cornell/NAME.textproto as SmallVCM renders it: square, paths of at most ten edges.
Engine cornellEngine(const std::string& name, const std::string& technique, uint32_t side, const std::string& device,
                     Precision precision = Precision::Float);

}  // namespace antipode::benchmark
