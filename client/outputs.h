// The files that a render leaves behind, apart from its checkpoint.
#pragma once

#include <optional>
#include <string>

#include "client/render_job.h"

namespace antipode {

/// Before hours of rendering rather than after. Throws Error(Output).
void checkOutputs(const RenderOptions& options);

/// The PNG of an image at the exposure that is asked for, or one by itself; in stops. Throws Error(Output).
double writeShownImage(const std::string& path, const Image& image, std::optional<double> exposure);

/// "exposure +1.5".
std::string shownExposure(double stops);

/// The relative standard error of each pixel in colours; magenta where too few iterations tell it. Throws
/// Error(Output).
void writeErrorMap(const std::string& path, const FilmSums& sums);

/// EXR, PNG and error map; returns the PNG's exposure in stops. Throws Error(Output).
double writeImages(const RenderOptions& options, const RenderResult& result);

}  // namespace antipode
