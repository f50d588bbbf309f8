#include "client/progress.h"

#include <algorithm>
#include <iostream>

#include <unistd.h>

#include "client/text.h"

namespace antipode {
namespace {

constexpr double terminalIntervalSeconds = 0.1, plainIntervalSeconds = 5;

/// What is left until the first limit; nothing before the first iteration, when no rate is known.
std::optional<double> remainingSeconds(const ProgressState& state) {
    std::optional<double> remaining;
    if (state.secondLimit) remaining = std::max(0.0, *state.secondLimit - state.elapsedSeconds);
    if (state.iterationLimit && state.iterations > 0) {
        const double secondsEach = state.elapsedSeconds / double(state.iterations);
        const double left = double(*state.iterationLimit - state.iterations) * secondsEach;
        remaining = remaining ? std::min(*remaining, left) : left;
    }
    return remaining;
}

}  // namespace

std::string progressText(const ProgressState& state) {
    std::string text = std::to_string(state.iterations);
    if (state.iterationLimit) text += " of " + std::to_string(*state.iterationLimit);
    text += state.iterations == 1 && !state.iterationLimit ? " iteration" : " iterations";
    if (state.elapsedSeconds > 0) {
        text += ", " + shortCount(double(state.iterations) / state.elapsedSeconds) + " it/s";
        text += ", " + shortCount(double(state.rays) / state.elapsedSeconds) + " rays/s";
    }
    text += ", " + duration(state.elapsedSeconds);
    if (const auto remaining = remainingSeconds(state)) text += ", " + duration(*remaining) + " left";
    return text;
}

Progress::Progress(bool quiet)
    : quiet_(quiet), terminal_(::isatty(STDERR_FILENO) == 1), nextSeconds_(terminal_ ? 0 : plainIntervalSeconds) {}

Progress::~Progress() {
    if (lineOpen_) std::cerr << std::endl;
}

bool Progress::due(double elapsedSeconds) const { return !quiet_ && elapsedSeconds >= nextSeconds_; }

void Progress::show(const ProgressState& state) {
    if (terminal_)
        std::cerr << "\r" << progressText(state) << "\x1b[K" << std::flush;  // ESC [K clears what a longer text left
    else
        std::cerr << progressText(state) << std::endl;
    lineOpen_ = terminal_;
    nextSeconds_ = state.elapsedSeconds + (terminal_ ? terminalIntervalSeconds : plainIntervalSeconds);
}

}  // namespace antipode
