// Inputs and outputs of a probe: three texels of each for every invocation, bound after all that the renderer binds.
#ifndef ANTIPODE_PROBE
#define ANTIPODE_PROBE
layout(set = 0, binding = BIND_COUNT, std430) readonly buffer InputA { vec4 inputA[]; };
layout(set = 0, binding = BIND_COUNT + 1, std430) readonly buffer InputB { vec4 inputB[]; };
layout(set = 0, binding = BIND_COUNT + 2, std430) readonly buffer InputC { vec4 inputC[]; };
layout(set = 0, binding = BIND_COUNT + 3, std430) writeonly buffer OutputA { vec4 outputA[]; };
layout(set = 0, binding = BIND_COUNT + 4, std430) writeonly buffer OutputB { vec4 outputB[]; };
layout(set = 0, binding = BIND_COUNT + 5, std430) writeonly buffer OutputC { vec4 outputC[]; };
#endif
