// What every program of the project does around its work.
#pragma once

#include <functional>
#include <string>

namespace antipode {

/// Runs `work` and tells on stderr, after the program's name, what it throws. Returns the exit code: 0 done, 1 an
/// input, output or device failed, 2 the command line is wrong.
int runProgram(const std::string& name, const std::function<void()>& work);

}  // namespace antipode
