// The names of the steps and the equations' numbers are those of Andersson et al. 2020.
#include "renderengine/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "film/tone_curve.h"
#include "renderengine/error.h"

namespace antipode {
namespace {

constexpr double pi = std::numbers::pi;

/// One number per pixel, with the border's repeated beyond it.
struct Plane {
    int width, height;
    std::vector<double> values;

    double& at(int x, int y) { return values[size_t(y) * size_t(width) + size_t(x)]; }
    double clamped(int x, int y) const {
        return values[size_t(std::clamp(y, 0, height - 1)) * size_t(width) + size_t(std::clamp(x, 0, width - 1))];
    }
};
using Planes = std::array<Plane, 3>;

/// Weights at −radius … radius.
using Kernel = std::vector<double>;

/// The outer product of two kernels, applied.
Plane filtered(const Plane& image, const Kernel& alongX, const Kernel& alongY) {
    Plane across = image, result = image;
    const int radius = int(alongX.size() / 2);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            double sum = 0;
            for (size_t k = 0; k < alongX.size(); ++k) sum += alongX[k] * image.clamped(x + int(k) - radius, y);
            across.at(x, y) = sum;
        }
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            double sum = 0;
            for (size_t k = 0; k < alongY.size(); ++k) sum += alongY[k] * across.clamped(x, y + int(k) - radius);
            result.at(x, y) = sum;
        }
    return result;
}

double sum(const Kernel& kernel) {
    double total = 0;
    for (const double weight : kernel) total += weight;
    return total;
}

/// exp(−x²/(2σ²)) by pixels.
Kernel gaussian(double sigma, int radius) {
    Kernel kernel;
    for (int x = -radius; x <= radius; ++x) kernel.push_back(std::exp(-double(x) * x / (2 * sigma * sigma)));
    return kernel;
}

