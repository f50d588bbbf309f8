// The frame, of which the film may hold a part. A camera path draws its random numbers by its pixel of the frame, so
// that a part has the bytes that it has in the whole.
#ifndef ANTIPODE_CROP
#define ANTIPODE_CROP

/// Pixels of the frame, each way.
uvec2 frameSize() { return feature(FEATURE_CROP) ? job.crop.zw : job.image.xy; }

/// The film's first pixel, in the frame.
uvec2 filmOrigin() { return feature(FEATURE_CROP) ? job.crop.xy : uvec2(0u); }

/// The number in the frame of a pixel of the film; that of its camera path among all.
uint framePixel(uint filmPixel) {
    if (!feature(FEATURE_CROP)) return filmPixel;
    uvec2 at = job.crop.xy + uvec2(filmPixel % job.image.x, filmPixel / job.image.x);
    return at.y * job.crop.z + at.x;
}
#endif
