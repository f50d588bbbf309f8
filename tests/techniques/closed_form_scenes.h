// The rows of the table of closed forms, by subject.
#pragma once

#include "tests/techniques/closed_form_case.h"

namespace antipode::test {

/// Uniform radiance by symmetry: furnaces and integrating spheres.
void addFurnaceCases(std::vector<ClosedFormCase>& cases);
/// A floor under one light.
void addFloorCases(std::vector<ClosedFormCase>& cases);
/// Light through glass onto a floor, and microfacets under a uniform sky.
void addOpticsCases(std::vector<ClosedFormCase>& cases);

/// A camera at (x, y, height) above the plane z = 0 that looks down on a square of the given half-width.
Camera lookDownOn(double x, double y, double height, double halfWidth);

}  // namespace antipode::test
