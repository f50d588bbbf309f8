// The servers that a job is rendered on: those that were named, and those of a file that changes while the job runs.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <asio/io_context.hpp>

#include "farm/nodes/remote_node.h"
#include "farm/nodes/servers_file.h"
#include "proto/wire/stream.h"

namespace antipode {

struct ServerListOptions {
    std::vector<wire::Endpoint> servers;
    std::string serversFile;  ///< more of them, read again while the job runs; "" for none
    wire::SecurityOptions security;
    bool any() const { return !servers.empty() || !serversFile.empty(); }
};

/// Keeps a node for each. All calls on the io_context's thread.
class ServerList {
public:
    /// Begins to connect. Coroutines keep `context`; they must be destroyed before the list. Throws Error(Usage) where
    /// a server may not be used without secret or certificate, Error(Input) for files that are unfit.
    ServerList(asio::io_context& io, ServerListOptions options, std::shared_ptr<RemoteContext> context);

    /// Reads the file again now and then: begins to use servers that are new in it, and leaves those that are in it no
    /// longer. Takes note of what servers say.
    void tick(double now);
    /// Tells all that the job is over.
    void stop();
    /// No connection is open or being made after stop().
    bool stopped() const;

    /// By name.
    std::vector<RemoteStatus> status() const;
    bool empty() const { return nodes_.empty(); }
    bool hasFile() const { return file_.has_value(); }
    /// What each server that has not got the job says: "HOST:PORT: Connection refused", joined by "; ".
    std::string complaints() const;
    /// What the user must know, each once. Returns and forgets.
    std::vector<std::string> takeMessages() { return std::exchange(messages_, {}); }

private:
    void update();
    void reread(double now);

    asio::io_context& io_;
    const ServerListOptions options_;
    const std::shared_ptr<const wire::Security> security_;
    const std::shared_ptr<RemoteContext> context_;
    std::optional<ServersFile> file_;
    double nextReread_ = 0;
    std::map<std::string, std::unique_ptr<RemoteNode>> nodes_;
    std::vector<std::unique_ptr<RemoteNode>> leaving_;
    std::map<std::string, std::string> told_;  ///< details, by name
    std::vector<std::string> messages_;
};

}  // namespace antipode
