// What a coordinator and a node know of each other.
#pragma once

#include <cstdint>
#include <string>

#include "renderengine/iteration_range.h"

namespace antipode {

using NodeId = uint32_t;
using LeaseId = uint64_t;

struct Lease {
    LeaseId id = 0;
    IterationRange range;  ///< dyadic, unless it is the second rendering of a block that had been truncated
};

/// What a coordinator asks of a node.
class NodePort {
public:
    virtual ~NodePort() = default;
    virtual void grant(const Lease& lease) = 0;
    /// The block's result is no longer needed in full: what is done of it is to be delivered.
    virtual void truncate(LeaseId lease) = 0;
};

struct NodeDescription {
    std::string name;  ///< HOST:PORT, or "local"
    std::string deviceName;
    std::string deviceClass;  ///< nodes of one class render the same bytes
    uint32_t leaseDepth = 1;  ///< blocks that the node holds at once
    uint32_t width = 1;       ///< iterations that it renders side by side; 0: it can render none for now
};

}  // namespace antipode
