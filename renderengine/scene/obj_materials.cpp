#include "scene/obj_materials.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string_view>

#include "renderengine/io/files.h"
#include "scene/classic_lobes.h"
#include "scene/mtl_textures.h"

namespace antipode {
namespace {

/// What `illum` asks for (MTL specification). 10 casts shadows onto an invisible surface.
enum Illumination {
    kDiffuse = 1,
    kHighlight = 2,
    kReflection = 3,
    kGlass = 4,
    kFresnelReflection = 5,
    kRefraction = 6,
    kFresnelRefraction = 7,
    kGlassWithoutRays = 9
};

bool isBlack(const Vec3f& c) { return c == Vec3f{}; }

/// The entry's word on what light does at the surface.
class Reader {
public:
    Reader(const std::string& name, const MtlMaterial& entry, TextureTable& textures, std::vector<std::string>& notices)
        : entry_(entry), textures_(textures), notices_(notices) {
        m_.name = name;
    }

    Material run() {
        readColors();
        readMaps();
        chooseKind();
        readDissolve();
        sayWhatIsLeft();
        return std::move(m_);
    }

private:
    void note(const std::string& sentence) { notices_.push_back("Material '" + m_.name + "': " + sentence); }

    void readColors() {
        const bool textured = bool(entry_.map("map_kd"));
        m_.baseColor = entry_.color("kd").value_or(Vec3f(textured ? 1.0f : kDefaultGrey));
        specular_ = entry_.color("ks").value_or(Vec3f{});
        m_.emission = entry_.color("ke").value_or(Vec3f{});
        // map_Ke stands without a factor as often as with one.
        if (entry_.map("map_ke") && isBlack(m_.emission)) m_.emission = Vec3f(1.0f);
        illum_ = int(entry_.number("illum").value_or(kHighlight));
        ior_ = entry_.number("ni").value_or(1.0f);
        exponent_ = std::max(0.0f, entry_.number("ns").value_or(0.0f));
    }

    void readMaps() {
        m_.baseColorTexture = colorMap(entry_.map("map_kd"), entry_.map("map_d"), textures_);
        m_.emissionTexture = colorMap(entry_.map("map_ke"), {}, textures_);
        if (const MtlMap& map = entry_.map("norm"))
            m_.normalTexture = textures_.findFile(map.file, samplingOf(map, TextureUse::Data));
        else if (entry_.map("bump"))
            m_.normalTexture = bumpMap(entry_.map("bump"), textures_);
        if (const MtlMap& map = entry_.map("map_ks")) {
            const MeanColor mean = meanColor(map, textures_);
            specular_ = (entry_.color("ks") ? specular_ : Vec3f(1.0f)) * mean.color;
            if (mean.varies) note("map_Ks counts by its mean.");
        }
    }

    void chooseKind() {
        const bool physicallyBased =
            entry_.number("pr") || entry_.number("pm") || entry_.map("map_pr") || entry_.map("map_pm");
        const float d = entry_.number("d").value_or(1.0f);
        const bool seeThrough = entry_.color("tf").has_value() || d < 0.5f;
        if (illum_ == kRefraction || illum_ == kFresnelRefraction ||
            ((illum_ == kGlass || illum_ == kGlassWithoutRays) && seeThrough) || (d < 0.5f && ior_ > 1)) {
            makeGlass();
        } else if (physicallyBased) {
            makePhysicallyBased();
        } else if (illum_ == kFresnelReflection) {
            makeCoated();
        } else if (illum_ == kReflection && isBlack(m_.baseColor)) {
            m_.kind = MaterialKind::Mirror;
            m_.specular = specular_;
        } else if (!isBlack(specular_) && illum_ != 0 && illum_ != kDiffuse) {
            makePhong(m_, specular_, exponent_, notices_);
        }
    }

