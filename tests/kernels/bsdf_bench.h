// One tilted triangle for every material, and lib/bsdf.glsl evaluated and sampled on them.
#pragma once

#include <string>

#include "support/reference/geometry.h"
#include "tests/kernels/kernel_harness.h"

namespace antipode {

struct BsdfCase {
    std::string name;
    Material material;
    double lobeWidth = 1;  ///< angle, in radians, that the narrowest reflected lobe spans; 1 for wide ones
    bool transmits = false;
    double relativeLobeWidthBeyond = 1;  ///< of the refracted lobe, to the reflected one

    /// Index of refraction behind the surface, where what passes is bent.
    double indexBehind() const { return transmits && !material.thin ? double(material.ior) : 1; }
};

/// Every kind that is not specular alone, over its parameters' ranges.
const std::vector<BsdfCase>& bsdfCases();
/// The specular kinds.
const std::vector<BsdfCase>& specularCases();

struct BsdfValue {
    Vec3d value;
    double pdf, reversePdf;
};

struct DrawnBsdf {
    Vec3d direction, value;
    double pdf, reversePdf;
    bool valid, specular, zeroPdf;
};

/// Directions in and out are local: z is the front normal. The kernels see them rounded in world space, and the bench
/// hands out what they see: `rounded` gives the direction that is used for another one.
class BsdfBench {
public:
    BsdfBench(Device& device, const std::vector<BsdfCase>& cases);

    std::vector<BsdfValue> eval(size_t index, const std::vector<Vec3d>& known, const std::vector<Vec3d>& next,
                                bool adjoint = false);
    std::vector<DrawnBsdf> sample(size_t index, const Vec3d& known, const std::vector<Texel>& u, bool adjoint = false);

    Vec3d rounded(const Vec3d& local) const { return normalize(frame_.toLocal(Vec3d(Vec3f(frame_.toWorld(local))))); }

private:
    Texel world(const Vec3d& local, float w) const { return texel(Vec3f(frame_.toWorld(local)), w); }

    reference::Frame frame_;
    PackedScene packed_;
    std::vector<uint32_t> primitive_;  ///< of each case
    KernelHarness harness_;
};

/// Local direction of cosine c to the normal, at an odd azimuth.
Vec3d atCosine(double c);

}  // namespace antipode
