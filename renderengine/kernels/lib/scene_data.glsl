// The scene's primitives and materials, as texel buffers: the fastest reads everywhere.
#ifndef ANTIPODE_SCENE_DATA
#define ANTIPODE_SCENE_DATA
layout(set = 0, binding = BIND_PRIMITIVES) uniform usamplerBuffer primitives;
layout(set = 0, binding = BIND_ATTRIBUTES) uniform usamplerBuffer attributes;
layout(set = 0, binding = BIND_MATERIALS) uniform usamplerBuffer materials;
#endif
