// The servers of a relay, by their addresses.
#pragma once

#include <asio/io_context.hpp>

#include "farm/nodes/server_list.h"
#include "server/relay/relay_worker.h"

namespace antipode {

/// Connects from the io_context's thread. What it makes throws as ServerList does.
MakeRelayChildren networkChildren(asio::io_context& io, ServerListOptions options);

}  // namespace antipode
