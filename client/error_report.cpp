#include "client/error_report.h"

#include <iomanip>
#include <sstream>

#include <nlohmann/json.hpp>

namespace antipode {

std::string errorText(const ErrorEstimate& error) {
    const auto digits = [&](double percent) {
        std::ostringstream text;
        text << std::setprecision(percent >= 100 ? 3 : 2) << percent;
        return percent >= 1000 ? std::to_string(uint64_t(percent)) : text.str();
    };
    return digits(error.percent) + " % error (" + digits(error.low) + " to " + digits(error.high) + ")";
}

nlohmann::ordered_json errorJson(const ErrorEstimate& error) {
    return {{"percent", error.percent}, {"low", error.low}, {"high", error.high}, {"worst_share", error.worstShare}};
}

}  // namespace antipode
