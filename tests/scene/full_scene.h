// A small valid scene in which every field differs from its default.
#pragma once

#include "renderengine/scene.h"

namespace antipode::testing {

Scene fullScene();

}  // namespace antipode::testing
