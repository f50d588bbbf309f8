// What a render's page is told (--view).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "farm/nodes/farm.h"
#include "client/progress.h"
#include "client/view/error_history.h"
#include "renderengine/layers.h"
#include "renderengine/renderer.h"

namespace antipode {

/// What a smaller error will cost; without `forecast` where that cannot be told.
struct ErrorCost {
    double percent = 0;
    bool asked = false;  ///< the error that the render ends at
    std::optional<ErrorForecastSeconds> forecast;
};

struct LiveState {
    std::string scene;  ///< what is rendered, as a name
    std::string job;    ///< how, in few words
    std::string phase;  ///< "reading pool.textproto", "rendering", "finished"
    bool rendering = false, done = false;
    std::optional<double> exposure;         ///< that was asked for, in stops
    std::optional<ProgressState> progress;  ///< once there is something to tell
    std::vector<view::ErrorPoint> history;
    std::vector<ErrorCost> costs;
    std::vector<NodeReport> nodes;
    std::vector<StageTime> stages;
    LayerSet techniques;  ///< of which the picture can be parted
    std::vector<std::string> notes, ending;
};

/// How much of the way to its first limit a render has gone, in [0, 1]; 0 without limits.
double shareDone(const LiveState& state);

/// One object without line breaks: that of progressJson() with more in it. `history` holds [seconds, iterations,
/// percent, low, high].
std::string liveStateJson(const LiveState& state);

}  // namespace antipode
