// antipode devices: what can render here.
#include <algorithm>
#include <iostream>

#include <nlohmann/json.hpp>

#include "terminal/command_line.h"
#include "client/commands.h"
#include "terminal/text.h"
#include "renderengine/devices.h"
#include "renderengine/error.h"

namespace antipode {
namespace {

nlohmann::ordered_json toJson(const DeviceInfo& device) {
    return {{"index", device.index},
            {"name", device.name},
            {"kind", device.kind},
            {"driver", device.driver},
            {"uuid", device.uuid},
            {"pci_id", device.pciId},
            {"memory_bytes", device.memoryBytes},
            {"usable", device.usable},
            {"reason", device.reason}};
}

void printText(const DeviceInfo& device) {
    std::cout << device.index << "  " << device.name << " (" << device.kind << ", " << byteSize(device.memoryBytes)
              << ")\n"
              << "   driver " << device.driver << "\n"
              << "   UUID   " << device.uuid << "\n";
    if (!device.pciId.empty()) std::cout << "   PCI    " << device.pciId << "\n";
    if (!device.usable) std::cout << "   cannot be used: " << device.reason << "\n";
}

}  // namespace

void devicesCommand(const std::vector<std::string>& arguments) {
    bool json = false;
    if (!parseCommandLine("antipode devices", "Lists the Vulkan devices of this machine, the default one first.",
                          {{"--json", "", "print a JSON array", "", assignFlag(json, true)}}, arguments))
        return;
    const std::vector<DeviceInfo> devices = listDevices();
    if (json) {
        auto array = nlohmann::ordered_json::array();
        for (const DeviceInfo& device : devices) array.push_back(toJson(device));
        std::cout << array.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << std::endl;
    } else {
        for (const DeviceInfo& device : devices) printText(device);
        std::cout << std::flush;
    }
    // A script can ask by the exit code whether this machine can render.
    if (std::none_of(devices.begin(), devices.end(), [](const DeviceInfo& device) { return device.usable; }))
        throw Error(ErrorCode::Device,
                    "This machine has no usable Vulkan device; install a driver for its GPU, or Mesa's "
                    "lavapipe to render on the CPU.");
}

}  // namespace antipode
