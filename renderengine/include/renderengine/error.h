// The one exception type of the project. Libraries throw it and never print or exit; it is caught in `main`, in a
// server's session and in its render worker.
#pragma once

#include <stdexcept>
#include <string>

namespace antipode {

enum class ErrorCode {
    Usage,   ///< the caller asked for something that does not exist or does not fit together (exit code 2)
    Input,   ///< a scene, mesh, image or texture is missing, broken or invalid (exit code 1)
    Output,  ///< a file cannot be written (exit code 1)
    Device,  ///< no usable device, or the device failed (exit code 1)
};

/// One sentence that says what went wrong, where, and what to do about it.
class Error : public std::runtime_error {
public:
    Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
    ErrorCode code() const noexcept { return code_; }

private:
    ErrorCode code_;
};

}  // namespace antipode
