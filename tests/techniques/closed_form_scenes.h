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
/// Bodies that scatter light inside.
void addMediaCases(std::vector<ClosedFormCase>& cases);

}  // namespace antipode::test
