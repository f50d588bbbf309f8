#include "client/progress.h"

#include <algorithm>
#include <iostream>
#include <sstream>

#include <nlohmann/json.hpp>

#include <sys/ioctl.h>
#include <unistd.h>

#include "client/error_report.h"
#include "terminal/text.h"

namespace antipode {
namespace {

constexpr double terminalIntervalSeconds = 0.1, tableIntervalSeconds = 0.5, plainIntervalSeconds = 5,
                 jsonIntervalSeconds = 1;

/// What is left until the first limit; nothing before the first iteration, when no rate is known.
std::optional<double> remainingSeconds(const ProgressState& state, double done) {
    std::optional<double> remaining;
    if (state.secondLimit) remaining = std::max(0.0, *state.secondLimit - state.elapsedSeconds);
    if (state.iterationLimit && done > 0) {
        const double missing = double(*state.iterationLimit) - double(state.iterations + state.iterationsInHand);
        // At the pace of whole iterations: within one, time runs down instead of the estimate going up.
        const double pace = (state.iterationSeconds > 0 ? state.iterationSeconds : state.elapsedSeconds) / done;
        const double sinceLast = state.iterationSeconds > 0 ? state.elapsedSeconds - state.iterationSeconds : 0;
        const double left = std::max(missing * pace - sinceLast, 0.0);
        remaining = remaining ? std::min(*remaining, left) : left;
    }
    return remaining;
}

size_t terminalColumns() {
    winsize size{};
    return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

size_t rendering(const std::vector<NodeReport>& nodes) {
    return size_t(std::count_if(nodes.begin(), nodes.end(), [](const NodeReport& node) { return node.leases > 0; }));
}

}  // namespace

std::string progressText(const ProgressState& state) {
    const uint64_t reached = state.iterations + state.iterationsInHand;
    std::string text = std::to_string(reached);
    if (state.iterationLimit) text += " of " + std::to_string(*state.iterationLimit);
    text += reached == 1 && !state.iterationLimit ? " iteration" : " iterations";
    const double done = double(reached) - double(state.resumedIterations);
    if (state.elapsedSeconds > 0) {
        text += ", " + shortCount(std::max(done, 0.0) / state.elapsedSeconds) + " it/s";
        if (state.rays > 0) text += ", " + shortCount(double(state.rays) / state.elapsedSeconds) + " rays/s";
    }
    text += ", " + duration(state.elapsedSeconds);
    if (const auto remaining = remainingSeconds(state, done)) text += ", " + duration(*remaining) + " left";
    if (!state.error) return text;
    text += "; " + errorText(*state.error);
    // A time that is off by more than itself is none.
    if (state.forecast && state.forecast->spread < state.forecast->seconds) {
        std::ostringstream percent;
        percent << state.forecast->percent;
        text += ", " + percent.str() + " % in " + duration(state.forecast->seconds) + " ± " +
                duration(state.forecast->spread);
    }
    return text + "; " + limitText(*state.error);
}

nlohmann::ordered_json progressValues(const ProgressState& state) {
    const uint64_t reached = state.iterations + state.iterationsInHand;
    const double done = std::max(double(reached) - double(state.resumedIterations), 0.0);
    nlohmann::ordered_json json{{"iterations", reached}, {"seconds", state.elapsedSeconds}};
    if (state.iterationLimit) json["iteration_limit"] = *state.iterationLimit;
    if (state.elapsedSeconds > 0) {
        json["iterations_per_second"] = done / state.elapsedSeconds;
        json["rays_per_second"] = double(state.rays) / state.elapsedSeconds;
    }
    if (const auto remaining = remainingSeconds(state, done)) json["seconds_left"] = *remaining;
    if (state.error) json["error"] = errorJson(*state.error);
    if (state.forecast)
        json["forecast"] = {{"percent", state.forecast->percent},
                            {"seconds", state.forecast->seconds},
                            {"spread", state.forecast->spread}};
    if (!state.nodes.empty()) json["nodes_rendering"] = rendering(state.nodes);
    return json;
}

std::string progressJson(const ProgressState& state) { return progressValues(state).dump(); }

Progress::Progress(bool quiet, bool json, Heard onStep, Heard onNote)
    : quiet_(quiet),
      json_(json),
      terminal_(!json && ::isatty(STDERR_FILENO) == 1),
      nextSeconds_(terminal_ ? 0
                   : json    ? jsonIntervalSeconds
                             : plainIntervalSeconds),
      onStep_(std::move(onStep)),
      onNote_(std::move(onNote)) {}

Progress::~Progress() {
    if (openLines_ > 0) std::cerr << std::endl;
}

bool Progress::due(double elapsedSeconds) const { return !quiet_ && elapsedSeconds >= nextSeconds_; }

void Progress::show(const ProgressState& state) {
    if (json_) {
        std::cout << progressJson(state) << std::endl;
        nextSeconds_ = state.elapsedSeconds + jsonIntervalSeconds;
        return;
    }
    const bool farm = !state.nodes.empty();
    if (!terminal_) {
        std::cerr << progressText(state);
        if (farm) std::cerr << "; " << rendering(state.nodes) << " of " << state.nodes.size() << " nodes render";
        std::cerr << std::endl;
        nextSeconds_ = state.elapsedSeconds + plainIntervalSeconds;
        return;
    }
    std::vector<std::string> lines{progressText(state)};
    if (farm)
        for (std::string& line : nodeTable(state.nodes, rates_, state.elapsedSeconds, terminalColumns()))
            lines.push_back(std::move(line));
    clear();
    for (size_t i = 0; i < lines.size(); ++i) std::cerr << (i ? "\n" : "") << lines[i];
    std::cerr << std::flush;
    openLines_ = lines.size();
    nextSeconds_ = state.elapsedSeconds + (farm ? tableIntervalSeconds : terminalIntervalSeconds);
}

void Progress::showStep(const std::string& what) {
    if (onStep_) onStep_(what);
    if (quiet_ || !terminal_) return;
    clear();
    const std::string text = what + " …";
    std::cerr << text.substr(0, std::max<size_t>(terminalColumns(), 1)) << std::flush;
    openLines_ = 1;
}

void Progress::interject(const std::string& line) {
    if (onNote_) onNote_(line);
    clear();
    std::cerr << line << std::endl;
}

/// Leaves the cursor where the first of the open lines began, with nothing below it.
void Progress::clear() {
    if (openLines_ > 1) std::cerr << "\x1b[" << openLines_ - 1 << "A";
    if (openLines_ > 0) std::cerr << "\r\x1b[J";
    openLines_ = 0;
}

}  // namespace antipode