    void makeGlass() {
        makeDielectric(m_, ior_, notices_);
        const Vec3f filter = entry_.color("tf").value_or(Vec3f(1.0f));
        if (filter == Vec3f(1.0f)) return;
        m_.kind = MaterialKind::MetallicRoughness;  // the glass that has a colour
        m_.roughness = 0;
        m_.transmission = 1;
        for (int c = 0; c < 3; ++c) m_.baseColor[c] = std::clamp(filter[c], 0.0f, 1.0f);
    }

    void makePhysicallyBased() {
        const bool roughnessMapped = bool(entry_.map("map_pr")), metallicMapped = bool(entry_.map("map_pm"));
        m_.roughness =
            std::clamp(entry_.number("pr").value_or(roughnessMapped ? 1.0f : roughnessOfExponent()), 0.f, 1.f);
        m_.metallic = std::clamp(entry_.number("pm").value_or(metallicMapped ? 1.0f : 0.0f), 0.0f, 1.0f);
        if (ior_ > 1) m_.ior = ior_;
        m_.specularFactor = entry_.color("ks") ? std::min(1.0f, 2 * maxComponent(specular_)) : 1.0f;
        m_.clearcoat = std::clamp(entry_.number("pc").value_or(0.0f), 0.0f, 1.0f);
        m_.clearcoatRoughness = std::clamp(entry_.number("pcr").value_or(0.0f), 0.0f, 1.0f);
        if (m_.metallic == 0 && m_.specularFactor == 0 && m_.clearcoat == 0) return;  // nothing but a diffuse lobe
        m_.kind = MaterialKind::MetallicRoughness;
        if (roughnessMapped || metallicMapped)
            m_.metallicRoughnessTexture = metallicRoughnessMap(entry_.map("map_pr"), entry_.map("map_pm"), textures_);
    }

    void makeCoated() {
        m_.kind = MaterialKind::MetallicRoughness;
        m_.roughness = roughnessOfExponent();
        if (ior_ > 1) m_.ior = ior_;
    }

    /// GGX's α² = 2/(Ns + 2) has the width of the highlight (cos of the half angle)^Ns (Walter et al. 2007).
    float roughnessOfExponent() const { return std::pow(2 / (exponent_ + 2), 0.25f); }

    void readDissolve() {
        const float d = std::clamp(entry_.number("d").value_or(1.0f), 0.0f, 1.0f);
        if (!m_.transmits() && (d < 1 || entry_.map("map_d"))) m_.coverage = d;
    }

    void sayWhatIsLeft() {
        std::set<std::string> left;
        for (const auto& [statement, unused] : entry_.notRead) left.insert(statement);
        for (const auto& [statement, map] : entry_.maps)
            if (map && (statement == "disp" || statement == "decal" || statement == "refl" || statement == "map_ns" ||
                        statement == "map_ps" || statement == "map_pc" || statement == "map_pcr"))
                left.insert(statement);
        for (const char* statement : {"ps", "pc", "aniso"})
            if (entry_.number(statement).value_or(0) > 0 && !(statement == std::string("pc") && m_.clearcoat > 0))
                left.insert(statement);
        std::string list;
        for (const std::string& statement : left) list.append(list.empty() ? "" : ", ").append(statement);
        if (!list.empty()) note(list + (left.size() > 1 ? " are ignored." : " is ignored."));
    }

