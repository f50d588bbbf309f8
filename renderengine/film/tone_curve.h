// From scene-linear radiance to what a display shows.
#pragma once

#include <array>
#include <cstdint>

#include "renderengine/vec.h"

namespace antipode {

/// Maps finite linear RGB (Rec. 709) to display-linear RGB in [0,1], without exposure: radiance 1 is not white but a
/// bright tone on the shoulder, and no radiance clips.
///
/// The curve is that of the Khronos PBR Neutral tone mapper (Lalish 2024, specification 1.0) without its Fresnel offset
/// and with a longer shoulder. A colour whose largest component (peak) is at most shoulderStart is shown as it is.
/// Above, the peak p becomes 1 − d²/(p + d − shoulderStart) with d = 1 − shoulderStart, which joins with slope 1 and
/// tends to 1; scaling all components alike keeps the hue, and a blend towards white by 1 − 1/(desaturation·(p − p′) +
/// 1) lets lights and caustics burn out as on film instead of into flat colour. Negative components are shown as zero
/// (the film counts them; see EventCounts and compareImages).
Vec3d toneCurve(const Vec3f& linear);

/// The sRGB encoding (IEC 61966-2-1) of a display-linear value in [0,1].
double encodeSrgb(double displayLinear);
/// The same, rounded to 8 bits.
uint8_t encodeSrgb8(double displayLinear);

/// The 8-bit sRGB pixel of linear RGB: through the tone curve where it is finite, magenta where it is not, so that a
/// broken pixel is seen.
std::array<uint8_t, 3> displayPixel(const Vec3f& linear);
/// The same of 16 bits a channel.
std::array<uint16_t, 3> displayPixel16(const Vec3f& linear);

}  // namespace antipode
