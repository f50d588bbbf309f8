// Files, pipes and locks of the operating system, by descriptor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace antipode {

/// A descriptor that is closed. Empty, it stands for what could not be opened.
class Descriptor {
public:
    Descriptor() = default;
    explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
    ~Descriptor() { close(); }
    Descriptor(Descriptor&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(descriptor_, other.descriptor_);
        return *this;
    }

    explicit operator bool() const { return descriptor_ >= 0; }
    int get() const { return descriptor_; }
    /// The errno of a close that failed, or 0. On some file systems nothing else tells that what was written is lost.
    int close() noexcept;

private:
    int descriptor_ = -1;
};

/// open(2), closed in programs that this one starts; a file that it makes has this mode less the umask. Empty where it
/// fails, and errno says why.
Descriptor openFile(const std::string& path, int flags, unsigned mode = 0666);

/// Fills the buffer as far as the file goes and returns how far; nothing where a read fails, and errno says why.
std::optional<size_t> readFully(const Descriptor& file, char* buffer, size_t size);

/// Appends, or writes where the file stands. The errno of the write that failed, or 0.
int writeFully(const Descriptor& file, std::string_view bytes);
/// The same at an offset from the file's begin, wherever it stands.
int writeFullyAt(const Descriptor& file, uint64_t offset, std::string_view bytes);

}  // namespace antipode
