// Cameras of the schema.
#pragma once

#include "proto/schema_fields.h"

namespace antipode {

/// What the message says of a camera. What the engine's has not: look_at becomes direction and, unless that is given,
/// focus distance; focal length and f-stop become angle and lens radius, by the image's aspect ratio (width over
/// height). Throws Error(Input).
void readCamera(const schema::Camera& from, const ReadContext& context, double aspectRatio, Camera& camera);

}  // namespace antipode
