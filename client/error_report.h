// An estimated error, in words and for programs.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "renderengine/error_estimate.h"

namespace antipode {

/// "1.8 % error (1.7 to 1.9)": √relMSE and its 95 % interval.
std::string errorText(const ErrorEstimate& error);

/// {percent, low, high, worst_share}.
nlohmann::ordered_json errorJson(const ErrorEstimate& error);

}  // namespace antipode
