// Transfers to and from memory that the host cannot see.
#pragma once

#include "vulkan/device.h"

#include <cstddef>

namespace antipode {

/// Copies `bytes` bytes into `target` from `offset` on, through the device's staging buffer. Throws
/// Error(Device).
void uploadStaged(Device& device, VkBuffer target, VkDeviceSize offset, const void* source, size_t bytes);

/// Copies `bytes` bytes out of `source` from `offset` on, in the same way.
void downloadStaged(Device& device, VkBuffer source, VkDeviceSize offset, void* target, size_t bytes);

}  // namespace antipode
