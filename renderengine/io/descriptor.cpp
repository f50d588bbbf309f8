#include "renderengine/io/descriptor.h"

#include <cerrno>

#include <fcntl.h>
#include <unistd.h>

namespace antipode {

int Descriptor::close() noexcept {
    if (descriptor_ < 0) return 0;
    return ::close(std::exchange(descriptor_, -1)) == 0 ? 0 : errno;
}

Descriptor openFile(const std::string& path, int flags, unsigned mode) {
    return Descriptor(::open(path.c_str(), flags | O_CLOEXEC, mode));
}

std::optional<size_t> readFully(const Descriptor& file, char* buffer, size_t size) {
    size_t filled = 0;
    while (filled < size) {
        const ssize_t count = ::read(file.get(), buffer + filled, size - filled);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return {};
        if (count == 0) break;
        filled += size_t(count);
    }
    return filled;
}

int writeFully(const Descriptor& file, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(file.get(), bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return errno;
        bytes.remove_prefix(size_t(written));
    }
    return 0;
}

int writeFullyAt(const Descriptor& file, uint64_t offset, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::pwrite(file.get(), bytes.data(), bytes.size(), off_t(offset));
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return errno;
        offset += uint64_t(written);
        bytes.remove_prefix(size_t(written));
    }
    return 0;
}

}  // namespace antipode
