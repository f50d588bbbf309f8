// What `antipode-server` is asked for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "farm/nodes/server_list.h"
#include "proto/wire/stream.h"
#include "server/log.h"
#include "server/render_queue.h"

namespace antipode {

struct ServerOptions {
    wire::Endpoint listen{"127.0.0.1", "7010"};
    std::string device;       ///< selector, see selectDevice()
    std::string cacheFolder;  ///< resolved
    uint64_t cacheBytes = 16ull << 30;
    wire::SecurityOptions security;
    std::optional<std::string> metrics;  ///< HOST:PORT
    RenderQueueLimits limits;
    ServerListOptions relayed;         ///< the servers that render, where this one is a relay
    double relayedVerifyFraction = 0;  ///< of their blocks that a second one renders, too
    bool isRelay() const { return relayed.any(); }
    double drainSeconds = 30;  ///< from SIGTERM to the end, for clients to fetch what is rendered
    LogOptions log;
    std::string kernelHash;  ///< told to clients; this build's kernelHash()
};

/// Parses the command line and makes it consistent. Nothing where --help or --version was asked for.
/// Throws Error(Usage).
std::optional<ServerOptions> parseServerOptions(const std::vector<std::string>& arguments);

}  // namespace antipode
