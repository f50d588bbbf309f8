// What a command line changes of a scene: its environment, and single fields.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "proto/scene.pb.h"
#include "renderengine/scene.h"

namespace antipode {

/// "camera.position" and "0,1,2": a field of the schema (proto/field_path.h) and its value.
struct FieldChange {
    std::string path, value;
};

/// The environment first, then the fields in their order.
struct SceneChanges {
    std::optional<std::string> environmentFile;  ///< a map that replaces the scene's environment
    std::vector<FieldChange> fields;

    bool empty() const { return !environmentFile && fields.empty(); }
};

/// Changes what a scene's text says itself; returns the changes of objects that it does not have and that what it
/// refers to may bring. Throws Error(Usage).
SceneChanges changeWritten(const SceneChanges& changes, schema::Scene& scene);

/// Changes a scene whose files are read. Helper shapes, models and transforms are no longer there. Throws Error(Usage)
/// for a path or value of the wrong kind, Error(Input) for a file or reference that leads nowhere.
void changeScene(const SceneChanges& changes, Scene& scene);

}  // namespace antipode
