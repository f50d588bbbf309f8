// The scene's primitives and materials, as texel buffers: the fastest reads everywhere.
#ifndef ANTIPODE_SCENE_DATA
#define ANTIPODE_SCENE_DATA
layout(set = 0, binding = BIND_PRIMITIVES) uniform usamplerBuffer primitives;
layout(set = 0, binding = BIND_ATTRIBUTES) uniform usamplerBuffer attributes;
layout(set = 0, binding = BIND_MORE_ATTRIBUTES) uniform usamplerBuffer moreAttributes;
layout(set = 0, binding = BIND_MATERIALS) uniform usamplerBuffer materials;

/// Of a primitive's last texel: PRIMITIVE_*, and the rank of its transparent body.
uint primitiveKind(uvec4 r2) { return feature(FEATURE_INTERFACES) ? r2.w & PRIMITIVE_KIND_MASK : r2.w; }
uint primitiveRank(uvec4 r2) { return feature(FEATURE_INTERFACES) ? r2.w >> PRIMITIVE_RANK_SHIFT : 0u; }
#endif
