#include "tests/calibration/scenes.h"

#include <cstdlib>

#include "proto/scene_loader.h"

namespace antipode::test {
namespace {

std::string folderOf(const CalibrationScene& scene) {
    if (!scene.shared) return ANTIPODE_SOURCE_DIR "/";
    const char* shared = std::getenv("ANTIPODE_SHARED");
    return shared ? std::string(shared) + "/" : "";
}

}  // namespace

std::vector<CalibrationScene> calibrationScenes() {
    std::vector<CalibrationScene> scenes{
        {"cornell-area", "scenes/cornell/area.textproto", false, true},
        {"cornell-point", "scenes/cornell/point.textproto"},
        {"cornell-sky", "scenes/cornell/sky.textproto", false, true},
        {"cornell-sun", "scenes/cornell/sun.textproto"},
        {"glass-caustics", "scenes/glass_caustics.textproto", false, true},
        {"pool", "scenes/pool.textproto"},
        {"furnace-closed", "scenes/furnace/closed.textproto", false, true},
        {"veach-mis", "scenes/veach_mis.textproto", false, true},
        {"room", "scenes/cornell-box/cornell-box.glb", true, true},
    };
    std::erase_if(scenes, [](const CalibrationScene& scene) { return folderOf(scene).empty(); });
    return scenes;
}

Scene load(const CalibrationScene& scene) { return loadScene(folderOf(scene) + scene.file); }

}  // namespace antipode::test
