// Glass without a stated thickness: a pane where its mesh is a sheet, a body where it is closed.
#pragma once

#include "renderengine/scene.h"

namespace antipode {

/// Makes thin materials those of a body on every mesh that bounds a volume. A material that sheets show, too, is
/// doubled. For importers: formats say of a material what only its mesh can answer.
void makeClosedGlassSolid(Scene& scene);

}  // namespace antipode
