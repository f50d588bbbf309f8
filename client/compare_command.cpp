// antipode compare: an image measured against a reference.
#include <cstdio>

#include <nlohmann/json.hpp>

#include "terminal/command_line.h"
#include "client/commands.h"
#include "renderengine/film.h"

namespace antipode {
namespace {

template <class T>
nlohmann::ordered_json toJson(const Vec3<T>& v) {
    return nlohmann::ordered_json::array({v.x, v.y, v.z});
}

/// Numbers that are not finite become null, as JSON has none.
nlohmann::ordered_json toJson(const ImageComparison& comparison) {
    nlohmann::ordered_json json{
        {"mean_a", toJson(comparison.meanA)},    {"mean_b", toJson(comparison.meanB)},
        {"ratio", toJson(comparison.ratio)},     {"rmse", comparison.rmse},
        {"rel_mse", comparison.relMse},          {"non_finite_a", comparison.nonFiniteA},
        {"non_finite_b", comparison.nonFiniteB}, {"negative_a", comparison.negativeA},
        {"negative_b", comparison.negativeB},    {"worst", nlohmann::ordered_json::array()},
    };
    for (const WorstPixel& pixel : comparison.worst)
        json["worst"].push_back({{"x", pixel.x},
                                 {"y", pixel.y},
                                 {"a", toJson(pixel.a)},
                                 {"b", toJson(pixel.b)},
                                 {"relative_squared_error", pixel.relativeSquaredError}});
    return json;
}

void printText(const ImageComparison& comparison) {
    const auto row = [](const char* name, const Vec3d& v) {
        std::printf("%-10s %12.6g %12.6g %12.6g\n", name, v.x, v.y, v.z);
    };
    std::printf("%-10s %12s %12s %12s\n", "", "red", "green", "blue");
    row("mean A", comparison.meanA);
    row("mean B", comparison.meanB);
    row("A / B", comparison.ratio);
    std::printf("RMSE       %12.6g\nrelMSE     %12.6g   (epsilon 0.01)\n", comparison.rmse, comparison.relMse);
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

}  // namespace

void compareCommand(const std::vector<std::string>& arguments) {
    std::string pathA, pathB;
    bool json = false;
    if (!parseCommandLine("antipode compare", "Measures image A against the reference B.",
                          {{"A.exr", "", "image", "", assignText(pathA)},
                           {"B.exr", "", "reference of the same size", "", assignText(pathB)},
                           {"--json", "", "print a JSON object", "", assignFlag(json, true)}},
                          arguments))
        return;
    const Image a = readExr(pathA), b = readExr(pathB);
    const ImageComparison comparison = compareImages(a, b);
    if (json)
        std::printf("%s\n", toJson(comparison).dump(2).c_str());
    else
        printText(comparison);
}

}  // namespace antipode
