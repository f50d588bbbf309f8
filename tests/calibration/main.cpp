// antipode_calibration: whether the error that a render tells is true, as a page and a table.
#include <fstream>
#include <iostream>

#include <CLI/CLI.hpp>

#include "renderengine/error.h"
#include "tests/calibration/report.h"
#include "tests/calibration/scenes.h"

using namespace antipode;
using namespace antipode::test;

int main(int argc, char** argv) {
    CLI::App app{"Renders scenes with many seeds, and holds the error that each tells against the truth."};
    CalibrationOptions options;
    std::vector<std::string> scenes;
    std::string out, keep;
    app.add_option("--out", out, "folder for calibration.md and calibration.csv");
    app.add_option("--keep", keep, "folder for what is rendered, which is not rendered again");
    app.add_option("--seeds", options.seeds, "renders of each scene and technique")->capture_default_str();
    app.add_option("--first-seed", options.firstSeed, "of the renders; the estimate was found with 1 to 50")
        ->capture_default_str();
    app.add_option("--side", options.side, "pixels a side")->capture_default_str();
    app.add_option("--iterations", options.iterations, "of each render")->capture_default_str();
    app.add_option("SCENE", scenes, "some of the scenes instead of all, by name");
    try {
        app.parse(argc, argv);
        CalibrationReport report(options);
        for (const CalibrationScene& scene : calibrationScenes()) {
            if (!scenes.empty() && std::ranges::find(scenes, scene.name) == scenes.end()) continue;
            report.add(scene, keep);
            std::cerr << "measured " << scene.name << std::endl;
        }
        if (out.empty()) {
            std::cout << report.page();
            return 0;
        }
        std::ofstream(out + "/calibration.md") << report.page();
        std::ofstream(out + "/calibration.csv") << report.csv();
        return 0;
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    } catch (const Error& error) {
        std::cerr << "antipode_calibration: " << error.what() << std::endl;
        return error.code() == ErrorCode::Usage ? 2 : 1;
    }
}
