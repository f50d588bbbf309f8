// Runs the built `antipode` as a user would.
#pragma once

#include <string>

namespace antipode::test {

struct ClientRun {
    int exitCode = 0;    ///< −1 where a signal ended it
    std::string output;  ///< standard output
    std::string errors;  ///< standard error
};

/// Runs `antipode ARGUMENTS` through the shell, in the folder. The arguments are shell text: quote what needs it.
/// `environment` is put before the command ("NAME=value").
ClientRun runClient(const std::string& folder, const std::string& arguments, const std::string& environment = "");

}  // namespace antipode::test
