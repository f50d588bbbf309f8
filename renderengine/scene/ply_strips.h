// Triangle strips of PLY files (`element tristrips`, as VripPack writes them), of which Assimp 5.2 keeps one triangle
// each.
#pragma once

#include <optional>
#include <string>

namespace antipode {

/// The file with faces in place of its strips, for Assimp; nothing where it has none. In a strip of v0 v1 v2 …, which
/// -1 ends, triangle i is (v_i, v_i+1, v_i+2), turned round where i is odd; those with two equal corners only lead on
/// and are left out.
///
/// Throws Error(Input), without the path, where the strips are not the last element, follow a list, or end too early.
std::optional<std::string> plyWithFaces(const std::string& path);

}  // namespace antipode
