#include "denoise/open_image_denoise.h"

#include <vector>

#include <dlfcn.h>

namespace antipode {
namespace {

// Of the C interface of version 2 (its documentation, "C API").
using Device = struct DeviceHandle*;
using Filter = struct FilterHandle*;
constexpr int cpuDevice = 1, float3Format = 3, noError = 0;

/// Interleaved RGB or XYZ, row-major, as the library takes it.
std::vector<float> interleaved(const Plane& a, const Plane& b, const Plane& c) {
    std::vector<float> values;
    values.reserve(size_t(a.width()) * size_t(a.height()) * 3);
    for (int32_t y = 0; y < a.height(); ++y)
        for (int32_t x = 0; x < a.width(); ++x) values.insert(values.end(), {a.row(y)[x], b.row(y)[x], c.row(y)[x]});
    return values;
}

}  // namespace

struct OpenImageDenoise::Library {
    void* handle = nullptr;
    Device device = nullptr;
    Device (*newDevice)(int) = nullptr;
    void (*commitDevice)(Device) = nullptr;
    void (*releaseDevice)(Device) = nullptr;
    int (*deviceError)(Device, const char**) = nullptr;
    Filter (*newFilter)(Device, const char*) = nullptr;
    void (*setImage)(Filter, const char*, void*, int, size_t, size_t, size_t, size_t, size_t) = nullptr;
    void (*setBool)(Filter, const char*, bool) = nullptr;
    void (*commitFilter)(Filter) = nullptr;
    void (*executeFilter)(Filter) = nullptr;
    void (*releaseFilter)(Filter) = nullptr;

    Library() = default;
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
    ~Library() {
        if (device) releaseDevice(device);
        if (handle) ::dlclose(handle);
    }

    bool load() {
        handle = ::dlopen("libOpenImageDenoise.so.2", RTLD_NOW | RTLD_LOCAL);
        if (!handle || !(get(newDevice, "oidnNewDevice") && get(commitDevice, "oidnCommitDevice") &&
                         get(releaseDevice, "oidnReleaseDevice") && get(deviceError, "oidnGetDeviceError") &&
                         get(newFilter, "oidnNewFilter") && get(setImage, "oidnSetSharedFilterImage") &&
                         get(setBool, "oidnSetFilterBool") && get(commitFilter, "oidnCommitFilter") &&
                         get(executeFilter, "oidnExecuteFilter") && get(releaseFilter, "oidnReleaseFilter")))
            return false;
        device = newDevice(cpuDevice);
        if (device) commitDevice(device);
        return device && works();
    }
    bool works() const { return deviceError(device, nullptr) == noError; }

private:
    template <class Function>
    bool get(Function& function, const char* name) {
        function = reinterpret_cast<Function>(::dlsym(handle, name));
        return function != nullptr;
    }
};

std::optional<OpenImageDenoise> OpenImageDenoise::find() {
    auto library = std::make_shared<Library>();
    if (!library->load()) return std::nullopt;
    return OpenImageDenoise(std::move(library));
}

std::optional<RgbPlanes> OpenImageDenoise::filtered(const Half& half, const Features& features) const {
    const auto width = size_t(features[0].width()), height = size_t(features[0].height());
    std::vector<float> color = interleaved(half.mean[0], half.mean[1], half.mean[2]),
                       albedo = interleaved(features[0], features[1], features[2]),
                       normal = interleaved(features[3], features[4], features[5]), output(color.size());
    const Library& library = *library_;
    Filter filter = library.newFilter(library.device, "RT");
    if (!filter) return std::nullopt;
    for (const auto& [name, values] :
         {std::pair("color", &color), {"albedo", &albedo}, {"normal", &normal}, {"output", &output}})
        library.setImage(filter, name, values->data(), float3Format, width, height, 0, 0, 0);
    library.setBool(filter, "hdr", true);
    library.commitFilter(filter);
    library.executeFilter(filter);
    library.releaseFilter(filter);
    if (!library.works()) return std::nullopt;
    const Plane plane{uint32_t(width), uint32_t(height)};
    RgbPlanes planes{plane, plane, plane};
    for (size_t y = 0; y < height; ++y)
        for (size_t x = 0; x < width; ++x)
            for (size_t c = 0; c < 3; ++c) planes[c].row(int32_t(y))[x] = output[3 * (y * width + x) + c];
    return planes;
}

}  // namespace antipode
