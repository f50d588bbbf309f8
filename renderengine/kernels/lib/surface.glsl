// The surface at a hit or at a stored light vertex, and rays that leave it without meeting it again.
#ifndef ANTIPODE_SURFACE
#define ANTIPODE_SURFACE
#include "lib/media.glsl"
#include "lib/scene_data.glsl"
#include "lib/texture.glsl"

struct Surface {
    real3 position;
    real offset;   // distance along the normal that covers the rounding error of `position`
    real3 normal;  // geometric, unit, towards the front
    real3 shadingNormal;
    TexturePoint uv;
    uint primitive, material, light;
};

/// How far a ray's origin is kept off a triangle: beyond the rounding of the point, whose weighted vertices have the
/// absolute values `magnitude`, and beyond the room that gpu/packed_scene.cpp leaves around its box, so that a ray does
/// not enter the box of what it leaves (in float; in double it costs a visit of the box): across an axis-aligned
/// triangle, on which small things can stand, next to none, but off a plane at 0 and the least thickness of its box.
real triangleOffset(real3 p0, real3 p1, real3 p2, real3 magnitude, real3 normal) {
    real3 size = max(p0, max(p1, p2)) - min(p0, min(p1, p2));
    bool flat_ = min(size.x, min(size.y, size.z)) == 0.0;
    real room = flat_ ? UNIT_ROUNDOFF / 65536.0 : 9.0 * UNIT_ROUNDOFF;
    return errorGamma(10.0) * dot(magnitude, abs(normal)) + room * max(size.x, max(size.y, size.z));
}

/// Replaces what texture coordinates tell of a normal map's tangent by what the vertices say, where they do. Their side
/// is that of a bitangent against growing v.
void useGivenTangent(TexturePoint point, inout real3 tangent, inout real side) {
    int at = moreAttributesOf(point.primitive);
    real4 t0 = uintBitsToFloat(texelFetch(moreAttributes, at)),
          t1 = uintBitsToFloat(texelFetch(moreAttributes, at + 1)),
          t2 = uintBitsToFloat(texelFetch(moreAttributes, at + 2));
    real4 given = (1.0 - point.b1 - point.b2) * t0 + point.b1 * t1 + point.b2 * t2;
    if (dot(given.xyz, given.xyz) == 0.0) return;
    tangent = given.xyz;
    side = given.w < 0.0 ? 1.0 : -1.0;
}

