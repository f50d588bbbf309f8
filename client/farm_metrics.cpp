#include "client/farm_metrics.h"

#include <functional>

namespace antipode {

void FarmMetrics::publish(const std::vector<NodeReport>& nodes, uint64_t committed, double seconds,
                          const std::optional<ErrorEstimate>& error) {
    using enum Metric::Kind;
    std::vector<Metric> metrics{
        {"antipode_committed_iterations", "Iterations in the image", Gauge, {}, double(committed)},
        {"antipode_render_seconds", "Time since the first node was ready", Gauge, {}, seconds},
    };
    if (error) {
        metrics.push_back(
            {"antipode_error_percent", "Relative error of the image, estimated", Gauge, {}, error->percent});
        metrics.push_back({"antipode_error_percent_low", "Low end of its 95 % interval", Gauge, {}, error->low});
        metrics.push_back({"antipode_error_percent_high", "High end of its 95 % interval", Gauge, {}, error->high});
        metrics.push_back({"antipode_noise_percent", "Its part by noise", Gauge, {}, error->noisePercent});
        if (error->bias) {
            metrics.push_back({"antipode_bias_percent", "Its part by merging", Gauge, {}, error->bias->percent});
            metrics.push_back(
                {"antipode_bias_percent_low", "Low end of its 95 % interval", Gauge, {}, error->bias->low});
            metrics.push_back(
                {"antipode_bias_percent_high", "High end of its 95 % interval", Gauge, {}, error->bias->high});
        }
    }
    const auto addNodes = [&](const char* name, const char* help, Metric::Kind kind,
                              const std::function<double(const NodeReport&)>& value) {
        for (const NodeReport& node : nodes)
            metrics.push_back({name, help, kind, {{"node", node.name}, {"device", node.device}}, value(node)});
    };
    addNodes("antipode_node_iterations_total", "Iterations of the node in the image", Counter,
             [](const NodeReport& node) { return double(node.committed); });
    addNodes("antipode_node_lost_iterations_total", "Iterations leased in vain", Counter,
             [](const NodeReport& node) { return double(node.lost); });
    addNodes("antipode_node_iterations_per_second", "Measured speed", Gauge,
             [](const NodeReport& node) { return node.iterationsPerSecond; });
    addNodes("antipode_node_leases", "Blocks that the node holds", Gauge,
             [](const NodeReport& node) { return double(node.leases); });
    addNodes("antipode_node_received_bytes_total", "Bytes received from the node", Counter,
             [](const NodeReport& node) { return double(node.bytesReceived); });
    addNodes("antipode_node_sent_bytes_total", "Bytes sent to the node", Counter,
             [](const NodeReport& node) { return double(node.bytesSent); });
    page_.publish(metrics);
}

}  // namespace antipode
