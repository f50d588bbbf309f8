// What all processes of a simulated farm have in common.
#pragma once

namespace antipode::simulation {

constexpr const char* kernelHashOfAll = "5555555555555555555555555555555555555555555555555555555555555555";

}  // namespace antipode::simulation
