#include "scene/collada_document.h"

#include <cmath>
#include <numbers>
#include <pugixml.hpp>
#include <sstream>
#include <string_view>
#include <vector>

#include "renderengine/error.h"
#include "renderengine/io/files.h"

namespace antipode {
namespace {

using pugi::xml_node;

constexpr double kDegree = std::numbers::pi / 180;

/// Every element, in the file's order; a loop, since files nest as deep as they like.
template <class Visit>
void visitAll(const xml_node& root, Visit visit) {
    for (xml_node node = root; node;) {
        visit(node);
        if (xml_node child = node.first_child()) {
            node = child;
            continue;
        }
        while (node && node != root && !node.next_sibling()) node = node.parent();
        node = node == root ? xml_node() : node.next_sibling();
    }
}

bool is(const xml_node& node, std::string_view name) { return node.name() == name; }

std::optional<double> number(const xml_node& node) {
    if (!node) return {};
    std::istringstream text(node.text().get());
    double value = 0;
    if (!(text >> value) || !std::isfinite(value)) return {};
    return value;
}

std::optional<Vec3f> color(const xml_node& node) {
    if (!node) return {};
    std::istringstream text(node.text().get());
    Vec3f c;
    if (!(text >> c.x >> c.y >> c.z) || !isFinite(c)) return {};
    return c;
}

/// What an <instance_…> points to: "#id" in this file.
std::string target(const xml_node& instance) {
    const std::string_view url = instance.attribute("url").value();
    return url.starts_with('#') ? std::string(url.substr(1)) : std::string();
}

/// As Assimp calls a node: by its name, else its id, else its sid.
std::string nameOf(const xml_node& node) {
    for (const char* attribute : {"name", "id", "sid"})
        if (const char* value = node.attribute(attribute).value(); *value) return value;
    return {};
}

}  // namespace

struct ColladaDocument::Tree {
    pugi::xml_document document;
    std::map<std::string, xml_node> byId, materials, nodes;
    bool byBlender = false;

    /// What hangs on the node: <light>, <camera>; an empty one where it has none.
    xml_node instance(const std::string& node, const char* kind) const {
        const auto found = nodes.find(node);
        return found == nodes.end() ? xml_node() : find(target(found->second.child(kind)));
    }
    xml_node find(const std::string& id) const {
        const auto found = byId.find(id);
        return found == byId.end() ? xml_node() : found->second;
    }
};

ColladaDocument::ColladaDocument(const std::string& path) : tree_(std::make_unique<Tree>()) {
    const std::vector<uint8_t> bytes = readFileBytes(path);
    const pugi::xml_parse_result parsed =
        tree_->document.load_buffer(bytes.data(), bytes.size(), pugi::parse_default | pugi::parse_trim_pcdata);
    if (!parsed)
        throw Error(ErrorCode::Input, "it is not well-formed XML: " + std::string(parsed.description()) + " at byte " +
                                          std::to_string(parsed.offset));
    std::ostringstream text;
    tree_->document.save(text, "", pugi::format_raw);
    text_ = text.str();
    visitAll(tree_->document, [&](const xml_node& node) {
        if (const char* id = node.attribute("id").value(); *id) tree_->byId.emplace(id, node);
        if (is(node, "material")) {
            tree_->materials.emplace(node.attribute("id").value(), node);
            tree_->materials.emplace(node.attribute("name").value(), node);
        }
        if (is(node, "node") && (node.child("instance_light") || node.child("instance_camera")))
            tree_->nodes.emplace(nameOf(node), node);
        if (is(node, "authoring_tool"))
            tree_->byBlender |= std::string_view(node.text().get()).find("Blender") != std::string_view::npos;
    });
}

ColladaDocument::~ColladaDocument() = default;

std::optional<ColladaSpot> ColladaDocument::spot(const std::string& node) const {
    const xml_node light = tree_->instance(node, "instance_light");
    const xml_node common = light.child("technique_common").child("spot");
    if (!common) return {};
    const double angle = number(common.child("falloff_angle")).value_or(180) * kDegree;
    const double outer = std::min(tree_->byBlender ? angle / 2 : angle, std::numbers::pi);
    double soft = 0;
    for (const xml_node& technique : light.child("extra").children("technique"))
        if (std::string_view(technique.attribute("profile").value()) == "blender")
            soft = number(technique.child("spotblend")).value_or(0);
    return ColladaSpot{outer, outer * (1 - std::clamp(soft, 0.0, 1.0))};
}

std::optional<ColladaLens> ColladaDocument::lens(const std::string& node) const {
    const xml_node common = tree_->instance(node, "instance_camera").child("optics").child("technique_common");
    if (!common) return {};
    const xml_node perspective = common.child("perspective");
    if (const xml_node parallel = common.child("orthographic")) {
        // Half of what is seen.
        const auto xmag = number(parallel.child("xmag")), ymag = number(parallel.child("ymag"));
        const double told = number(parallel.child("aspect_ratio")).value_or(0);
        const double aspect = told > 0 ? told : xmag && ymag && *ymag > 0 ? *xmag / *ymag : 0;
        const double halfHeight = ymag ? *ymag : xmag && aspect > 0 ? *xmag / aspect : xmag.value_or(0);
        return ColladaLens{0, aspect, 2 * std::abs(halfHeight)};
    }
    const auto xfov = number(perspective.child("xfov")), yfov = number(perspective.child("yfov"));
    ColladaLens lens{0, number(perspective.child("aspect_ratio")).value_or(0)};
    if (yfov) {
        lens.verticalFov = *yfov * kDegree;
        if (xfov) lens.aspect = std::tan(*xfov * kDegree / 2) / std::tan(lens.verticalFov / 2);
    } else if (xfov) {
        lens.verticalFov = 2 * std::atan(std::tan(*xfov * kDegree / 2) / (lens.aspect > 0 ? lens.aspect : 1));
    }
    return lens;
}

std::optional<ColladaHighlight> ColladaDocument::highlight(const std::string& material) const {
    const auto found = tree_->materials.find(material);
    if (found == tree_->materials.end()) return {};
    const xml_node common =
        tree_->find(target(found->second.child("instance_effect"))).child("profile_COMMON").child("technique");
    ColladaHighlight highlight;
    for (const char* model : {"phong", "blinn"}) {
        const xml_node shader = common.child(model);
        if (!shader) continue;
        highlight.specular = color(shader.child("specular").child("color")).value_or(Vec3f{});
        highlight.exponent = float(number(shader.child("shininess").child("float")).value_or(0));
    }
    return highlight;
}

}  // namespace antipode
