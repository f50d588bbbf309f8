#include "gpu/gpu_scene.h"

namespace antipode {
namespace {

/// A device buffer with the array's bytes; one zero texel where it is empty, since a binding must hold something.
template <class T>
Buffer uploadArray(Device& device, const std::vector<T>& array) {
    static const shared::uvec4 nothing;
    const bool empty = array.empty();
    const size_t bytes = empty ? sizeof nothing : array.size() * sizeof(T);
    Buffer buffer(device, bytes, Residency::DeviceOnly);
    buffer.upload(empty ? static_cast<const void*>(&nothing) : array.data(), bytes);
    return buffer;
}

bool isTexelBinding(uint32_t index) {
    using namespace shared;
    switch (index) {
        case BIND_NODES:
        case BIND_PRIMITIVES:
        case BIND_ATTRIBUTES:
        case BIND_MORE_ATTRIBUTES:
        case BIND_MATERIALS:
        case BIND_LIGHTS:
        case BIND_TEXTURE_INFO:
        case BIND_TEXELS:
        case BIND_ENVIRONMENT_MAP:
        case BIND_ENVIRONMENT_ALIAS:
        case BIND_BODIES:
        case BIND_LOSSES:
        case BIND_PATHS:
        case BIND_HITS:
        case BIND_SHADOW:
        case BIND_QUEUES:
        case BIND_VERTEX_POSITIONS:
        case BIND_VERTEX_DATA:
        case BIND_CELLS: return true;
        default: return false;
    }
}

}  // namespace

std::vector<Binding> kernelBindings() {
    std::vector<Binding> bindings;
    for (uint32_t i = 0; i < shared::BIND_COUNT; ++i)
        bindings.push_back(
            {i, isTexelBinding(i) ? VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER});
    return bindings;
}

GpuScene::GpuScene(Device& device, const PackedScene& packed)
    : nodes_(uploadArray(device, packed.bvh.nodes)),
      primitives_(uploadArray(device, packed.primitives)),
      attributes_(uploadArray(device, packed.attributes)),
      materials_(uploadArray(device, packed.materials)),
      lights_(uploadArray(device, packed.lights)),
      textureInfo_(uploadArray(device, packed.textureInfo)),
      texels_(uploadArray(device, packed.texels)),
      environmentMap_(uploadArray(device, packed.environmentMap)),
      environmentAlias_(uploadArray(device, packed.environmentAlias)),
      bodies_(uploadArray(device, packed.bodies)),
      moreAttributes_(uploadArray(device, packed.moreAttributes)),
      losses_(uploadArray(device, packed.losses)) {}

void GpuScene::bind(BindingTable& table) const {
    using namespace shared;
    table.set(BIND_NODES, nodes_, VK_FORMAT_R32G32B32A32_UINT);
    table.set(BIND_PRIMITIVES, primitives_, VK_FORMAT_R32G32B32A32_UINT);
    table.set(BIND_ATTRIBUTES, attributes_, VK_FORMAT_R32G32B32A32_UINT);
    table.set(BIND_MATERIALS, materials_, VK_FORMAT_R32G32B32A32_UINT);
    table.set(BIND_LIGHTS, lights_, VK_FORMAT_R32G32B32A32_UINT);
    table.set(BIND_TEXTURE_INFO, textureInfo_, VK_FORMAT_R32G32B32A32_UINT);
    table.set(BIND_TEXELS, texels_, VK_FORMAT_R16G16B16A16_SFLOAT);
    table.set(BIND_ENVIRONMENT_MAP, environmentMap_, VK_FORMAT_R32G32B32A32_SFLOAT);
    table.set(BIND_ENVIRONMENT_ALIAS, environmentAlias_, VK_FORMAT_R32G32B32A32_UINT);
    table.set(BIND_BODIES, bodies_, VK_FORMAT_R32G32B32A32_UINT);
    table.set(BIND_MORE_ATTRIBUTES, moreAttributes_, VK_FORMAT_R32G32B32A32_UINT);
    table.set(BIND_LOSSES, losses_, VK_FORMAT_R32G32B32A32_SFLOAT);
}

}  // namespace antipode