/// The surface of `primitive` at barycentrics b1, b2 (triangles), or where `towards` lies on it (spheres).
Surface surfaceAt(uint primitive, real b1, real b2, real3 towards) {
    Surface surface;
    uvec4 r0 = texelFetch(primitives, int(3u * primitive)), r1 = texelFetch(primitives, int(3u * primitive + 1u)),
          r2 = texelFetch(primitives, int(3u * primitive + 2u));
    surface.primitive = primitive;
    surface.material = r0.w;
    surface.light = r1.w;
    surface.uv = TexturePoint(real2(0.0), primitive, b1, b2);
    bool sphere = feature(FEATURE_SPHERES) && primitiveKind(r2) == PRIMITIVE_SPHERE;
    if (feature(FEATURE_TRIANGLES)) {
        // The flat triangle.
        real3 p0 = uintBitsToFloat(r0.xyz), p1 = uintBitsToFloat(r1.xyz), p2 = uintBitsToFloat(r2.xyz);
        real b0 = 1.0 - b1 - b2;
        surface.position = b0 * p0 + b1 * p1 + b2 * p2;
        surface.normal = normalize(cross(p1 - p0, p2 - p0));
        surface.shadingNormal = surface.normal;
        surface.offset = triangleOffset(p0, p1, p2, abs(b0 * p0) + abs(b1 * p1) + abs(b2 * p2), surface.normal);
        if (feature(FEATURE_ATTRIBUTES)) {
            // What its vertices say: shading normal, texture coordinates.
            uvec4 a0 = texelFetch(attributes, int(4u * primitive)),
                  a1 = texelFetch(attributes, int(4u * primitive + 1u)),
                  a2 = texelFetch(attributes, int(4u * primitive + 2u)),
                  a3 = texelFetch(attributes, int(4u * primitive + 3u));
            real3 n = b0 * uintBitsToFloat(a0.xyz) + b1 * uintBitsToFloat(uvec3(a0.w, a1.xy)) +
                      b2 * uintBitsToFloat(uvec3(a1.zw, a2.x));
            real n2 = dot(n, n);
            if (n2 > 0.0) surface.shadingNormal = n * inversesqrt(n2);
            real2 uv0 = uintBitsToFloat(a2.yz), uv1 = uintBitsToFloat(uvec2(a2.w, a3.x)), uv2 = uintBitsToFloat(a3.yz);
            surface.uv.uv = b0 * uv0 + b1 * uv1 + b2 * uv2;
            if (feature(FEATURE_NORMAL_MAPS)) {
                uint map = texelFetch(materials, int(surface.material * MATERIAL_TEXELS + 4u)).w;
                // A normal map, in the frame of tangent, bitangent and shading normal.
                if (map != NO_INDEX) {
                    textureTriangle(map, primitive, uv0, uv1, uv2);
                    real2 d1 = uv1 - uv0, d2 = uv2 - uv0;
                    real determinant = d1.x * d2.y - d1.y * d2.x;
                    real side = sign(determinant);
                    real3 tangent = ((p1 - p0) * d2.y - (p2 - p0) * d1.y) * side;
                    if (feature(FEATURE_TANGENTS)) useGivenTangent(surface.uv, tangent, side);
                    tangent -= surface.shadingNormal * dot(surface.shadingNormal, tangent);
                    real t2 = dot(tangent, tangent);
                    if (side != 0.0 && t2 > 0.0) {
                        tangent *= inversesqrt(t2);
                        real3 bitangent = cross(surface.shadingNormal, tangent) * side;
                        real scale =
                            uintBitsToFloat(texelFetch(materials, int(surface.material * MATERIAL_TEXELS + 5u)).w);
                        real3 m = sampleTexture(map, surface.uv).xyz * 2.0 - 1.0;
                        // Image rows grow downwards in uv space, glTF's green points up: v and the bitangent agree.
                        surface.shadingNormal = normalize(tangent * (m.x * scale) + bitangent * (-m.y * scale) +
                                                          surface.shadingNormal * m.z);
                    }
                }
            }
        }
    }
    if (sphere) {
        // A sphere, in place of the triangle that its record is not.
        real3 center = uintBitsToFloat(r0.xyz);
        real radius = uintBitsToFloat(r1.x);
        real3 out_ = towards - center;
        surface.normal = normalize(out_);
        surface.shadingNormal = surface.normal;
        surface.position = center + surface.normal * radius;
        surface.offset = errorGamma(8.0) * (dot(abs(center), abs(surface.normal)) + radius);
        surface.uv = TexturePoint(real2(0.0), primitive, 0.0, 0.0);
    }
    return surface;
}

/// The surface of a primitive at a point known only by its position.
Surface surfaceAtPosition(uint primitive, real3 position) {
    real b1 = 0.0, b2 = 0.0;
    if (feature(FEATURE_ATTRIBUTES)) {
        real3 p0 = uintBitsToFloat(texelFetch(primitives, int(3u * primitive)).xyz);
        real3 e1 = uintBitsToFloat(texelFetch(primitives, int(3u * primitive + 1u)).xyz) - p0;
        real3 e2 = uintBitsToFloat(texelFetch(primitives, int(3u * primitive + 2u)).xyz) - p0;
        real3 d = position - p0;
        real3 n = cross(e1, e2);
        real inverse = 1.0 / dot(n, n);
        b1 = dot(cross(d, e2), n) * inverse;
        b2 = dot(cross(e1, d), n) * inverse;
    }
    Surface surface = surfaceAt(primitive, b1, b2, position);
    if (feature(FEATURE_TRIANGLES)) {
        // Without barycentrics the interpolated position means nothing: the stored one is the vertex.
        surface.position = position;
        if (!feature(FEATURE_ATTRIBUTES)) {
            real3 p0 = uintBitsToFloat(texelFetch(primitives, int(3u * primitive)).xyz);
            real3 p1 = uintBitsToFloat(texelFetch(primitives, int(3u * primitive + 1u)).xyz);
            uvec4 r2 = texelFetch(primitives, int(3u * primitive + 2u));
            real3 p2 = uintBitsToFloat(r2.xyz);
            if (!feature(FEATURE_SPHERES) || primitiveKind(r2) == PRIMITIVE_TRIANGLE)
                surface.offset = triangleOffset(p0, p1, p2, max(abs(p0), max(abs(p1), abs(p2))), surface.normal);
        }
    }
    return surface;
}

/// Where a ray that leaves the surface to the side of `direction` starts: off it by the position's error bound, rounded
/// away. Proportional to the coordinates, so that a scaled scene gives scaled rays.
real3 leaveSurface(Surface surface, real3 direction) {
    real offset = surface.offset;
    if (feature(FEATURE_INTERFACES)) offset += interfaceRoom();
    real3 step_ = surface.normal * (dot(direction, surface.normal) >= 0.0 ? offset : -offset);
    return nudge(surface.position + step_, step_);
}
#endif
