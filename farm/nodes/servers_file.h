// The list of servers that changes while a render runs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "proto/wire/stream.h"

namespace antipode {

/// A text file with one HOST:PORT a line; empty lines and what follows a '#' do not count.
class ServersFile {
public:
    /// Reads the file. Throws Error(Input) where it cannot be read or a line is no address.
    explicit ServersFile(std::string path);

    const std::vector<wire::Endpoint>& servers() const { return servers_; }
    /// Reads it again. True where the list has changed. A file that cannot be read or has a line that is no address
    /// changes nothing and leaves a sentence in `problem`, the first time that it is so.
    bool reread(std::string& problem);

private:
    std::string path_, content_, lastProblem_;
    std::vector<wire::Endpoint> servers_;
};

}  // namespace antipode
