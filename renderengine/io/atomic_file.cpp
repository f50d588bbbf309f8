// Files that appear complete or not at all.
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <random>

#include <fcntl.h>
#include <unistd.h>

#include "renderengine/error.h"
#include "renderengine/io/descriptor.h"
#include "renderengine/io/files.h"
#include "renderengine/io/text.h"

namespace antipode {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const std::string& why) {
    throw Error(ErrorCode::Output, "Cannot write '" + path + "': " + why + ".");
}

/// The file to replace: what a symbolic link points to rather than the link.
fs::path resolveTarget(const std::string& path) {
    std::error_code code;
    if (path.empty() || fs::path(path).filename().empty()) fail(path, "it does not name a file");
    const fs::file_status status = fs::status(path, code);
    if (!fs::exists(status)) return path;
    if (fs::is_directory(status)) fail(path, "it is a folder");
    // Renaming over a device node such as /dev/null would replace the device itself.
    if (!fs::is_regular_file(status)) fail(path, "it is not a regular file");
    if (::access(path.c_str(), W_OK) != 0) fail(path, std::strerror(errno));
    fs::path resolved = fs::canonical(path, code);
    if (code) fail(path, code.message());
    return resolved;
}

/// A name that no other process makes up: those in different containers that share the folder can have the same id.
fs::path temporaryName(const fs::path& folder) {
    std::random_device random;
    const std::array<uint32_t, 2> number{random(), random()};
    return folder /
           (".antipode-" + hexadecimal({reinterpret_cast<const char*>(number.data()), sizeof number}) + ".tmp");
}

/// An open file in the target's folder that vanishes unless it is renamed to the target.
class TemporaryFile {
public:
    /// `path` is the name that messages show.
    explicit TemporaryFile(const std::string& path) : path_(path), target_(resolveTarget(path)) {
        do {
            temporary_ = temporaryName(target_.parent_path());
            file_ = openFile(temporary_, O_WRONLY | O_CREAT | O_EXCL);
        } while (!file_ && errno == EEXIST);
        if (!file_) fail(path_, std::strerror(errno));
    }
    ~TemporaryFile() {
        if (!temporary_.empty()) ::unlink(temporary_.c_str());
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    void write(std::string_view bytes) {
        if (const int error = writeFully(file_, bytes)) fail(path_, std::strerror(error));
    }

    /// Makes the content durable and visible under the target's name.
    void commit() {
        finish();
        replaceTarget();
        syncFolder();
    }

    /// The same, with what the target's name stood for before under another one.
    void commitKeeping(const std::string& previousSuffix) {
        finish();
        const fs::path previous = target_.string() + previousSuffix, old = temporaryName(target_.parent_path());
        // A second name for the old content, so that there is no instant without a file under the target's name, and
        // the generation before it is replaced only after the new one is in place.
        if (::link(target_.c_str(), old.c_str()) == 0) {
            try {
                replaceTarget();
            } catch (...) {
                ::unlink(old.c_str());
                throw;
            }
            if (::rename(old.c_str(), previous.c_str()) != 0) {
                const int error = errno;
                ::unlink(old.c_str());
                fail(previous, std::strerror(error));
            }
        } else {
            const bool first = errno == ENOENT;
            if (!first && ::rename(target_.c_str(), previous.c_str()) != 0) fail(previous, std::strerror(errno));
            replaceTarget();
        }
        syncFolder();
    }

private:
    void finish() {
        if (::fsync(file_.get()) != 0) fail(path_, std::strerror(errno));
        if (const int error = file_.close()) fail(path_, std::strerror(error));
    }
    void replaceTarget() {
        if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(path_, std::strerror(errno));
        temporary_.clear();
    }
    /// Makes the rename durable. Some network file systems cannot; the content is then complete but its name may be
    /// lost in a power failure, which is no reason to fail.
    void syncFolder() const {
        const fs::path folder = target_.has_parent_path() ? target_.parent_path() : fs::path(".");
        if (const Descriptor descriptor = openFile(folder, O_RDONLY | O_DIRECTORY)) ::fsync(descriptor.get());
    }

    std::string path_;
    fs::path target_, temporary_;
    Descriptor file_;
};

}  // namespace

void checkWritable(const std::string& path) { TemporaryFile probe(path); }

void writeFileAtomically(const std::string& path, std::string_view bytes) {
    TemporaryFile file(path);
    file.write(bytes);
    file.commit();
}

void writeFileAtomically(const std::string& path, const std::string& previousSuffix,
                         const std::function<void(const std::function<void(std::string_view)>&)>& write) {
    TemporaryFile file(path);
    write([&](std::string_view bytes) { file.write(bytes); });
    file.commitKeeping(previousSuffix);
}

}  // namespace antipode
