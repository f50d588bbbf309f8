#include "client/node_table.h"

#include <algorithm>
#include <cstdio>

#include "client/terminal/text.h"

namespace antipode {
namespace {

/// Cuts or pads to so many characters; all texts here are ASCII but for the ellipsis.
std::string fitted(const std::string& text, size_t width) {
    if (text.size() > width) return text.substr(0, width - 1) + "…";
    return text + std::string(width - text.size(), ' ');
}

std::string rightAligned(const std::string& text, size_t width) {
    return text.size() < width ? std::string(width - text.size(), ' ') + text : text;
}

std::string megabytes(double bytesPerSecond) {
    char text[16];
    std::snprintf(text, sizeof text, "%.1f", bytesPerSecond * 1e-6);
    return text;
}

uint64_t trafficBefore(const NodeRates& rates, const std::string& name) {
    for (const NodeReport& node : rates.before)
        if (node.name == name) return node.bytesReceived + node.bytesSent;
    return 0;
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
        if (numbers.empty()) return fitted(text + device, std::max(columns, nameWidth + stateWidth + 20));
        text += fitted(device, deviceWidth);
        constexpr size_t widths[] = {8, 8, 8, 8, 8};
        for (size_t i = 0; i < numbers.size(); ++i) text += rightAligned(numbers[i], widths[i]);
        return text;
    };

    std::vector<std::string> lines{line("node", "state", "device", {"it/s", "leases", "MB/s", "share", "lost"})};
    const double elapsed = nowSeconds - rates.beforeSeconds;
    for (const NodeReport& node : nodes) {
        if (!node.detail.empty()) {
            lines.push_back(line(node.name, node.state, node.detail, {}));
            continue;
        }
        const uint64_t traffic = node.bytesReceived + node.bytesSent, before = trafficBefore(rates, node.name);
        const double rate = elapsed > 0 && traffic >= before ? double(traffic - before) / elapsed : 0;
        const uint64_t percent = committed ? (200 * node.committed + committed) / (2 * committed) : 0;
        lines.push_back(
            line(node.name, node.state, node.device,
                 {shortCount(node.iterationsPerSecond), std::to_string(node.leases), node.local ? "-" : megabytes(rate),
                  std::to_string(percent) + " %", std::to_string(node.lost)}));
    }
    rates.before = nodes;
    rates.beforeSeconds = nowSeconds;
    return lines;
}

}  // namespace antipode
