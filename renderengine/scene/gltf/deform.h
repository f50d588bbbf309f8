// Morph targets and skins.
#pragma once

#include <vector>

#include "scene/affine.h"
#include "scene/gltf/document.h"

namespace antipode::gltf {

/// What moves a mesh's vertices in its own space or, with a skin, puts them into world space.
struct Deformation {
    std::vector<double> morphWeights;   ///< by target; those that are missing are 0
    std::vector<Affine> jointMatrices;  ///< of the skin: from the mesh's space at rest to world space
    Affine unbound;                     ///< with a skin, for vertices that no joint holds
};

/// Adds the targets of a primitive to the vertices as they stand in the file. Throws Error(Input).
void applyMorphTargets(const Document& document, const json& primitive, const std::vector<double>& weights, Mesh& mesh);

/// The joints that hold a vertex: at most four of each set that the file has.
struct Influences {
    std::vector<std::array<float, 4>> joints, weights;  ///< as many as vertices
};

/// Moves every vertex by the mean of its joints' matrices. Throws Error(Input) where a joint does not exist.
void applySkin(const std::vector<Influences>& sets, const Deformation& deformation, Mesh& mesh);

/// The joint matrices of a skin; one without inverse bind matrices was bound in world space. Throws Error(Input).
std::vector<Affine> jointMatrices(const Document& document, size_t skin, const std::vector<Affine>& nodesToWorld);

}  // namespace antipode::gltf
