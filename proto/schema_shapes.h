// The schema's helper shapes as triangles in world space. Materials are left to the caller. All throw Error(Input).
#pragma once

#include "proto/scene.pb.h"
#include "renderengine/scene.h"

namespace antipode {

Mesh makeMesh(const schema::Mesh& mesh);
Mesh makeQuad(const schema::Quad& quad);
Mesh makeBox(const schema::Box& box);
Mesh makeDisk(const schema::Disk& disk);
Mesh makeRippleGrid(const schema::RippleGrid& grid);

}  // namespace antipode
