// The packed scene in device memory, bound to the kernels.
#pragma once

#include <vector>

#include "gpu/packed_scene.h"
#include "vulkan/bindings.h"

namespace antipode {

/// The bindings of all kernels, as kernels/shared/layout.h numbers them.
std::vector<Binding> kernelBindings();

class GpuScene {
public:
    GpuScene(Device& device, const PackedScene& packed);

    /// Binds every scene buffer; the scene must outlive the table's use.
    void bind(BindingTable& table) const;

private:
    Buffer nodes_, primitives_, attributes_, materials_, lights_, textureInfo_, texels_, environmentMap_,
        environmentAlias_, bodies_, moreAttributes_, losses_;
};

}  // namespace antipode
