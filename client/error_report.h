// An estimated error, in words and for programs.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "renderengine/error_estimate.h"

namespace antipode {

/// "1.8 % error (1.7 to 1.9)": √relMSE and its 95 % interval.
std::string errorText(const ErrorEstimate& error);

/// What keeps it up, in few words: "limited by noise", or "0.3 % of the pixels hold half of the error", or how many
/// pixels; then "merge blur 0.8 %", or below how much it is where noise hides it; or "limited by merge blur" where that
/// is more than the noise.
std::string limitText(const ErrorEstimate& error);

/// Why it may be larger than told, in a sentence without a full stop; empty where nothing speaks for that.
std::string errorDoubt(const ErrorEstimate& error);

/// {percent, low, high, noise_percent, worst_share, half_share, limited_by, tail_index}; where merging is watched
/// `bias_percent`, `bias_low` (0 where noise might make it all) and `bias_high`; and `doubt` where there is one.
/// `tail_index` is null where it is infinite.
nlohmann::ordered_json errorJson(const ErrorEstimate& error);

}  // namespace antipode
