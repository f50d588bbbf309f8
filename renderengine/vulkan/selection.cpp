#include "vulkan/selection.h"

#include "renderengine/error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <optional>
#include <tuple>

namespace antipode {

namespace {

int kindRank(const std::string& kind) {
    const char* const bestFirst[] = {"discrete GPU", "integrated GPU", "virtual GPU", "CPU"};
    return static_cast<int>(std::find(std::begin(bestFirst), std::end(bestFirst), kind) - std::begin(bestFirst));
}

std::string normalised(const std::string& text) {
    std::string result;
    for (const unsigned char c : text)
        if (c != '-') result += static_cast<char>(std::tolower(c));
    return result;
}

/// Domain, bus, device and function of "0000:01:00.0"; lspci leaves out the domain, nvidia-smi gives it eight digits.
std::optional<std::array<unsigned, 4>> pciAddress(const std::string& text) {
    unsigned domain = 0, bus = 0, device = 0, function = 0;
    char more = 0;
    const bool known = std::sscanf(text.c_str(), "%8x:%2x:%2x.%1x%c", &domain, &bus, &device, &function, &more) == 4 ||
                       (domain = 0, std::sscanf(text.c_str(), "%2x:%2x.%1x%c", &bus, &device, &function, &more) == 3);
    return known ? std::optional(std::array{domain, bus, device, function}) : std::nullopt;
}

bool isIndex(const std::string& selector) {
    return selector.size() < 4 &&
           std::all_of(selector.begin(), selector.end(), [](unsigned char c) { return std::isdigit(c); });
}

bool matches(const DeviceInfo& device, const std::string& selector) {
    if (isIndex(selector)) return device.index == std::stoul(selector);
    if (selector.find(':') != std::string::npos) {
        const auto wanted = pciAddress(selector);
        return wanted && pciAddress(device.pciId) == wanted;
    }
    // NVIDIA's tools, and with them Slurm and Kubernetes, put "GPU-" before the UUID.
    const std::string wanted = normalised(selector.starts_with("GPU-") ? selector.substr(4) : selector);
    return wanted.size() >= 4 && device.uuid.compare(0, wanted.size(), wanted) == 0;
}

std::string describe(const std::vector<DeviceInfo>& devices) {
    std::string text;
    for (const DeviceInfo& device : devices)
        text +=
            (text.empty() ? "" : "; ") + std::to_string(device.index) + " = " + device.name + ", UUID " + device.uuid;
    return text.empty() ? "none" : text;
}

}  // namespace

void sortByRank(std::vector<DeviceInfo>& devices) {
    std::stable_sort(devices.begin(), devices.end(), [](const DeviceInfo& a, const DeviceInfo& b) {
        return std::tuple(!a.usable, kindRank(a.kind), b.memoryBytes, a.index) <
               std::tuple(!b.usable, kindRank(b.kind), a.memoryBytes, b.index);
    });
}

DeviceInfo chooseDevice(const std::vector<DeviceInfo>& devices, const std::string& selector) {
    if (selector.empty()) {
        if (devices.empty()) throw Error(ErrorCode::Device, "There is no Vulkan device; install the GPU's driver.");
        if (!devices.front().usable)
            throw Error(ErrorCode::Device, "No Vulkan device is usable; the best, " + devices.front().name +
                                               ", is not because " + devices.front().reason + ".");
        return devices.front();
    }
    std::vector<DeviceInfo> found;
    std::copy_if(devices.begin(), devices.end(), std::back_inserter(found),
                 [&](const DeviceInfo& device) { return matches(device, selector); });
    if (found.empty())
        throw Error(ErrorCode::Usage, "No device matches \"" + selector +
                                          "\" (an index, a PCI id, or at least four digits "
                                          "of a UUID); the devices are: " +
                                          describe(devices) + ".");
    if (found.size() > 1)
        throw Error(ErrorCode::Usage, "More than one device matches \"" + selector + "\": " + describe(found) + ".");
    if (!found.front().usable)
        throw Error(ErrorCode::Device,
                    "The device " + found.front().name + " is not usable: " + found.front().reason + ".");
    return found.front();
}

}  // namespace antipode
