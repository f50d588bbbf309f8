// The nodes of a farm as lines of text.
#pragma once

#include <string>
#include <vector>

#include "client/nodes/farm.h"

namespace antipode {

/// What was received since the table before, for the MB/s column.
struct NodeRates {
    std::vector<NodeReport> before;
    double beforeSeconds = 0;
};

/// A header and a line for each node, at most `columns` wide. `rates` is brought up to date.
std::vector<std::string> nodeTable(const std::vector<NodeReport>& nodes, NodeRates& rates, double nowSeconds,
                                   size_t columns);

}  // namespace antipode
