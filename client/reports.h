// What a finished render says about itself: to a program, in its image, to its user.
#pragma once

#include <string>

#include "client/render_job.h"

namespace antipode {

/// The text of the --stats file: one JSON object. Times in seconds, radii in scene units, sizes in bytes or pixels.
std::string statsJson(const RenderResult& result);

/// The string attributes of the EXR, named "antipode.…".
ImageMetadata imageMetadata(const RenderResult& result);

/// Size, iterations, time, rates, device and error in one line, and in a second one why the error may be larger.
std::string summary(const RenderResult& result);

/// The last line of --progress json: `done`, why it ended, and the image's name and error.
std::string outcomeJson(const RenderResult& result, const std::string& image);

/// One sentence that counts what a correct render never does, and where it did; empty for a clean one.
std::string eventWarning(const EventCounts& events);

}  // namespace antipode
