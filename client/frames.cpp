#include "client/frames.h"

#include <charconv>
#include <filesystem>

#include "client/stop_reason.h"
#include "renderengine/error.h"
#include "renderengine/film.h"

namespace antipode {
namespace {

void number(std::string& path, uint32_t frame) {
    const size_t last = path.rfind('#');
    if (last == std::string::npos) return;
    size_t first = last;
    while (first > 0 && path[first - 1] == '#') --first;
    std::string digits = std::to_string(frame);
    const size_t width = last + 1 - first;
    if (digits.size() < width) digits.insert(0, width - digits.size(), '0');
    path.replace(first, width, digits);
}

double numberIn(const ImageMetadata& metadata, const char* name) {
    const auto found = metadata.find(name);
    double value = 0;
    if (found != metadata.end())
        std::from_chars(found->second.data(), found->second.data() + found->second.size(), value);
    return value;
}

}  // namespace

RenderOptions optionsOfFrame(const RenderOptions& options, uint32_t frame) {
    RenderOptions one = options;
    for (std::string* path : {&one.exrPath, &one.pngPath, &one.checkpointPath, &one.resumePath}) number(*path, frame);
    if (one.statsPath) number(*one.statsPath, frame);
    one.import.animationTime = frame / options.framesPerSecond;
    return one;
}

bool isRendered(const RenderOptions& options, const std::string& jobHash) {
    if (!std::filesystem::exists(options.exrPath) || !std::filesystem::exists(options.pngPath)) return false;
    ImageMetadata metadata;
    try {
        readExr(options.exrPath, &metadata);
    } catch (const Error&) {
        return false;  // not an image, or not a whole one
    }
    const auto text = [&](const char* name) {
        const auto found = metadata.find(name);
        return found == metadata.end() ? std::string() : found->second;
    };
    if (text("antipode.jobHash") != jobHash) return false;
    const std::string stoppedBy = text("antipode.stoppedBy");
    if (options.targetError && stoppedBy == key(StopReason::TargetError))
        return numberIn(metadata, "antipode.errorPercent") <= *options.targetError;
    if (options.seconds && stoppedBy == key(StopReason::Time))
        return numberIn(metadata, "antipode.seconds") >= *options.seconds;
    return options.iterations && numberIn(metadata, "antipode.iterations") == double(*options.iterations);
}

}  // namespace antipode
