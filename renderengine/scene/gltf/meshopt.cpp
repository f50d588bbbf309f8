#include "scene/gltf/meshopt.h"

#include <meshoptimizer.h>

namespace antipode::gltf {
namespace {

/// What a byte of compressed data unpacks to at most: a group of 16 equal bytes takes two bits.
constexpr uint64_t kMostBytesPerByte = 64, kAlwaysAllowed = 1 << 16;

/// What the library takes for granted.
void checkShape(const std::string& mode, const std::string& filter, uint64_t stride, uint64_t count) {
    bool sound = stride > 0 && stride <= 256;
    if (mode == "ATTRIBUTES")
        sound = sound && stride % 4 == 0;
    else if (mode == "TRIANGLES")
        sound = (stride == 2 || stride == 4) && count % 3 == 0;
    else if (mode == "INDICES")
        sound = stride == 2 || stride == 4;
    else
        fail("the mode '" + mode + "' of a compressed bufferView is unknown");
    if (filter == "OCTAHEDRAL")
        sound = sound && (stride == 4 || stride == 8);
    else if (filter == "QUATERNION")
        sound = sound && stride == 8;
    else if (filter == "EXPONENTIAL")
        sound = sound && stride % 4 == 0;
    else if (filter != "NONE")
        fail("the filter '" + filter + "' of a compressed bufferView is unknown");
    if (!sound || count == 0) fail("a compressed bufferView has a stride or count that its mode does not allow");
}

}  // namespace

std::vector<uint8_t> decodeMeshopt(const json& from, std::span<const uint8_t> compressed) {
    const uint64_t stride = natural(from.at("byteStride")), count = natural(from.at("count"));
    const std::string mode = from.at("mode").get<std::string>(), filter = from.value("filter", "NONE");
    checkShape(mode, filter, stride, count);
    if (count > (kAlwaysAllowed + kMostBytesPerByte * compressed.size()) / stride)
        fail("a compressed bufferView asks for more than its bytes can hold");
    std::vector<uint8_t> bytes(count * stride);
    using Decoder = int (*)(void*, size_t, size_t, const unsigned char*, size_t);  // the library overloads it
    const Decoder decode = mode == "ATTRIBUTES"  ? Decoder(meshopt_decodeVertexBuffer)
                           : mode == "TRIANGLES" ? Decoder(meshopt_decodeIndexBuffer)
                                                 : Decoder(meshopt_decodeIndexSequence);
    if (decode(bytes.data(), count, stride, compressed.data(), compressed.size()) != 0)
        fail("a compressed bufferView is damaged");
    if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(bytes.data(), count, stride);
    if (filter == "QUATERNION") meshopt_decodeFilterQuat(bytes.data(), count, stride);
    if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(bytes.data(), count, stride);
    return bytes;
}

}  // namespace antipode::gltf
