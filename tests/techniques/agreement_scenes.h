// Small rooms that hold between them every kind of surface and light, for comparing techniques with each other. Bright
// walls make long paths common. The pieces do not touch: in a corner, connections have unbounded variance and merging
// has a bias of first order in the radius.
#pragma once

#include "renderengine/scene.h"

namespace antipode::test {

/// Diffuse with a texture, diffuse with a normal map, Phong on a coarse mesh with smooth normals, rough conductor,
/// rough dielectric, metallic-roughness with a texture; nothing specular. No lights.
Scene mattScene();

/// mattScene under a one-sided and a two-sided quad and a sphere light.
Scene scatteredLampsScene();
/// The same with a point and a spot light besides.
Scene lampsScene();
/// mattScene under a sun and an environment map, through a thin lens.
Scene skyScene();
/// A clear and a tinted rough pane, a ball part glass and part paint, one of rough glass and paint, one that absorbs;
/// the same lights as specularScene.
Scene glassScene();
/// Fog around all that absorbs, too, a ball of milk and one of smoke, whose surface is none; the lamps of
/// specularScene, without its sky.
Scene mediaScene();
/// Balls of glass that disperses light: smooth around a ball of water, and rough; specularScene's lights.
Scene dispersiveScene();
/// mattScene's room with a lacquered metal ball, a velvet one, a ball with both, and a plate whose coat and sheen have
/// textures, under a lamp, a glowing ball and a constant sky.
Scene layeredScene();
/// A sheet of textured alpha, a ball, a back wall and a lamp that light passes in part, and specularScene's lights.
Scene blendedScene();
/// Mirror and glass balls, Phong, diffuse; a one-sided quad, a sphere light and a constant sky: all lights can be hit.
Scene specularScene();

}  // namespace antipode::test
