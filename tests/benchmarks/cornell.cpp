#include "tests/benchmarks/cornell.h"

#include "proto/scene_loader.h"

namespace antipode::benchmark {

Engine cornellEngine(const std::string& name, const std::string& technique, uint32_t side, const std::string& device,
                     Precision precision) {
    RenderSettings settings;
    settings.width = settings.height = side;
    settings.technique = technique;
    settings.maxPathLength = 10;
    settings.precision = precision;
    return Engine(loadScene(ANTIPODE_SOURCE_DIR "/scenes/cornell/" + name + ".textproto"), settings, device);
}

}  // namespace antipode::benchmark
