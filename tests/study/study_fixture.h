// A study without rendering.
#pragma once

#include "client/study/study.h"

namespace antipode::study::test {

/// Tiles that all err by so many percent.
inline TileErrors tilesAt(double percent) {
    TileErrors errors;
    for (int tile = 0; tile < 64; ++tile) {
        errors.relMse.push_back(percent * percent * 1e-4 * (tile % 2 ? 1.2 : 0.8));
        errors.share.push_back(1.0 / 64);
    }
    return errors;
}

/// Seven snapshots at doubling iterations, `perIteration` seconds each; the error falls with the square root.
inline VariantResult resultOf(const Variant& variant, double perIteration, double percentOfOne, Image image) {
    VariantResult result{variant, {}, {}, std::move(image)};
    for (uint64_t n = 1; n <= 64; n *= 2)
        result.snapshots.push_back({n, double(n) * perIteration, 1.9 * double(n) * perIteration,
                                    double(n) * perIteration, tilesAt(percentOfOne / std::sqrt(double(n))),
                                    0.2 / std::sqrt(double(n))});
    for (int i = 0; i < 64; ++i) result.spent.iterationCpu.add(1.9 * perIteration * (i % 2 ? 1.01 : 0.99));
    result.spent.iterations = 64;
    result.spent.stages = {{"intersect", 3 * perIteration, 1000}, {"shadow", perIteration, 500}};
    return result;
}

/// A scene of vcm, pt and double precision on vcm: double takes 1.9 times as long for the same error.
inline SceneResult sceneOfThree() {
    SceneResult scene;
    scene.name = "A \"room\" </script>";
    scene.device = "none";
    Image image{32, 24, {}};
    for (uint32_t i = 0; i < 32 * 24; ++i) image.pixels.push_back({0.02f * float(i % 32), 0.03f * float(i / 32), 0.3f});
    scene.reference = {image, {}};
    scene.referenceText = "made up";
    scene.referencePercent = {0.5, 0.4, 0.6};
    for (const Variant& variant : chooseVariants("vcm", "pt,double"))
        scene.variants.push_back(
            resultOf(variant, variant.name == "double" ? 0.19 : 0.1, variant.name == "pt" ? 60 : 20, image));
    return scene;
}

}  // namespace antipode::study::test
