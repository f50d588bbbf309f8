// A small valid scene with everything that a scene can hold.
#pragma once

#include "renderengine/scene.h"

namespace antipode::wire::testing {

Scene richScene();

}  // namespace antipode::wire::testing
