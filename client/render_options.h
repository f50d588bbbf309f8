// What `antipode render` is asked for.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "farm/jobs/job_definition.h"
#include "proto/scene_changes.h"
#include "proto/wire/stream.h"
#include "renderengine/import_options.h"
#include "renderengine/setting_fields.h"
#include "terminal/command_line.h"

namespace antipode {

/// Numbers of frames, both included.
struct FrameRange {
    uint32_t first = 1, last = 1;
};

struct RenderOptions {
    std::string scenePath;
    ImportOptions import;
    SceneChanges changes;
    std::string exrPath, pngPath;    ///< the PNG has the EXR's stem
    std::optional<double> exposure;  ///< of the PNG, in stops; by its own luminances without
    std::optional<std::string> statsPath;
    std::optional<FrameRange> frames;  ///< of an animation; one image without
    double framesPerSecond = 24;
    bool overwrite = false;  ///< renders frames again that are there
    RequestedSize size;
    std::optional<uint64_t> iterations;  ///< set unless `seconds` is
    std::optional<double> seconds;       ///< no iteration starts after that time of rendering
    std::string device;                  ///< selector for Engine
    bool quiet = false;
    bool estimatesError = true;
    bool noiseLayer = false;                  ///< standard errors, in the EXR
    bool biasLayer = false;                   ///< what merging blurs, in the EXR
    bool denoise = false;                     ///< the images that are written at last; the EXR keeps the noisy one, too
    std::optional<Guides> guides;             ///< the first hit to denoise by, else the settings' own
    std::optional<std::string> errorMapPath;  ///< PNG
    std::optional<double> targetError;        ///< percent; it ends when the error is there
    bool progressJson = false;                ///< progress as lines of JSON on stdout

    std::vector<wire::Endpoint> servers;
    std::string serversFile;  ///< "" for none
    bool local = false;       ///< this machine's device beside servers; without servers it is the only one
    wire::SecurityOptions security;
    std::optional<double> verifyFraction;  ///< in (0,1]
    std::optional<double> waitSeconds;     ///< without a server at work before it gives up; for ever without
    std::optional<std::string> metrics;    ///< HOST:PORT
    std::optional<wire::Endpoint> view;    ///< where the page is; nowhere without
    std::string viewTokenPath;             ///< file of its token; "" for none, then `view` is loopback

    std::string checkpointPath;  ///< "" for none
    double checkpointSeconds = 60;
    std::string resumePath;  ///< "" for none; then checkpointPath is set, too
    std::optional<double> previewSeconds;

    /// Whether the client sums the image in classes to tell its error; where the film comes in residue classes those
    /// do.
    bool errorClasses() const { return estimatesError && settings.residueClasses.value_or(1) == 1; }
    bool usesServers() const { return !servers.empty() || !serversFile.empty(); }
    RenderSettings settings;    ///< as asked for; see resolveJob
    bool allowMissing = false;  ///< light that the scene can have may be left out
};

/// Of the table of techniques.
std::vector<std::string> techniqueNames();

/// A number in the range that the table of settings gives it.
template <class V>
AssignValue assignNumber(RenderSettings& settings, V RenderSettings::*member) {
    const SettingRange range = rangeOf(member);
    if constexpr (std::is_floating_point_v<Entry<V>>)
        return assignReal(settings.*member, std::nextafter(range.least, -range.greatest), range.greatest);
    else
        return assignWhole(settings.*member, uint64_t(range.least), uint64_t(range.greatest));
}

/// A number of stops, or "auto", which is nothing.
AssignValue assignExposure(std::optional<double>& target);

/// Parses the arguments after `render` and makes them consistent. Nothing where --help was asked for.
/// Throws Error(Usage).
std::optional<RenderOptions> parseRenderOptions(const std::vector<std::string>& arguments);

}  // namespace antipode
