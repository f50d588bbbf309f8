// antipode compare: an image measured against a reference.
#include <cmath>
#include <cstdio>
#include <numeric>

#include <nlohmann/json.hpp>

#include "terminal/command_line.h"
#include "client/commands.h"
#include "renderengine/error.h"
#include "renderengine/film.h"
#include "renderengine/flip.h"
#include "renderengine/io/files.h"
#include "renderengine/pictures.h"

namespace antipode {
namespace {

template <class T>
nlohmann::ordered_json toJson(const Vec3<T>& v) {
    return nlohmann::ordered_json::array({v.x, v.y, v.z});
}

/// The measures, and those that a viewer understands.
struct Measures {
    ImageComparison comparison;
    double percent = 0;  ///< √relMSE
    double flip = 0;     ///< mean over pixels, of what the PNGs would show
};

/// Numbers that are not finite become null, as JSON has none.
nlohmann::ordered_json toJson(const Measures& measures) {
    const ImageComparison& comparison = measures.comparison;
    nlohmann::ordered_json json{
        {"mean_a", toJson(comparison.meanA)},
        {"mean_b", toJson(comparison.meanB)},
        {"ratio", toJson(comparison.ratio)},
        {"rmse", comparison.rmse},
        {"rel_mse", comparison.relMse},
        {"relative_error_percent", measures.percent},
        {"flip", measures.flip},
        {"non_finite_a", comparison.nonFiniteA},
        {"non_finite_b", comparison.nonFiniteB},
        {"negative_a", comparison.negativeA},
        {"negative_b", comparison.negativeB},
        {"worst", nlohmann::ordered_json::array()},
    };
    for (const WorstPixel& pixel : comparison.worst)
        json["worst"].push_back({{"x", pixel.x},
                                 {"y", pixel.y},
                                 {"a", toJson(pixel.a)},
                                 {"b", toJson(pixel.b)},
                                 {"relative_squared_error", pixel.relativeSquaredError}});
    return json;
}

void printText(const Measures& measures) {
    const ImageComparison& comparison = measures.comparison;
    const auto row = [](const char* name, const Vec3d& v) {
        std::printf("%-10s %12.6g %12.6g %12.6g\n", name, v.x, v.y, v.z);
    };
    std::printf("%-10s %12s %12s %12s\n", "", "red", "green", "blue");
    row("mean A", comparison.meanA);
    row("mean B", comparison.meanB);
    row("A / B", comparison.ratio);
    std::printf("RMSE       %12.6g\nrelMSE     %12.6g   (epsilon 0.01)\n", comparison.rmse, comparison.relMse);
    std::printf("error      %12.6g %% (square root of relMSE)\nFLIP       %12.6g   (0 to 1, mean)\n", measures.percent,
                measures.flip);
    const auto counts = [](const char* name, uint64_t a, uint64_t b) {
        std::printf("%-10s %12llu in A, %llu in B\n", name, static_cast<unsigned long long>(a),
                    static_cast<unsigned long long>(b));
    };
    counts("not finite", comparison.nonFiniteA, comparison.nonFiniteB);
    counts("negative", comparison.negativeA, comparison.negativeB);
    if (!comparison.worst.empty()) std::printf("worst pixels (x, y; A; B; mean relative squared error)\n");
    for (const WorstPixel& pixel : comparison.worst)
        std::printf("%6u %6u   %10.4g %10.4g %10.4g   %10.4g %10.4g %10.4g   %10.4g\n", pixel.x, pixel.y, pixel.a.x,
                    pixel.a.y, pixel.a.z, pixel.b.x, pixel.b.y, pixel.b.z, pixel.relativeSquaredError);
}

/// Throws Error(Input) where the image cannot be taken for the reference: scripts go by the exit code.
void requireWithin(const Measures& measures, double limitPercent) {
    const uint64_t nonFinite = measures.comparison.nonFiniteA + measures.comparison.nonFiniteB;
    if (nonFinite > 0)
        throw Error(ErrorCode::Input,
                    "The images have pixels that are not finite: " + std::to_string(measures.comparison.nonFiniteA) +
                        " in A, " + std::to_string(measures.comparison.nonFiniteB) + " in B.");
    if (measures.percent <= limitPercent) return;
    char text[128];
    std::snprintf(text, sizeof text, "The relative error is %.4g %%, above the limit of %.4g %%.", measures.percent,
                  limitPercent);
    throw Error(ErrorCode::Input, text);
}

}  // namespace

void compareCommand(const std::vector<std::string>& arguments) {
    std::string pathA, pathB;
    bool json = false;
    std::optional<std::string> mapPath;
    std::optional<double> limitPercent;
    if (!parseCommandLine(
            "antipode compare", "Measures image A against the reference B.",
            {{"A.exr", "", "image", "", assignText(pathA)},
             {"B.exr", "", "reference of the same size", "", assignText(pathB)},
             {"--diff", "FILE.png", "map of the relative error to write: black 0.1 % to pale yellow 100 %", "none",
              assignText(mapPath)},
             {"--fail-above", "PERCENT", "exit code 1 where the relative error is larger or a pixel is not finite",
              "none", assignReal(limitPercent, 0)},
             {"--json", "", "print a JSON object", "", assignFlag(json, true)}},
            arguments))
        return;
    if (mapPath && (*mapPath == pathA || *mapPath == pathB))
        throw Error(ErrorCode::Usage, "--diff would overwrite the image '" + *mapPath + "'.");
    const Image a = readExr(pathA), b = readExr(pathB);
    Measures measures{compareImages(a, b)};
    measures.percent = 100 * std::sqrt(measures.comparison.relMse);
    const std::vector<float> flip = flipErrors(a, b);
    measures.flip = std::accumulate(flip.begin(), flip.end(), 0.0) / double(flip.size());
    if (mapPath)
        writeFileAtomically(*mapPath,
                            encodeErrorMap(a.width, a.height, relativeErrors(a, b), errorMapLow, errorMapHigh));
    if (json)
        std::printf("%s\n", toJson(measures).dump(2).c_str());
    else
        printText(measures);
    if (limitPercent) requireWithin(measures, *limitPercent);
}

}  // namespace antipode
