// Turns Vulkan result codes into exceptions.
#pragma once

#include <vulkan/vulkan.h>

#include <string>

namespace antipode {

/// The name of a result code, such as "VK_ERROR_DEVICE_LOST", or "VkResult -42" for one this file does not know.
std::string resultName(VkResult result);

/// Throws Error(Device) where `result` is not VK_SUCCESS. `what` completes "Vulkan could not …", as in "create a
/// fence".
void check(VkResult result, const char* what);

}  // namespace antipode
