// antipode tonemap: an OpenEXR image as it is to be shown.
#include <cstdio>
#include <filesystem>
#include <limits>

#include "client/commands.h"
#include "client/outputs.h"
#include "client/render_options.h"
#include "renderengine/error.h"
#include "renderengine/exposure.h"
#include "renderengine/film.h"
#include "renderengine/io/files.h"
#include "renderengine/pictures.h"
#include "terminal/command_line.h"

namespace antipode {
namespace {

struct TonemapOptions {
    std::string exrPath, picturePath;
    std::optional<double> exposure, kelvin;
    uint32_t bits = 8, quality = 92;
};

bool isJpeg(const std::string& path) {
    const std::string suffix = std::filesystem::path(path).extension().string();
    return suffix == ".jpg" || suffix == ".jpeg";
}

AssignValue assignBits(uint32_t& bits) {
    return [&bits](const std::string&, const std::string& value) { bits = value == "8" ? 8 : 16; };
}

AssignValue assignKelvin(std::optional<double>& kelvin) {
    return [&kelvin](const std::string& option, const std::string& value) {
        constexpr double least = 1667, most = 25000;
        const double number = parseReal(option, value, 0, std::numeric_limits<double>::max());
        if (number < least || number > most)
            throw Error(ErrorCode::Usage, option + " takes a temperature from 1667 to 25000 K, not '" + value + "'.");
        kelvin = number;
    };
}

std::string encoded(const Image& image, const TonemapOptions& options) {
    if (isJpeg(options.picturePath)) return encodeJpeg(image, int(options.quality));
    return options.bits == 16 ? encodePng16(image) : encodePng(image);
}

}  // namespace

void tonemapCommand(const std::vector<std::string>& arguments) {
    TonemapOptions options;
    if (!parseCommandLine(
            "antipode tonemap", "Shows a linear image through the tone curve.",
            {{"A.exr", "", "image", "", assignText(options.exrPath)},
             {"-o,--output", "FILE", "image to write, .png or .jpg", "A.png", assignText(options.picturePath)},
             {"--exposure", "STOPS|auto", "it is shown at 2^STOPS", "auto", assignExposure(options.exposure)},
             {"--white-balance", "KELVIN", "light of this colour temperature is shown white", "6504, as it is",
              assignKelvin(options.kelvin)},
             {"--bits", "8|16", "of a PNG's channels", "8", assignBits(options.bits), false, {"8", "16"}},
             {"--quality", "PERCENT", "of a JPEG", std::to_string(options.quality),
              assignWhole(options.quality, 1, 100)}},
            arguments))
        return;
    if (options.picturePath.empty())
        options.picturePath = std::filesystem::path(options.exrPath).replace_extension(".png").string();
    const bool jpeg = isJpeg(options.picturePath);
    if (!jpeg && std::filesystem::path(options.picturePath).extension() != ".png")
        throw Error(ErrorCode::Usage,
                    "--output takes a name that ends in .png or .jpg, not '" + options.picturePath + "'.");
    if (jpeg && options.bits == 16) throw Error(ErrorCode::Usage, "A JPEG has 8 bits: write a .png for --bits 16.");

    Image image = readExr(options.exrPath);
    if (options.kelvin) image = whiteBalanced(std::move(image), *options.kelvin);
    const double stops = options.exposure ? *options.exposure : autoExposure(image);
    writeFileAtomically(options.picturePath, encoded(exposed(std::move(image), stops), options));
    std::printf("wrote %s (at %s%s)\n", options.picturePath.c_str(), shownExposure(stops).c_str(),
                options.exposure ? "" : ", auto");
}

}  // namespace antipode
