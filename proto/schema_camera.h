// Cameras of the schema.
#pragma once

#include "proto/schema_fields.h"

namespace antipode {

/// What the message says of a camera; look_at, which the engine's has not, becomes direction and, unless that is given,
/// focus distance. Throws Error(Input).
void readCamera(const schema::Camera& from, const ReadContext& context, Camera& camera);

}  // namespace antipode
