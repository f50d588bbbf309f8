// Fields of messages by paths that people type: "camera.position", "material.Glass.ior", "sphere[2].radius".
#pragma once

#include <google/protobuf/message.h>

#include <string>

namespace antipode {

/// What becomes of objects that a path leads through and that are not there.
enum class Missing {
    Created,  ///< a message within, or the entry after a list's last; others are an error
    Skipped,  ///< at the top: the field is not set. Below an object that is there, as above.
};

/// Sets the field that `path` leads to; false where an object was missing and skipped. An entry of a list is given by
/// its number from 0 in brackets, by its name after a point, or not at all where there is only one; ".*" is all of
/// them. Numbers of a list are parted by commas; a field that holds a file's name is made absolute. What excludes the
/// field (look_at and forward, file and the values themselves) is taken out. Throws Error(Usage) for a field that does
/// not exist, with the nearest one, and for a value that is not of its type.
bool setField(google::protobuf::Message& root, const std::string& path, const std::string& value, Missing missing);

}  // namespace antipode
