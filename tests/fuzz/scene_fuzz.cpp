// A scene as text: refused with an Error, or valid and the same after any translation. No file is opened.
#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/text_format.h>

#include <algorithm>
#include <map>
#include <string>

#include "proto/scene_loader.h"
#include "proto/scene_translation.h"
#include "proto/wire/scene_package.h"
#include "renderengine/error.h"
#include "tests/fuzz/quiet.h"
#include "tests/fuzz/require.h"

namespace antipode {
namespace {

/// Far below what the loader takes, whose limits guard against slips of the pen and not against hunger for memory.
constexpr uint64_t maxCells = 10000;
constexpr int maxShapes = 100;

/// Whether the scene opens no file and stays small.
bool isHarmless(const schema::Scene& scene) {
    bool harmless = scene.environment().file().empty() && scene.model_size() == 0 && scene.disk_size() < maxShapes &&
                    scene.ripple_grid_size() < maxShapes;
    for (const schema::Texture& texture : scene.texture()) harmless &= texture.file().empty();
    for (const schema::RippleGrid& grid : scene.ripple_grid())
        harmless &= uint64_t(grid.cells_x()) * grid.cells_z() < maxCells && grid.wave_size() < maxShapes;
    for (const schema::Disk& disk : scene.disk()) harmless &= disk.segments() < maxCells;
    return harmless;
}

void tryScene(const std::string& text) {
    schema::Scene message;
    google::protobuf::TextFormat::Parser parser;
    struct : google::protobuf::io::ErrorCollector {
        void AddError(int, int, const std::string&) override {}
    } silence;
    parser.RecordErrorsTo(&silence);
    // What cannot be parsed goes on to the loader, which has to say so.
    if (parser.ParseFromString(text, &message) && !isHarmless(message)) return;
    const Scene scene = parseScene(text, "input", "/nonexistent");
    validate(scene);
    require(sceneHash(fromProto(toProto(scene))) == sceneHash(scene), "a valid scene survives translation");
    const wire::ScenePackage package = wire::packageScene(scene);
    std::map<std::string, std::shared_ptr<const std::string>> blobs;
    for (const wire::Blob& blob : package.blobs) blobs[blob.reference.sha256()] = blob.bytes;
    const Scene assembled = wire::assembleScene(wire::parseSceneRoot(*package.blobs[0].bytes),
                                                [&](const farm::BlobRef& blob) { return blobs.at(blob.sha256()); });
    require(sceneHash(assembled) == package.sceneHash, "a valid scene survives its package");
}

}  // namespace
}  // namespace antipode

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    try {
        antipode::tryScene({reinterpret_cast<const char*>(data), size});
    } catch (const antipode::Error&) {
    }
    return 0;
}
