// antipode tonemap: an OpenEXR image as it is to be shown.
#include <cstdio>
#include <filesystem>

#include "client/commands.h"
#include "client/outputs.h"
#include "client/render_options.h"
#include "renderengine/error.h"
#include "renderengine/film.h"
#include "terminal/command_line.h"

namespace antipode {

void tonemapCommand(const std::vector<std::string>& arguments) {
    std::string exrPath, pngPath;
    std::optional<double> exposure;
    if (!parseCommandLine(
            "antipode tonemap", "Shows a linear image through the tone curve.",
            {{"A.exr", "", "image", "", assignText(exrPath)},
             {"-o,--output", "FILE.png", "image to write", "A.png", assignText(pngPath)},
             {"--exposure", "STOPS|auto", "the PNG is shown at 2^STOPS", "auto", assignExposure(exposure)}},
            arguments))
        return;
    if (pngPath.empty()) pngPath = std::filesystem::path(exrPath).replace_extension(".png").string();
    if (std::filesystem::path(pngPath).extension() != ".png")
        throw Error(ErrorCode::Usage, "--output takes a name that ends in .png, not '" + pngPath + "'.");
    const double stops = writeShownImage(pngPath, readExr(exrPath), exposure);
    std::printf("wrote %s (at %s%s)\n", pngPath.c_str(), shownExposure(stops).c_str(), exposure ? "" : ", auto");
}

}  // namespace antipode
