// Bindings and push constants that the kernels of these tests share.
layout(local_size_x = 64) in;

layout(binding = 0, std430) buffer Values { uint values[]; };
layout(binding = 1) uniform samplerBuffer table;

layout(push_constant) uniform Push { uint count; }
push;
