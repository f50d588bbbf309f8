// Scenes whose image is known exactly, as a table: closed_form_scenes.cpp has the rows, closed_forms_test.cpp tests
// every row against every technique.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "renderengine/scene.h"
#include "renderengine/settings.h"

namespace antipode::test {

struct ClosedFormCase {
    std::string name;
    std::string difficulty{};  ///< what is hard about it, a phrase
    Scene scene{};
    /// What the camera sees: radiance, the same in all channels and towards all directions, of the point (x, y) of the
    /// horizontal plane at `planeHeight`.
    std::function<double(double x, double y)> radiance{};
    double planeHeight = 0;
    /// Techniques that cannot sample any of the paths: their image must be exactly black.
    std::vector<std::string> blind{};
    /// Techniques whose samples have no variance here, so that no test of their mean says anything: not rendered.
    std::vector<std::string> heavyTailed{};

    uint32_t size = 32;           ///< pixels of the square image
    uint32_t blocks = 2;          ///< blocks × blocks parts are tested as well as the whole image
    uint64_t lightPaths = 16384;  ///< per iteration
    std::optional<uint32_t> minPathLength{}, maxPathLength{};
    double mergeRadius = 0.05;  ///< constant over the iterations
    /// Relative bias that merging has for other reasons than the radiance's curvature, which the test computes itself.
    double otherMergeBias = 0;
};

/// In order of appearance in the table of the numerics notes: furnaces, lights over a floor, caustics, microfacets.
const std::vector<ClosedFormCase>& closedFormCases();

/// Settings of one case, apart from the technique. Seed 7; the merge radius does not shrink (α = 1).
RenderSettings settingsOf(const ClosedFormCase& c);

struct ExpectedBlock {
    double radiance = 0;
    /// Bound on |expectation of a merging technique − radiance|. To second order in r, the mean over a disk of radius r
    /// is the mean over the circle of radius r/√2.
    double mergeBias = 0;
};

/// Means over the part of the raster, both coordinates in pixels, by 48 × 48 midpoints.
ExpectedBlock expectedOf(const ClosedFormCase& c, double left, double top, double right, double bottom);

}  // namespace antipode::test
