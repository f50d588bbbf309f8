// The Vulkan devices of this machine.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace antipode {

struct DeviceInfo {
    uint32_t index = 0;  ///< position in the driver's list
    std::string name, driver;
    std::string kind;           ///< "discrete GPU", "integrated GPU", "virtual GPU", "CPU"
    std::string uuid;           ///< 32 hexadecimal digits
    std::string pciId;          ///< "0000:01:00.0", empty where the driver does not tell
    uint64_t memoryBytes = 0;   ///< largest device-local heap
    uint64_t bindingBytes = 0;  ///< largest buffer that kernels can write to
    bool usable = false;
    std::string reason;  ///< why not, where not usable
};

/// All devices, the one that `selectDevice("")` takes first.
std::vector<DeviceInfo> listDevices();

bool hasUsableDevice();

/// The device that an index, UUID (or unambiguous prefix of at least 4 digits) or PCI id names; the best one for "".
/// UUIDs and PCI ids may be as nvidia-smi or lspci writes them ("GPU-…", "00000000:01:00.0", "01:00.0"). Throws
/// Error(Usage) where nothing or more than one matches, Error(Device) where there is no usable device.
DeviceInfo selectDevice(const std::string& selector);

/// Devices of one class render the same bytes with the same kernels: same hardware and same driver.
std::string deviceClass(const DeviceInfo& device);

}  // namespace antipode
