// The frames of an animation, rendered one after the other by one command.
#pragma once

#include <cstdint>
#include <string>

#include "client/render_options.h"

namespace antipode {

/// The options of one frame: its number stands for the last "####" in the names of files, in as many digits at least,
/// and the animation is shown at number/fps seconds.
RenderOptions optionsOfFrame(const RenderOptions& options, uint32_t frame);

/// Whether the frame's image is there, of this job (JobDefinition::hash()) and as complete as these options ask for.
bool isRendered(const RenderOptions& options, const std::string& jobHash);

}  // namespace antipode
