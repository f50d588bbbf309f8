#include "renderengine/film_layout.h"

#include <algorithm>
#include <cmath>

namespace antipode {
namespace {

uint64_t channelsOf(const FilmLayout& layout, size_t layers) {
    uint64_t channels = 0;
    for (size_t i = 0; i < layers; ++i) channels += layout.layers[i].channels.size();
    return channels;
}

}  // namespace

uint64_t FilmLayout::channels() const { return channelsOf(*this, layers.size()); }

uint64_t FilmLayout::offset(size_t layer) const { return pixels() * channelsOf(*this, layer); }

bool FilmLayout::sameLayers(const FilmLayout& other) const {
    return width == other.width && height == other.height &&
           std::ranges::equal(layers, other.layers, [](const FilmLayer& a, const FilmLayer& b) {
               return a.name == b.name && a.channels == b.channels;
           });
}

FilmLayout filmLayout(const RenderSettings& settings) { return {settings.width, settings.height, {{"", "RGB", 0}}}; }

int32_t filmScaleExponent(double greatest) { return std::min(42 - int32_t(std::ceil(std::log2(greatest))), 126); }

}  // namespace antipode
