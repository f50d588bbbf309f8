#include "film/class_smoother.h"

namespace antipode {

namespace {

constexpr double shrinkage = 2;  // λ, see film/relative_weights.cpp

}  // namespace

ClassSmoother::ClassSmoother(const FilmLayout& layout, const ClassContrasts& contrasts, uint32_t channels)
    : layout_(layout), contrasts_(contrasts), channels_(channels) {
    const uint64_t pixels = layout.pixels();
    for (uint64_t p = 0; p < pixels; ++p)
        for (uint32_t c = 0; c < channels_; ++c) {
            const Means means = contrasts.means(channels_ * p + c);
            for (uint32_t k = 0; k < contrasts.classes(); ++k) image_[c][k] += means[k] / double(pixels);
        }
}

void ClassSmoother::sumUp(uint32_t left, uint32_t top, uint32_t right, uint32_t bottom) {
    left_ = left, top_ = top, stride_ = right - left + 1;
    sums_.assign(size_t(stride_) * (bottom - top + 1), Cell{});
    for (uint32_t y = top; y < bottom; ++y)
        for (uint32_t x = left; x < right; ++x)
            for (uint32_t c = 0; c < channels_; ++c) {
                const Means means = contrasts_.means(channels_ * (size_t(y) * layout_.width + x) + c);
                for (uint32_t k = 0; k < contrasts_.classes(); ++k)
                    at(x + 1, y + 1)[c][k] = means[k] + at(x, y + 1)[c][k] + at(x + 1, y)[c][k] - at(x, y)[c][k];
            }
}

ClassSmoother::Means ClassSmoother::means(uint32_t x, uint32_t y, uint32_t radius, uint32_t c) const {
    const uint32_t x0 = x > radius ? x - radius : 0, x1 = std::min(x + radius + 1, layout_.width);
    const uint32_t y0 = y > radius ? y - radius : 0, y1 = std::min(y + radius + 1, layout_.height);
    const double pixels = double(x1 - x0) * (y1 - y0);
    Means means{};
    for (uint32_t k = 0; k < contrasts_.classes(); ++k)
        means[k] = (at(x1, y1)[c][k] - at(x0, y1)[c][k] - at(x1, y0)[c][k] + at(x0, y0)[c][k]) / pixels;
    return means;
}

ClassSmoother::Detail ClassSmoother::detailOf(uint32_t x, uint32_t y, uint32_t radius,
                                              std::array<Means, 3>& coarse) const {
    Detail detail;
    for (uint32_t c = 0; c < channels_; ++c) {
        const Means fine = means(x, y, radius, c);
        double mean = 0;
        for (uint32_t k = 0; k < contrasts_.classes(); ++k) {
            detail.classes[c][k] = fine[k] - coarse[c][k];
            mean += contrasts_.iterations(k) * detail.classes[c][k] / contrasts_.iterations();
        }
        detail.noise[c] = contrasts_.variance(detail.classes[c]);
        detail.size += mean * mean, detail.noises += detail.noise[c];
        coarse[c] = fine;
    }
    return detail;
}

void ClassSmoother::addDetails(uint32_t x, uint32_t y, std::span<const float> weights, Kept& sizes,
                               Kept& noises) const {
    std::array<Means, 3> coarse = image_;
    for (size_t i = 0; i < radii.size(); ++i) {
        const Detail detail = detailOf(x, y, radii[i], coarse);
        const double weight = double(weights[size_t(y) * layout_.width + x]);
        sizes[i] += weight * detail.size;
        noises[i] += weight * detail.noises;
    }
}

Smooth ClassSmoother::smooth(uint32_t x, uint32_t y, const Kept* kept) const {
    Smooth smooth{image_, {}};
    for (uint32_t c = 0; c < channels_; ++c) smooth.variance[c] = contrasts_.variance(image_[c]);
    std::array<Means, 3> coarse = image_;
    for (size_t i = 0; i < radii.size(); ++i) {
        const Detail detail = detailOf(x, y, radii[i], coarse);
        const double own = detail.size > 0 ? std::max(1 - shrinkage * detail.noises / detail.size, 0.0) : 0;
        const double part = kept ? (*kept)[i] : own;
        for (uint32_t c = 0; c < channels_; ++c) {
            for (uint32_t k = 0; k < contrasts_.classes(); ++k) smooth.classes[c][k] += part * detail.classes[c][k];
            smooth.variance[c] += part * part * detail.noise[c];
        }
    }
    return smooth;
}

}  // namespace antipode
