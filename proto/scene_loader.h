// From a file name to a scene that can be rendered.
#pragma once

#include <string>

#include "proto/scene_changes.h"
#include "renderengine/import_options.h"

namespace antipode {

/// Reads a .textproto scene, or imports any other file as a model, as `options` say, with these changes; the result is
/// validated. "-" is a .textproto on standard input. Throws Error(Input): for mistakes of writing as
/// "file:line:column: sentence", for mistakes of meaning as "file: sentence naming the object"; and Error(Usage) for
/// changes that make no sense.
Scene loadScene(const std::string& path, const ImportOptions& options = {}, const SceneChanges& changes = {});

/// The same for the text of a .textproto. `name` stands in messages, `directory` is where file names start.
Scene parseScene(const std::string& text, const std::string& name, const std::string& directory,
                 const ImportOptions& options = {}, const SceneChanges& changes = {});

/// Lower-case hexadecimal SHA-256 over everything in a scene that affects its image. Names and notices do not count;
/// the order of materials and surfaces does.
std::string sceneHash(const Scene& scene);

}  // namespace antipode
