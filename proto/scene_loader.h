// From a file name to a scene that can be rendered.
#pragma once

#include <string>

#include "renderengine/import_options.h"

namespace antipode {

/// Reads a .textproto scene, or imports any other file as a model, as `options` say; the result is validated. Throws
/// Error(Input): for mistakes of writing as "file:line:column: sentence", for mistakes of meaning as "file: sentence
/// naming the object".
Scene loadScene(const std::string& path, const ImportOptions& options = {});

/// The same for the text of a .textproto. `name` stands in messages, `directory` is where file names start.
Scene parseScene(const std::string& text, const std::string& name, const std::string& directory,
                 const ImportOptions& options = {});

/// Lower-case hexadecimal SHA-256 over everything in a scene that affects its image. Names and notices do not count;
/// the order of materials and surfaces does.
std::string sceneHash(const Scene& scene);

}  // namespace antipode
