#include "scene/gltf/pose.h"

#include <algorithm>
#include <cmath>

#include "scene/gltf/accessors.h"

namespace antipode::gltf {
namespace {

using Numbers = std::vector<double>;

Numbers slerp(const Numbers& a, Numbers b, double s) {
    double cosine = 0;
    for (size_t i = 0; i < 4; ++i) cosine += a[i] * b[i];
    if (cosine < 0) {  // the shorter way
        for (double& x : b) x = -x;
        cosine = -cosine;
    }
    const double angle = std::acos(std::min(cosine, 1.0));
    const double sine = std::sin(angle);
    const double wa = sine > 1e-6 ? std::sin((1 - s) * angle) / sine : 1 - s;
    const double wb = sine > 1e-6 ? std::sin(s * angle) / sine : s;
    for (size_t i = 0; i < 4; ++i) b[i] = wa * a[i] + wb * b[i];
    return b;
}

/// The values of an animation's sampler.
class Sampler {
public:
    Sampler(const Document& document, const json& from, bool isRotation)
        : isRotation_(isRotation), interpolation_(from.value("interpolation", "LINEAR")) {
        times_ = readFloats(document, natural(from.at("input")), 1).numbers;
        values_ = readFloats(document, natural(from.at("output"))).numbers;
        const size_t keys = times_.size() * (isCubic() ? 3 : 1);
        width_ = keys == 0 ? 0 : values_.size() / keys;
        if (width_ == 0 || width_ * keys != values_.size() || !std::is_sorted(times_.begin(), times_.end()))
            fail("an animation's times and values do not agree");
    }

    Numbers at(double seconds) const {
        const size_t next = size_t(std::upper_bound(times_.begin(), times_.end(), seconds) - times_.begin());
        if (next == 0) return value(0);
        if (next == times_.size() || interpolation_ == "STEP") return value(next - 1);
        const double length = double(times_[next]) - double(times_[next - 1]);
        const double s = (seconds - double(times_[next - 1])) / length;
        const Numbers a = value(next - 1), b = value(next);
        if (isCubic()) return hermite(a, tangent(next - 1, 2), b, tangent(next, 0), s, length);
        if (isRotation_ && width_ == 4) return slerp(a, b, s);
        Numbers mixed(width_);
        for (size_t i = 0; i < width_; ++i) mixed[i] = (1 - s) * a[i] + s * b[i];
        return mixed;
    }

private:
    bool isCubic() const { return interpolation_ == "CUBICSPLINE"; }
    /// Of a cubic spline, a key has three entries: the tangent that leads to it, its value, the tangent that leaves it.
    Numbers tangent(size_t key, size_t part) const { return row(3 * key + part); }
    Numbers value(size_t key) const { return row(isCubic() ? 3 * key + 1 : key); }
    Numbers row(size_t index) const {
        const auto begin = values_.begin() + std::ptrdiff_t(index * width_);
        return {begin, begin + std::ptrdiff_t(width_)};
    }
    static Numbers hermite(const Numbers& a, const Numbers& leaving, const Numbers& b, const Numbers& arriving,
                           double s, double length) {
        const double s2 = s * s, s3 = s2 * s;
        Numbers mixed(a.size());
        for (size_t i = 0; i < a.size(); ++i)
            mixed[i] = (2 * s3 - 3 * s2 + 1) * a[i] + length * (s3 - 2 * s2 + s) * leaving[i] +
                       (3 * s2 - 2 * s3) * b[i] + length * (s3 - s2) * arriving[i];
        return mixed;
    }

    bool isRotation_;
    std::string interpolation_;
    std::vector<float> times_, values_;
    size_t width_ = 0;
};

template <size_t n>
std::array<double, n> exactly(const Numbers& numbers) {
    if (numbers.size() != n) fail("an animation has the wrong number of values for what it moves");
    std::array<double, n> values;
    std::copy(numbers.begin(), numbers.end(), values.begin());
    return values;
}

}  // namespace

std::map<size_t, NodePose> poseAt(const Document& document, double seconds, std::vector<std::string>& notices) {
    const json& animations = list(document.json, "animations");
    if (animations.empty()) return {};
    if (animations.size() > 1)
        notices.push_back("The file has " + std::to_string(animations.size()) + " animations; the first, '" +
                          nameOf(animations[0], "animation", 0) + "', is shown.");
    std::map<size_t, NodePose> poses;
    for (const json& channel : list(animations[0], "channels")) {
        const json& target = object(channel, "target");
        const auto node = reference(target, "node");
        if (!node) continue;
        entry(document.json, "nodes", *node);
        const auto path = target.at("path").get<std::string>();
        const json& sampler = entry(animations[0], "samplers", natural(channel.at("sampler")));
        const Numbers now = Sampler(document, sampler, path == "rotation").at(seconds);
        NodePose& pose = poses[*node];
        if (path == "translation")
            pose.translation = exactly<3>(now);
        else if (path == "scale")
            pose.scale = exactly<3>(now);
        else if (path == "rotation")
            pose.rotation = exactly<4>(now);
        else if (path == "weights")
            pose.weights = now;
        else
            notices.push_back("Animation '" + nameOf(animations[0], "animation", 0) + "' moves '" + path +
                              "', which is ignored.");
    }
    return poses;
}

}  // namespace antipode::gltf
