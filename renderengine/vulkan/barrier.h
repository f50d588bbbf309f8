// The two memory barriers that compute work needs.
#pragma once

#include <vulkan/vulkan.h>

namespace antipode {

/// All commands before are done, and their writes are seen, before any command after starts. On a queue that only
/// computes and copies, naming stages more narrowly would gain nothing.
void recordDeviceBarrier(VkCommandBuffer commands);

/// As `recordDeviceBarrier`, towards the host once it has waited for the fence.
void recordHostBarrier(VkCommandBuffer commands);

}  // namespace antipode
