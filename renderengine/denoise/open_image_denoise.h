// Intel's Open Image Denoise, where the machine has it: https://www.openimagedenoise.org, version 2.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "denoise/halves.h"

namespace antipode {

/// The library as it is found when the program runs, by the loader's search path: nothing is linked to it.
class OpenImageDenoise {
public:
    /// On this machine's processor. Nothing where there is no libOpenImageDenoise.so.2 that works.
    static std::optional<OpenImageDenoise> find();

    /// Filters the half's image by albedo and normal; nothing where the library failed.
    std::optional<RgbPlanes> filtered(const Half& half, const Features& features) const;

private:
    struct Library;
    explicit OpenImageDenoise(std::shared_ptr<const Library> library) : library_(std::move(library)) {}
    std::shared_ptr<const Library> library_;
};

}  // namespace antipode
