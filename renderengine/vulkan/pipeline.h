// A compiled compute kernel.
#pragma once

#include "vulkan/bindings.h"

#include <span>
#include <utility>
#include <vector>

namespace antipode {

/// One kernel with its specialisation constants set. Some drivers put off compiling to the first dispatch.
class ComputePipeline {
public:
    /// `specialisation` holds pairs of `constant_id` and 32-bit value (bit-cast where the constant is a float; 0 or 1
    /// for a bool); constants left out keep their defaults. Throws Error(Device). `bindings` must outlive the pipeline.
    ComputePipeline(Device& device, const BindingTable& bindings, std::span<const uint32_t> spirv,
                    const std::vector<std::pair<uint32_t, uint32_t>>& specialisation = {});
    ~ComputePipeline();
    ComputePipeline(ComputePipeline&& other) noexcept;
    ComputePipeline& operator=(ComputePipeline&& other) noexcept;

    VkPipeline handle() const { return pipeline_; }

private:
    Device* device_;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
};

}  // namespace antipode
