// Encoding in pieces, for files that are too large to be held twice in memory.
#pragma once

#include <functional>
#include <string_view>

#include "farm/jobs/checkpoint.h"

namespace antipode {

void encodeCheckpoint(const Checkpoint& checkpoint, const std::function<void(std::string_view)>& append);

}  // namespace antipode
