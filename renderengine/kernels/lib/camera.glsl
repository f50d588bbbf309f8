// Pinhole, thin-lens and orthographic camera; pixel coordinates grow to the right and down, the pixel (x, y) of the
// frame covers [x,x+1)×[y,y+1).
#ifndef ANTIPODE_CAMERA
#define ANTIPODE_CAMERA
#include "lib/crop.glsl"
#include "lib/frame.glsl"

real3 sampleLens(real2 u) {
    real3 p = job.cameraPosition.xyz;
    if (feature(FEATURE_LENS)) {
        real2 d = sampleDisk(u) * job.cameraForward.w;
        p += d.x * job.cameraRight.xyz + d.y * job.cameraUp.xyz;
    }
    return p;
}

/// Where the ray through a raster position starts.
real3 cameraOrigin(real2 raster, real2 u) {
    if (!feature(FEATURE_ORTHOGRAPHIC)) return sampleLens(u);
    real2 offset = (raster - 0.5 * real2(frameSize())) / job.cameraPosition.w;
    return job.cameraPosition.xyz + offset.x * job.cameraRight.xyz - offset.y * job.cameraUp.xyz;
}

/// The point of the camera that a vertex is splatted to.
real3 cameraPointFor(real3 vertex, real2 u) {
    if (!feature(FEATURE_ORTHOGRAPHIC)) return sampleLens(u);
    return vertex - dot(vertex - job.cameraPosition.xyz, job.cameraForward.xyz) * job.cameraForward.xyz;
}

/// Density per solid angle with which one pixel's ray takes a direction of cosine c to the axis: (D/c)²/c, D the
/// image-plane distance in pixels. Of an orthographic camera, whose rays have one direction: density per area across
/// it, at any distance.
real cameraPdf(real c) {
    if (feature(FEATURE_ORTHOGRAPHIC)) return job.cameraPosition.w * job.cameraPosition.w;
    real d = job.cameraPosition.w / c;
    return d * d / c;
}

/// Unit direction from the lens point `origin` through the raster position.
real3 cameraDirection(real3 origin, real2 raster) {
    if (feature(FEATURE_ORTHOGRAPHIC)) return job.cameraForward.xyz;
    real2 offset = raster - 0.5 * real2(frameSize());
    real3 d =
        job.cameraForward.xyz * job.cameraPosition.w + job.cameraRight.xyz * offset.x - job.cameraUp.xyz * offset.y;
    if (feature(FEATURE_LENS)) {
        real focus = job.cameraRight.w;
        d = job.cameraPosition.xyz + d * (focus / job.cameraPosition.w) - origin;
    }
    return normalize(d);
}

/// Raster position at which the lens point sees the direction `d` (unit, in front of the camera: cosine c > 0).
real2 rasterPosition(real3 origin, real3 d, real c) {
    if (feature(FEATURE_ORTHOGRAPHIC)) {
        real3 at = (origin - job.cameraPosition.xyz) * job.cameraPosition.w;
        return real2(dot(at, job.cameraRight.xyz), -dot(at, job.cameraUp.xyz)) + 0.5 * real2(frameSize());
    }
    real3 onPlane = d * (job.cameraPosition.w / c);
    if (feature(FEATURE_LENS)) {
        real focus = job.cameraRight.w;
        onPlane = (origin + d * (focus / c) - job.cameraPosition.xyz) * (job.cameraPosition.w / focus);
    }
    return real2(dot(onPlane, job.cameraRight.xyz), -dot(onPlane, job.cameraUp.xyz)) + 0.5 * real2(frameSize());
}
#endif
