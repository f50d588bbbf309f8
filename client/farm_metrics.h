// A render's measurements for a monitoring system.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "farm/nodes/farm.h"
#include "renderengine/error_estimate.h"
#include "terminal/metrics_page.h"

namespace antipode {

class FarmMetrics {
public:
    /// Throws Error(Usage) where nobody can listen on HOST:PORT.
    explicit FarmMetrics(const std::string& endpoint) : page_(endpoint) {}

    void publish(const std::vector<NodeReport>& nodes, uint64_t committed, double seconds,
                 const std::optional<ErrorEstimate>& error);

private:
    MetricsPage page_;
};

}  // namespace antipode
