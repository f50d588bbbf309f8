// The nodes of a farm as lines of text.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "farm/nodes/farm.h"

namespace antipode {

/// Traffic over the last few seconds, for the MB/s column.
struct NodeRates {
    struct Traffic {
        uint64_t bytes = 0;         ///< when last looked at
        double bytesPerSecond = 0;  ///< smoothed: results come in bursts
    };
    std::map<std::string, Traffic> nodes;
    double lastSeconds = 0;
};

/// A header and a line for each node, at most `columns` wide. `rates` is brought up to date.
std::vector<std::string> nodeTable(const std::vector<NodeReport>& nodes, NodeRates& rates, double nowSeconds,
                                   size_t columns);

}  // namespace antipode
