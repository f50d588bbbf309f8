// Materials of the schema, and what they say in vain.
#pragma once

#include <string>
#include <vector>

#include "proto/scene.pb.h"
#include "proto/schema_fields.h"

namespace antipode {

/// Adds to `notices` which of the fields that are set have no effect on a material of this kind. Throws Error(Input).
Material readMaterial(const schema::Material& material, const ReadContext& context, std::vector<std::string>& notices);

}  // namespace antipode