// CIE XYZ of linear Rec. 709 and D65, which white is by these numbers.
constexpr double toXyz[3][3] = {{10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
                                {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
                                {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}};

Vec3d xyzOverWhite(const Vec3d& rgb) {
    double xyz[3];
    for (int row = 0; row < 3; ++row)
        xyz[row] = (toXyz[row][0] * rgb.x + toXyz[row][1] * rgb.y + toXyz[row][2] * rgb.z) /
                   (toXyz[row][0] + toXyz[row][1] + toXyz[row][2]);
    return {xyz[0], xyz[1], xyz[2]};
}

Vec3d toYCxCz(const Vec3d& rgb) {
    const Vec3d xyz = xyzOverWhite(rgb);
    return {116 * xyz.y - 16, 500 * (xyz.x - xyz.y), 200 * (xyz.y - xyz.z)};
}

/// The inverse of toXyz by Cramer's rule, on XYZ over white's.
Vec3d fromYCxCz(const Vec3d& ycc) {
    const double y = (ycc.x + 16) / 116, relative[3] = {y + ycc.y / 500, y, y - ycc.z / 200};
    Vec3d columns[3], xyz;
    for (int c = 0; c < 3; ++c) columns[c] = {toXyz[0][c], toXyz[1][c], toXyz[2][c]};
    const auto white = [](int row) { return toXyz[row][0] + toXyz[row][1] + toXyz[row][2]; };
    xyz = {relative[0] * white(0), relative[1] * white(1), relative[2] * white(2)};
    const double determinant = dot(columns[0], cross(columns[1], columns[2]));
    return Vec3d{dot(xyz, cross(columns[1], columns[2])), dot(columns[0], cross(xyz, columns[2])),
                 dot(columns[0], cross(columns[1], xyz))} *
           (1 / determinant);
}

/// CIELAB with the Hunt effect: chroma counts for less where it is dark.
Vec3d toHuntLab(const Vec3d& rgb) {
    constexpr double delta = 6.0 / 29;
    const auto f = [](double t) {
        return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
    };
    const Vec3d xyz = xyzOverWhite(rgb);
    const double lightness = 116 * f(xyz.y) - 16, hunt = 0.01 * lightness;
    return {lightness, hunt * 500 * (f(xyz.x) - f(xyz.y)), hunt * 200 * (f(xyz.y) - f(xyz.z))};
}

/// The distance that fits large differences (Abasi et al. 2020), to the power 0.7.
double hyAb(const Vec3d& p, const Vec3d& q) {
    return std::pow(std::abs(p.x - q.x) + std::hypot(p.y - q.y, p.z - q.z), 0.7);
}

/// To [0, 1]: the lower 40 % of the range take 95 of it, as larger differences are all alike.
double redistributed(double distance) {
    static const double most = hyAb(toHuntLab({0, 1, 0}), toHuntLab({0, 0, 1}));
    constexpr double knee = 0.4, kneeShown = 0.95;
    if (distance < knee * most) return kneeShown / (knee * most) * distance;
    return kneeShown + (distance - knee * most) / (most - knee * most) * (1 - kneeShown);
}

/// What is shown of the image, in YCxCz.
Planes opponentColours(const Image& image) {
    Planes planes;
    for (Plane& plane : planes) plane = {int(image.width), int(image.height), {}};
    for (const Vec3f& pixel : image.pixels) {
        const Vec3d ycc = toYCxCz(isFinite(pixel) ? toneCurve(pixel) : Vec3d(1, 0, 1));
        planes[0].values.push_back(ycc.x), planes[1].values.push_back(ycc.y), planes[2].values.push_back(ycc.z);
    }
    return planes;
}

/// As the eye resolves it: contrast sensitivity functions as sums of Gaussians (eq. 4 and table 1), in 1/degree.
Planes seen(const Planes& image) {
    struct Term {
        double a, b;
    };
    static constexpr Term sensitivity[3][2] = {
        {{1, 0.0047}, {0, 1e-5}}, {{1, 0.0053}, {0, 1e-5}}, {{34.1, 0.04}, {13.5, 0.025}}};
    const double widest = std::sqrt(0.04 / (2 * pi * pi));
    const int radius = int(std::ceil(3 * widest * flipPixelsPerDegree));
    Planes result = image;
    for (size_t channel = 0; channel < 3; ++channel) {
        std::fill(result[channel].values.begin(), result[channel].values.end(), 0.0);
        double total = 0;
        for (const Term& term : sensitivity[channel]) {
            if (term.a == 0) continue;
            const Kernel kernel = gaussian(std::sqrt(term.b / (2 * pi * pi)) * flipPixelsPerDegree, radius);
            const double weight = term.a * std::sqrt(pi / term.b);
            total += weight * sum(kernel) * sum(kernel);
            const Plane part = filtered(image[channel], kernel, kernel);
            for (size_t i = 0; i < part.values.size(); ++i) result[channel].values[i] += weight * part.values[i];
        }
        for (double& value : result[channel].values) value /= total;
    }
    return result;
}

/// How much of an edge (first derivative) or of a point (second) each pixel is, by luminance.
struct Features {
    std::vector<double> edges, points;
};

Features features(const Plane& luminance) {
    const double sigma = 0.5 * 0.082 * flipPixelsPerDegree;
    const int radius = int(std::ceil(3 * sigma));
    Kernel smooth = gaussian(sigma, radius), edge, point;
    for (const double weight : smooth) {
        const double x = double(edge.size()) - radius;
        edge.push_back(-x * weight);
        point.push_back((x * x / (sigma * sigma) - 1) * weight);
    }
    const double mass = sum(smooth);
    for (double& weight : smooth) weight /= mass;
    for (Kernel* kernel : {&edge, &point}) {  // positive weights sum to 1, negative ones to −1
        double positive = 0, negative = 0;
        for (const double weight : *kernel) (weight > 0 ? positive : negative) += weight;
        for (double& weight : *kernel) weight /= weight > 0 ? positive : -negative;
    }
    Plane grey = luminance;
    for (double& value : grey.values) value = (value + 16) / 116;
    const auto magnitude = [&](const Kernel& kernel) {
        const Plane x = filtered(grey, kernel, smooth), y = filtered(grey, smooth, kernel);
        std::vector<double> values;
        for (size_t i = 0; i < x.values.size(); ++i) values.push_back(std::hypot(x.values[i], y.values[i]));
        return values;
    };
    return {magnitude(edge), magnitude(point)};
}

Vec3d shownLab(const Planes& planes, size_t i) {
    Vec3d rgb = fromYCxCz({planes[0].values[i], planes[1].values[i], planes[2].values[i]});
    rgb = {std::clamp(rgb.x, 0.0, 1.0), std::clamp(rgb.y, 0.0, 1.0), std::clamp(rgb.z, 0.0, 1.0)};
    return toHuntLab(rgb);
}

}  // namespace

std::vector<float> flipErrors(const Image& a, const Image& b) {
    if (a.width != b.width || a.height != b.height) throw Error(ErrorCode::Usage, "FLIP takes images of one size.");
    const Planes coloursA = opponentColours(a), coloursB = opponentColours(b);
    const Planes seenA = seen(coloursA), seenB = seen(coloursB);
    const Features featuresA = features(coloursA[0]), featuresB = features(coloursB[0]);
    std::vector<float> errors;
    for (size_t i = 0; i < a.pixels.size(); ++i) {
        const double colour = redistributed(hyAb(shownLab(seenA, i), shownLab(seenB, i)));
        const double feature = std::sqrt(std::max(std::abs(featuresA.edges[i] - featuresB.edges[i]),
                                                  std::abs(featuresA.points[i] - featuresB.points[i])) /
                                         std::numbers::sqrt2);
        errors.push_back(float(std::pow(colour, 1 - feature)));
    }
    return errors;
}

}  // namespace antipode
