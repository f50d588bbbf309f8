#include "client/error_report.h"

#include <cmath>
#include <iomanip>
#include <sstream>

#include <nlohmann/json.hpp>

namespace antipode {

namespace {

constexpr double fewPixels = 0.01;  // hold half of the error

bool fewPixelsErr(const ErrorEstimate& error) { return error.halfShare > 0 && error.halfShare <= fewPixels; }

/// Two digits, and whole numbers as they are.
std::string digits(double percent) {
    if (percent >= 1000) return std::to_string(uint64_t(percent));
    std::ostringstream text;
    text << std::setprecision(percent >= 99.5 ? 3 : 2) << percent;
    return text.str();
}

/// Whether merging blurs more than noise adds.
bool blurred(const ErrorEstimate& error) {
    return error.bias && error.bias->told() && error.bias->percent > error.noisePercent;
}

std::string noiseText(const ErrorEstimate& error) {
    if (!fewPixelsErr(error)) return "limited by noise";
    if (error.halfPixels == 1) return "one pixel holds half of the error";
    if (error.halfPixels > 1 && error.halfPixels < 100)
        return std::to_string(error.halfPixels) + " pixels hold half of the error";
    return digits(100 * error.halfShare) + " % of the pixels hold half of the error";
}

/// What is said of the bias of merging where noise is more: nothing where all that is known is that it may be more.
std::string biasText(const ErrorEstimate& error) {
    if (!error.bias || error.bias->high == 0) return "";
    if (error.bias->told()) return ", merge blur " + digits(error.bias->percent) + " %";
    return error.bias->high < error.noisePercent ? ", merge blur below " + digits(error.bias->high) + " %" : "";
}

}  // namespace

std::string errorText(const ErrorEstimate& error) {
    return digits(error.percent) + " % error (" + digits(error.low) + " to " + digits(error.high) + ")";
}

std::string limitText(const ErrorEstimate& error) {
    if (!blurred(error)) return noiseText(error) + biasText(error);
    return "limited by merge blur, " + digits(error.bias->percent) + " % with " + digits(error.noisePercent) +
           " % of noise";
}

std::string errorDoubt(const ErrorEstimate& error) {
    if (!error.doubtful()) return "";
    return "the error may be larger than told: rare bright samples make it, " + digits(100 * error.worstShare) +
           " % of it in 1 % of the pixels, and brighter ones may still come";
}

nlohmann::ordered_json errorJson(const ErrorEstimate& error) {
    nlohmann::ordered_json json{{"percent", error.percent},
                                {"low", error.low},
                                {"high", error.high},
                                {"noise_percent", error.noisePercent},
                                {"worst_share", error.worstShare},
                                {"half_share", error.halfShare},
                                {"limited_by", blurred(error)        ? "merge-blur"
                                               : fewPixelsErr(error) ? "few-pixels"
                                                                     : "noise"},
                                {"tail_index", nullptr}};
    if (error.bias) {
        json["bias_percent"] = error.bias->percent;
        json["bias_low"] = error.bias->low;
        json["bias_high"] = error.bias->high;
    }
    if (std::isfinite(error.tailIndex)) json["tail_index"] = error.tailIndex;
    if (const std::string doubt = errorDoubt(error); !doubt.empty()) json["doubt"] = doubt;
    return json;
}

}  // namespace antipode
