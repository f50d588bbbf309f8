// What a physical device says about itself, before anything is created on it.
#pragma once

#include "renderengine/devices.h"

#include <vulkan/vulkan.h>

#include <optional>

namespace antipode {

/// The device as the user sees it, with the reason where the renderer cannot use it. `index` is its place in the
/// driver's list.
DeviceInfo describeDevice(VkPhysicalDevice physical, uint32_t index);

/// The queue family to compute on: one without graphics where there is such a one, as it is free of the desktop's work.
std::optional<uint32_t> computeQueueFamily(VkPhysicalDevice physical);

}  // namespace antipode
