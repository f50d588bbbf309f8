// Checkpoints on disk, in two generations, and whether one belongs to a job.
#include <cerrno>
#include <cstring>
#include <memory>

#include <fcntl.h>
#include <sys/stat.h>

#include "farm/jobs/checkpoint.h"
#include "farm/jobs/checkpoint_format.h"
#include "renderengine/error.h"
#include "renderengine/io/descriptor.h"
#include "renderengine/io/files.h"
#include "renderengine/setting_fields.h"

namespace antipode {
namespace {

constexpr const char* previousSuffix = ".previous";
/// The largest image, uncompressed, and then some: nothing larger is read.
constexpr uint64_t maxFileBytes = uint64_t(8) << 30;

[[noreturn]] void fail(const std::string& path, const std::string& why) {
    throw Error(ErrorCode::Input, "Cannot resume from '" + path + "': " + why);
}

std::string contentOf(const std::string& path) {
    // Without O_NONBLOCK a pipe under this name would hold up the program.
    const Descriptor file = openFile(path, O_RDONLY | O_NONBLOCK);
    struct stat status {};
    if (!file || ::fstat(file.get(), &status) != 0) fail(path, std::string(std::strerror(errno)) + ".");
    if (!S_ISREG(status.st_mode)) fail(path, "it is not a regular file.");
    if (uint64_t(status.st_size) > maxFileBytes) fail(path, "it is too large for a checkpoint.");
    std::string bytes(size_t(status.st_size), '\0');
    const std::optional<size_t> filled = readFully(file, bytes.data(), bytes.size());
    if (!filled) fail(path, std::string(std::strerror(errno)) + ".");
    bytes.resize(*filled);
    return bytes;
}

Checkpoint load(const std::string& path) {
    const std::string bytes = contentOf(path);
    try {
        return decodeCheckpoint(bytes);
    } catch (const Error& error) {
        fail(path, error.what());
    }
}

std::string text(const std::string& value) { return "'" + value + "'"; }
std::string text(Precision value) { return name(value); }
std::string text(Sampler value) { return name(value); }
std::string text(Guides value) { return name(value); }
std::string text(LayerSet value) { return name(value); }
std::string text(TransportSet value) { return name(value); }
std::string text(const PixelWindow& value) { return described(value); }
template <class T>
std::string text(T value) {
    if constexpr (std::is_same_v<T, bool>) return value ? "on" : "off";
    if constexpr (!std::is_floating_point_v<T>) return std::to_string(value);
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.17g", double(value));
    return digits;
}
template <class T>
std::string text(const std::optional<T>& value) {
    return value ? text(*value) : "unset";
}

template <class T>
void requireSame(std::string_view what, const T& before, const T& now) {
    if (before == now) return;
    throw Error(ErrorCode::Usage, "The checkpoint is of another job: its " + std::string(what) + " is " + text(before) +
                                      ", not " + text(now) + ".");
}

}  // namespace

void writeCheckpoint(const std::string& path, const Checkpoint& checkpoint) {
    writeFileAtomically(path, previousSuffix, [&](const auto& append) { encodeCheckpoint(checkpoint, append); });
}

bool checkpointExists(const std::string& path) {
    struct stat status {};
    return ::stat(path.c_str(), &status) == 0 || ::stat((path + previousSuffix).c_str(), &status) == 0;
}

LoadedCheckpoint loadCheckpoint(const std::string& path) {
    try {
        return {load(path), ""};
    } catch (const Error& newest) {
        try {
            Checkpoint previous = load(path + previousSuffix);
            return {std::move(previous), std::string(newest.what()) + " The checkpoint before it is taken, '" + path +
                                             previousSuffix + "'."};
        } catch (const Error&) {
            throw newest;
        }
    }
}

void requireSameJob(const Checkpoint& checkpoint, const JobDefinition& job) {
    const RenderSettings &before = checkpoint.job.settings, &now = job.settings;
    if (now.single || now.minPathLength)
        throw Error(ErrorCode::Usage, "The checkpoint is of another job: this one renders some of all paths only.");
    if (checkpoint.job.hash() == job.hash()) return;
    if (checkpoint.job.sceneHash != job.sceneHash)
        throw Error(ErrorCode::Usage, "The checkpoint is of another scene, or the scene has been changed since.");
    forEachField(before, [&](auto field, const auto& value) {
        if constexpr (field.role == Reach::Job) requireSame(field.range.words, value, now.*(field.member));
    });
    if (checkpoint.job.kernelHash == job.kernelHash)
        throw Error(ErrorCode::Usage, "The checkpoint is of another job: its settings are others.");
    throw Error(ErrorCode::Usage,
                "The checkpoint was made by a build with other kernels, whose iterations are not the same; use that "
                "build, or begin anew without the checkpoint.");
}

}  // namespace antipode
