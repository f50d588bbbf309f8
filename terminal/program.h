// What every program of the project does around its work.
#pragma once

#include <functional>
#include <string>

namespace antipode {

/// Prints on stderr, after the program's name.
void complain(const std::string& name, const std::string& message);

/// Runs `work`, tells what it throws, and returns the exit code.
int runProgram(const std::function<void()>& work, const std::function<void(const std::string& message)>& tell);
int runProgram(const std::string& name, const std::function<void()>& work);

}  // namespace antipode
