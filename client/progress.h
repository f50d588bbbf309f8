// How far a render is.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "client/node_table.h"
#include "renderengine/error_estimate.h"

namespace antipode {

/// When the error will be so small.
struct ErrorForecastSeconds {
    double percent = 0, seconds = 0, spread = 0;  ///< from now; half of the 95 % interval
};

struct ProgressState {
    uint64_t iterations = 0;         ///< in the image
    uint64_t iterationsInHand = 0;   ///< rendered, and not yet in the image
    uint64_t resumedIterations = 0;  ///< of `iterations`, rendered by an earlier run
    std::optional<uint64_t> iterationLimit;
    std::optional<double> secondLimit;
    double elapsedSeconds = 0;
    double iterationSeconds = 0;  ///< `elapsedSeconds` when the last iteration came
    std::optional<ErrorEstimate> error;
    std::optional<ErrorForecastSeconds> forecast;
    uint64_t rays = 0;              ///< traced so far, by this run
    std::vector<NodeReport> nodes;  ///< of a farm; empty where the local device is the only one
};

/// "12 of 64 iterations, 5.2 it/s, 84 M rays/s, 2.3 s, 10.0 s left".
std::string progressText(const ProgressState& state);

/// `seconds_left` until the first limit, `error` and `forecast` where they are known.
nlohmann::ordered_json progressValues(const ProgressState& state);
/// The same without line breaks.
std::string progressJson(const ProgressState& state);

/// Shows the state on stderr: on a terminal as lines that overwrite themselves, with a table of the nodes; else as a
/// plain line every few seconds. Or as a line of JSON on stdout every second.
class Progress {
public:
    using Heard = std::function<void(const std::string&)>;
    /// `onStep` hears of every step and `onNote` of every line in between, whatever is printed.
    explicit Progress(bool quiet, bool json = false, Heard onStep = {}, Heard onNote = {});
    /// Ends the lines of a terminal.
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Whether it is time to show something again.
    bool due(double elapsedSeconds) const;
    void show(const ProgressState& state);
    /// On a terminal a line for what is being done before the first iteration: "reading pool.textproto …".
    void showStep(const std::string& what);
    /// Says something in between, above the lines of a terminal. Even where quiet: it is a warning.
    void interject(const std::string& line);

    /// Takes the lines of a terminal away.
    void clear();

private:
    bool quiet_, json_, terminal_;
    size_t openLines_ = 0;  ///< of a terminal, to be overwritten
    double nextSeconds_;
    NodeRates rates_;
    Heard onStep_, onNote_;
};

}  // namespace antipode
