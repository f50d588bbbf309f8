// Between the schema (scene.proto) and the engine's scene. Nothing here validates the result: see validate().
#pragma once

#include <filesystem>

#include "proto/scene.pb.h"
#include "renderengine/import_options.h"

namespace antipode {

/// A hand-written scene: helper shapes become triangles, files are read (relative to `directory`), directions get unit
/// length, triangles without area are dropped, a missing camera is added; decisions are said in `notices`.
/// `options` decide how models are read.
/// Throws Error(Input) naming the object and the field.
Scene resolveScene(const schema::Scene& scene, const std::filesystem::path& directory,
                   const ImportOptions& options = {});

/// A resolved scene as toProto wrote it, taken over bit for bit. A scene that refers to files or holds helper shapes is
/// refused, because who sends it has no say over this machine's files and memory. Throws Error(Input).
Scene fromProto(const schema::Scene& scene);

/// Whether the message holds what can be long: mesh arrays, texels and the environment map's values.
enum class Arrays { Included, LeftOut };

/// The resolved scene; in full, fromProto(toProto(s)) equals s in every field.
schema::Scene toProto(const Scene& scene, Arrays arrays = Arrays::Included);

}  // namespace antipode
