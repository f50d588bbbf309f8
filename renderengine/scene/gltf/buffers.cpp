#include "scene/gltf/buffers.h"

#include <filesystem>
#include <utility>

#include "renderengine/io/files.h"
#include "scene/gltf/container.h"
#include "scene/gltf/meshopt.h"

namespace antipode::gltf {
namespace {

/// The ratified name is of the same streams, with a later version of them that meshoptimizer's decoders refuse here.
const json& compression(const json& of) {
    const json& ratified = extension(of, "KHR_meshopt_compression");
    return ratified.empty() ? extension(of, "EXT_meshopt_compression") : ratified;
}

std::vector<uint8_t> load(const json& buffer, size_t index, std::vector<uint8_t>& chunk, const std::string& directory) {
    const std::string uri = buffer.value("uri", "");
    std::vector<uint8_t> bytes;
    if (uri.starts_with("data:"))
        bytes = decodeDataUri(uri);
    else if (!uri.empty())
        bytes = readFileBytes((std::filesystem::path(directory) / decodeUri(uri)).string());
    else if (index == 0)
        bytes = std::move(chunk);
    else
        return bytes;  // some writers leave out the word that it is a fallback; a view that reads it is refused
    // What compressed views fall back to where nobody can decode them need not exist.
    if (compression(buffer).value("fallback", false)) return bytes;
    if (bytes.size() < natural(buffer.at("byteLength"))) fail("buffer " + std::to_string(index) + " is cut short");
    return bytes;
}

}  // namespace

Buffers::Buffers(const json& file, std::vector<uint8_t> chunk, const std::string& directory) {
    for (const json& buffer : list(file, "buffers"))
        buffers_.push_back(load(buffer, buffers_.size(), chunk, directory));
    for (const json& view : list(file, "bufferViews")) {
        const json& compressed = compression(view);
        if (compressed.empty()) {
            views_.push_back({stretch(view), natural(view, "byteStride", 0)});
        } else {
            decoded_.push_back(decodeMeshopt(compressed, stretch(compressed)));
            views_.push_back({decoded_.back(), natural(compressed.at("byteStride"))});
        }
    }
}

std::span<const uint8_t> Buffers::stretch(const json& view) const {
    const uint64_t begin = natural(view, "byteOffset", 0), length = natural(view.at("byteLength"));
    const uint64_t buffer = natural(view.at("buffer"));
    if (buffer >= buffers_.size() || begin > buffers_[buffer].size() || length > buffers_[buffer].size() - begin)
        fail("bufferView " + std::to_string(views_.size()) + " reaches beyond its buffer");
    return std::span(buffers_[buffer]).subspan(begin, length);
}

const View& Buffers::view(size_t index) const {
    if (index >= views_.size()) fail("it refers to a bufferView that does not exist");
    return views_[index];
}

}  // namespace antipode::gltf
