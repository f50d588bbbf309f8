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

uint32_t FilmLayout::count(LayerKind kind) const {
    return uint32_t(std::ranges::count(layers, kind, &FilmLayer::kind));
}

size_t FilmLayout::find(LayerKind kind) const {
    return size_t(std::ranges::find(layers, kind, &FilmLayer::kind) - layers.begin());
}

std::vector<uint64_t> FilmLayout::residueCounts(const IterationRange& range) const {
    const uint32_t classes = residueClasses();
    if (classes <= 1) return {};
    std::vector<uint64_t> counts;
    for (uint32_t k = 0; k < classes; ++k) {
        const auto below = [&](uint64_t end) { return end / classes + (end % classes > k ? 1 : 0); };
        counts.push_back(below(range.end()) - below(range.first));
    }
    return counts;
}

bool FilmLayout::sameLayers(const FilmLayout& other) const {
    return width == other.width && height == other.height &&
           std::ranges::equal(layers, other.layers, [](const FilmLayer& a, const FilmLayer& b) {
               return a.kind == b.kind && a.name == b.name && a.channels == b.channels;
           });
}

FilmLayout inClasses(const FilmLayout& layout, uint32_t classes) {
    FilmLayout parted{layout.width, layout.height, {}};
    const std::vector<size_t> last = placesInClasses(layout, classes, classes - 1);
    for (size_t i = 0; i < last.size(); ++i) parted.layers.resize(last[i] + 1, layout.layers[i]);
    return parted;
}

std::vector<size_t> placesInClasses(const FilmLayout& layout, uint32_t classes, uint32_t own) {
    std::vector<size_t> places;
    size_t next = 0;
    for (const FilmLayer& layer : layout.layers) {
        const bool parted = layer.kind == LayerKind::Image || layer.kind == LayerKind::Blur;
        places.push_back(next + (parted ? own : 0));
        next += parted ? classes : 1;
    }
    return places;
}

FilmLayout filmLayout(const RenderSettings& settings) {
    const PixelWindow window = filmWindow(settings);
    FilmLayout layout{window.width(), window.height(), {}};
    const uint32_t classes = settings.residueClasses.value_or(1);
    for (uint32_t k = 0; k < classes; ++k)
        layout.layers.push_back({LayerKind::Image, classes == 1 ? "" : "residue" + std::to_string(k), "RGB", 0});
    LayerSet asked = settings.layers;
    for (const LayerInfo& layer : layerTable())
        if (layer.unit == LayerUnit::Length && asked.has(layer.kind)) asked.add(LayerKind::Coverage);
    for (const LayerInfo& layer : layerTable())
        if (asked.has(layer.kind)) layout.layers.push_back({layer.kind, layer.name, layer.channels, 0});
    return layout;
}

int32_t filmScaleExponent(double greatest) { return std::min(42 - int32_t(std::ceil(std::log2(greatest))), 126); }

}  // namespace antipode
