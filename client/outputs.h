// The files that a render leaves behind, apart from its checkpoint.
#pragma once

#include "client/render_job.h"

namespace antipode {

/// Before hours of rendering rather than after. Throws Error(Output).
void checkOutputs(const RenderOptions& options);

/// EXR and PNG. Throws Error(Output).
void writeImages(const RenderOptions& options, const RenderResult& result);

}  // namespace antipode
