#include "renderengine/layers.h"

namespace antipode {

const std::vector<LayerInfo>& layerTable() {
    using enum LayerUnit;
    static const std::vector<LayerInfo> table{
        {LayerKind::EmitterHit, "emitter-hit", "emitter_hit", "RGB", Radiance,
         "light from emitters that camera paths meet"},
        {LayerKind::NextEvent, "next-event", "next_event", "RGB", Radiance, "light from points drawn on the lights"},
        {LayerKind::Connection, "connection", "connection", "RGB", Radiance, "light from connected light vertices"},
        {LayerKind::Merge, "merge", "merge", "RGB", Radiance, "light from merged light vertices"},
        {LayerKind::Splat, "splat", "splat", "RGB", Radiance, "light that light paths bring to the camera"},
        {LayerKind::Albedo, "albedo", "albedo", "RGB", None, "reflectance of the guides' surface"},
        {LayerKind::Normal, "N", "N", "XYZ", None, "its shading normal, towards the viewer"},
        {LayerKind::Depth, "Z", "", "Z", Length, "its depth along the camera's direction"},
        {LayerKind::Position, "P", "P", "XYZ", Length, "its position"},
        {LayerKind::Coverage, "coverage", "coverage", "A", None, "share of the iterations that met it"},
        {LayerKind::Blur, "bias", "bias", "Y", Radiance, "what merging blurs, estimated: luminance above the true one"},
    };
    return table;
}

LayerUnit unitOf(LayerKind kind) {
    return kind == LayerKind::Image ? LayerUnit::Radiance : layerTable()[size_t(kind)].unit;
}

std::string name(LayerSet layers) { return namesOf(layers, layerTable()); }

}  // namespace antipode
