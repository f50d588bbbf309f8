#version 460
#extension GL_GOOGLE_include_directive : require
// Starts one camera path for each pixel of the batch.
#include "lib/common.glsl"
#include "lib/random.glsl"
#include "lib/mis.glsl"
#include "lib/camera.glsl"

void main() {
    uint slot = interleavedIndex();
    bool queued = slot < push.batchSize;
    uint pixel = framePixel(push.pathBase + slot), columns = frameSize().x;
    real4 u = randomBlock(pixel, 0, 0, RANDOM_START);
    real2 raster = real2(pixel % columns, pixel / columns) + u.xy;
    Path path;
    path.origin = cameraOrigin(raster, u.zw);
    path.originPrimitive = NO_INDEX;
    path.direction = cameraDirection(path.origin, raster);
    path.flags = 1u | PATH_SPECULAR | (feature(FEATURE_ORTHOGRAPHIC) ? PATH_FROM_INFINITY : 0u);
    path.throughput = real3(1.0);
    startCameraPath(path, cameraPdf(dot(path.direction, job.cameraForward.xyz)));
    path.lossless = 1.0;
    if (queued) {
        storePath(slot, path);
        clearRadiance(slot);
        countInvalid(SOURCE_CAMERA_RAYS, nonFinite(path.direction) || nonFinite(real3(path.dVCM)), path.dVCM < 0.0,
                     false);
    }
    enqueuePath(queued, slot);
}