    const MtlMaterial& entry_;
    TextureTable& textures_;
    std::vector<std::string>& notices_;
    Material m_;
    Vec3f specular_;
    int illum_ = kHighlight;
    float ior_ = 1, exponent_ = 0;
};

std::string stemLibrary(const std::string& path) { return std::filesystem::path(path).stem().string() + ".mtl"; }

/// The rest of each line that starts with `mtllib`, once each.
std::vector<std::string> libraryNames(std::string_view text) {
    constexpr std::string_view spaces = " \t\r";
    std::vector<std::string> names;
    while (!text.empty()) {
        const size_t end = text.find('\n');
        std::string_view line = text.substr(0, end);
        text.remove_prefix(end == text.npos ? text.size() : end + 1);
        line.remove_prefix(std::min(line.size(), line.find_first_not_of(spaces)));
        if (!line.starts_with("mtllib")) continue;
        line.remove_prefix(6);
        if (line.empty() || spaces.find(line[0]) == spaces.npos) continue;
        line.remove_prefix(std::min(line.size(), line.find_first_not_of(spaces)));
        const size_t last = line.find_last_not_of(spaces);
        const std::string name(line.substr(0, last == line.npos ? 0 : last + 1));
        if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    return names;
}

std::vector<std::string> words(const std::string& text) {
    std::vector<std::string> found;
    for (size_t at = 0; (at = text.find_first_not_of(" \t", at)) != text.npos;) {
        const size_t end = std::min(text.find_first_of(" \t", at), text.size());
        found.push_back(text.substr(at, end - at));
        at = end;
    }
    return found;
}

std::string joined(const std::vector<std::string>& parts, size_t begin, size_t end) {
    std::string text = parts[begin];
    for (size_t i = begin + 1; i < end; ++i) text.append(" ").append(parts[i]);
    return text;
}

/// The name of an image, from the model's folder where it lies there, else, where it lies beside its library, that.
std::string fromDirectory(const std::string& directory, const std::string& library, const std::string& image) {
    namespace fs = std::filesystem;
    if (image.empty() || !findImageFile(directory, image).empty()) return image;
    const std::string found = findImageFile(fs::path(library).parent_path().string(), image);
    return found.empty() ? image : fs::path(found).lexically_relative(directory.empty() ? "." : directory).string();
}

}  // namespace

ObjLibraries readObjLibraries(const std::string& path) {
    ObjLibraries libraries;
    const std::string directory = std::filesystem::path(path).parent_path().string();
    const auto add = [&](const std::string& name) {
        const std::string file = findImageFile(directory, name);
        if (file.empty()) return false;
        const std::vector<uint8_t> bytes = readFileBytes(file);
        const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        for (auto& [material, entry] : parseMtl(text)) {
            for (auto& [statement, map] : entry.maps) map.file = fromDirectory(directory, file, map.file);
            libraries.materials.try_emplace(material, std::move(entry));
        }
        return true;
    };
    const std::vector<uint8_t> bytes = readFileBytes(path);
    for (const std::string& line : libraryNames({reinterpret_cast<const char*>(bytes.data()), bytes.size()})) {
        if (add(line)) continue;
        // A name may hold spaces, and a line several names: the longest that exists is one.
        const std::vector<std::string> parts = words(line);
        for (size_t begin = 0; begin < parts.size();) {
            size_t end = parts.size();
            while (end > begin && !add(joined(parts, begin, end))) --end;
            if (end == begin) {
                const bool instead = add(stemLibrary(path));
                libraries.notices.push_back("The material library '" + parts[begin] + "' is missing" +
                                            (instead ? "; '" + stemLibrary(path) + "' was read instead." : "."));
                ++end;
            }
            begin = end;
        }
    }
    return libraries;
}

Material importMtlMaterial(const std::string& name, const MtlMaterial* entry, TextureTable& textures,
                           std::vector<std::string>& notices) {
    static const MtlMaterial nothing;
    return Reader(name, entry ? *entry : nothing, textures, notices).run();
}

void applyMapTransform(const MtlMaterial& material, Mesh& mesh) {
    const auto moved = std::find_if(material.maps.begin(), material.maps.end(), [](const auto& entry) {
        return entry.second && (entry.second.scale != MtlMap().scale || entry.second.offset != MtlMap().offset);
    });
    if (moved == material.maps.end()) return;
    const MtlMap& map = moved->second;
    // MTL's v runs upwards, the engine's down.
    for (auto& uv : mesh.uvs)
        uv = {uv[0] * map.scale[0] + map.offset[0], 1 - ((1 - uv[1]) * map.scale[1] + map.offset[1])};
}

}  // namespace antipode
