#include "client/node_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "terminal/text.h"

namespace antipode {
namespace {

/// All texts here are ASCII but for the ellipsis.
std::string shortened(const std::string& text, size_t width) {
    return text.size() > width ? text.substr(0, width - 1) + "…" : text;
}

std::string fitted(const std::string& text, size_t width) {
    return shortened(text, width) + std::string(width - std::min(width, text.size()), ' ');
}

std::string rightAligned(const std::string& text, size_t width) {
    return text.size() < width ? std::string(width - text.size(), ' ') + text : text;
}

std::string megabytes(double bytesPerSecond) {
    char text[16];
    std::snprintf(text, sizeof text, "%.1f", bytesPerSecond * 1e-6);
    return text;
}

double smoothedRate(NodeRates::Traffic& traffic, uint64_t bytes, double elapsed) {
    constexpr double memorySeconds = 5;
    if (elapsed > 0 && bytes >= traffic.bytes) {
        const double weight = 1 - std::exp(-elapsed / memorySeconds);
        traffic.bytesPerSecond += weight * (double(bytes - traffic.bytes) / elapsed - traffic.bytesPerSecond);
    }
    traffic.bytes = bytes;
    return traffic.bytesPerSecond;
}

}  // namespace

std::vector<std::string> nodeTable(const std::vector<NodeReport>& nodes, NodeRates& rates, double nowSeconds,
                                   size_t columns) {
    size_t nameWidth = 4, stateWidth = 5, deviceWidth = 6;
    uint64_t committed = 0;
    for (const NodeReport& node : nodes) {
        nameWidth = std::max(nameWidth, node.name.size());
        stateWidth = std::max(stateWidth, node.state.size());
        deviceWidth = std::max(deviceWidth, node.device.size());
        committed += node.committed;
    }
    constexpr size_t numbersWidth = 42;
    const size_t words = columns > numbersWidth ? columns - numbersWidth : 0;
    deviceWidth = std::min(deviceWidth, words > nameWidth + stateWidth + 20 ? words - nameWidth - stateWidth - 6 : 14);

    const auto line = [&](const std::string& name, const std::string& state, const std::string& device,
                          const std::vector<std::string>& numbers) {
        std::string text = "  " + fitted(name, nameWidth) + "  " + fitted(state, stateWidth) + "  ";
        if (numbers.empty()) return shortened(text + device, std::max(columns, nameWidth + stateWidth + 20));
        text += fitted(device, deviceWidth);
        constexpr size_t widths[] = {8, 8, 8, 8, 8};
        for (size_t i = 0; i < numbers.size(); ++i) text += rightAligned(numbers[i], widths[i]);
        return text;
    };

    std::vector<std::string> lines{line("node", "state", "device", {"it/s", "leases", "MB/s", "share", "lost"})};
    const double elapsed = nowSeconds - rates.lastSeconds;
    for (const NodeReport& node : nodes) {
        if (!node.detail.empty()) {
            lines.push_back(line(node.name, node.state, node.detail, {}));
            continue;
        }
        const double rate = smoothedRate(rates.nodes[node.name], node.bytesReceived + node.bytesSent, elapsed);
        const uint64_t percent = committed ? (200 * node.committed + committed) / (2 * committed) : 0;
        lines.push_back(
            line(node.name, node.state, node.device,
                 {shortCount(node.iterationsPerSecond), std::to_string(node.leases), node.local ? "-" : megabytes(rate),
                  std::to_string(percent) + " %", std::to_string(node.lost)}));
    }
    rates.lastSeconds = nowSeconds;
    return lines;
}

}  // namespace antipode
