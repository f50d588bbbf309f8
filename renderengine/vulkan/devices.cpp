#include "renderengine/devices.h"

#include <algorithm>

#include "vulkan/instance.h"
#include "vulkan/physical_device.h"
#include "vulkan/selection.h"

namespace antipode {

std::vector<DeviceInfo> listDevices() {
    const Instance instance;
    std::vector<DeviceInfo> devices;
    for (const VkPhysicalDevice physical : instance.physicalDevices())
        devices.push_back(describeDevice(physical, static_cast<uint32_t>(devices.size())));
    sortByRank(devices);
    return devices;
}

bool hasUsableDevice() {
    return std::ranges::any_of(listDevices(), [](const DeviceInfo& device) { return device.usable; });
}

DeviceInfo selectDevice(const std::string& selector) { return chooseDevice(listDevices(), selector); }

std::string deviceClass(const DeviceInfo& device) { return device.name + ", " + device.driver; }

}  // namespace antipode
