#include "renderengine/layers.h"

namespace antipode {

const std::vector<LayerInfo>& layerTable() {
    static const std::vector<LayerInfo> table{
        {LayerKind::EmitterHit, "emitter-hit", "emitter_hit", "RGB", "light from emitters that camera paths meet"},
        {LayerKind::NextEvent, "next-event", "next_event", "RGB", "light from points drawn on the lights"},
        {LayerKind::Connection, "connection", "connection", "RGB", "light from connected light vertices"},
        {LayerKind::Merge, "merge", "merge", "RGB", "light from merged light vertices"},
        {LayerKind::Splat, "splat", "splat", "RGB", "light that light paths bring to the camera"},
        {LayerKind::Albedo, "albedo", "albedo", "RGB", "reflectance of the guides' surface"},
        {LayerKind::Normal, "N", "N", "XYZ", "its shading normal, towards the viewer"},
        {LayerKind::Depth, "Z", "", "Z", "its depth along the camera's direction"},
        {LayerKind::Position, "P", "P", "XYZ", "its position"},
        {LayerKind::Coverage, "coverage", "coverage", "A", "share of the iterations that met it"},
    };
    return table;
}

std::string name(LayerSet layers) {
    std::string text;
    for (const LayerInfo& layer : layerTable()) {
        if (!layers.has(layer.kind)) continue;
        if (!text.empty()) text += ',';
        text += layer.option;
    }
    return text.empty() ? "none" : text;
}

}  // namespace antipode
