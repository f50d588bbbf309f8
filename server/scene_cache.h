// Blobs by content hash, on disk: verified, resumable, bounded.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "proto/farm.pb.h"

namespace antipode {

/// A file is named by its blob's hash and size; no client names a path. While it arrives, its name ends in ".part".
/// Bytes are verified where they are read, which takes its time, and not where they are written, so that writing never
/// does.
///
/// The folder is this user's alone (0700, files 0600), and what is in it is not followed where it is a link. One that
/// vanishes is made again, empty. Errors name no path: clients are told of them.
///
/// One process owns a folder at a time (a lock file sees to it). Blobs that are in use (pinned) are not evicted; others
/// go in order of last use, over restarts, too, when the bound would be exceeded. Parts count, and every file counts in
/// blocks of 4 KiB, so that a great many small ones are bounded as well. Thread-safe.
class SceneCache {
public:
    /// writeAt(): tests let it fail.
    using Write = std::function<int(const std::filesystem::path&, uint64_t offset, std::string_view bytes)>;

    /// Makes the folder where it is missing. Throws Error(Output) where it cannot be used or is another user's,
    /// Error(Usage) where another process owns it; these name it.
    SceneCache(const std::string& folder, uint64_t maxBytes, Write write = nullptr);
    ~SceneCache();
    SceneCache(const SceneCache&) = delete;
    SceneCache& operator=(const SceneCache&) = delete;

    /// Bytes of the blob that are here: all of them, those of a part that an earlier upload left, or 0.
    uint64_t available(const farm::BlobRef& blob) const;
    /// The blob, if it is here in full; its hash is checked, and what does not match is removed, which `wrong` is told.
    /// Takes as long as the file is large, without keeping other threads from the cache.
    std::shared_ptr<const std::string> find(const farm::BlobRef& blob, bool* wrong = nullptr);
    /// Appends to the part of a blob, which the last byte completes; takes as long as writing these bytes. Throws
    /// Error(Input) and changes nothing unless `offset` is available(): another upload was faster. Throws Error(Usage)
    /// for a blob larger than the bound, Error(Output) where the disk is full though all that may go has gone, or all
    /// else is pinned; the part then stays as it was or is removed.
    void append(const farm::BlobRef& blob, uint64_t offset, std::string_view bytes);

    /// Keeps a blob, here or to come, from being evicted. Counts.
    void pin(const farm::BlobRef& blob);
    void unpin(const farm::BlobRef& blob);

    /// On disk, in whole blocks.
    uint64_t bytes() const;
    uint64_t maxBytes() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace antipode
