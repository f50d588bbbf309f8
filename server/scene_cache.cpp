#include "server/scene_cache.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <mutex>
#include <unordered_map>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "terminal/text.h"
#include "proto/wire/scene_package.h"
#include "renderengine/error.h"
#include "renderengine/io/descriptor.h"
#include "renderengine/io/text.h"
#include "server/blob_file.h"

namespace antipode {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t blockBytes = 4096;

uint64_t onDisk(uint64_t bytes) { return (bytes + blockBytes - 1) / blockBytes * blockBytes; }

/// Holds a folder for this process.
class FolderLock {
public:
    explicit FolderLock(const fs::path& folder) {
        const std::string path = (folder / "lock").string();
        file_ = openFile(path, O_RDWR | O_CREAT | O_NOFOLLOW, 0600);
        if (!file_)
            throw Error(ErrorCode::Output,
                        "Cannot use the cache folder: cannot open '" + path + "': " + std::strerror(errno) + ".");
        if (::flock(file_.get(), LOCK_EX | LOCK_NB) == 0) return;
        const int failure = errno;
        if (failure == EWOULDBLOCK)
            throw Error(ErrorCode::Usage, "The cache folder '" + folder.string() +
                                              "' is in use by another process: give each server its own.");
        throw Error(ErrorCode::Output, "Cannot lock '" + path + "': " + std::strerror(failure) + ".");
    }

private:
    Descriptor file_;
};

/// Where others may write, somebody else may have put a folder, or a link, under the name that this server will use.
fs::path privateFolder(const std::string& folder) {
    const auto fail = [&](const std::string& why) {
        throw Error(ErrorCode::Output, "Cannot use the cache folder '" + folder + "': " + why + ".");
    };
    std::error_code code;
    fs::create_directories(fs::absolute(folder).lexically_normal().parent_path(), code);
    if (!code && ::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) code.assign(errno, std::generic_category());
    if (code) fail(code.message());
    struct stat status = {};
    if (::lstat(folder.c_str(), &status) != 0) fail(std::strerror(errno));
    if (status.st_uid != ::geteuid()) fail("it is another user's; name one of your own with --cache");
    if (::stat(folder.c_str(), &status) != 0) fail(std::strerror(errno));
    if (!S_ISDIR(status.st_mode)) fail("a file is in its place");
    if (status.st_uid != ::geteuid()) fail("it is another user's; name one of your own with --cache");
    if ((status.st_mode & 077) != 0 && ::chmod(folder.c_str(), 0700) != 0) fail(std::strerror(errno));
    return folder;
}

}  // namespace

struct SceneCache::Impl {
    struct Entry {
        bool whole = false;  // all bytes are there; whether they are right, find() tells
        uint64_t bytes = 0;  // in the file
        uint64_t use = 0;    // its place in byUse
    };

    Impl(const std::string& path, uint64_t bound, Write writer)
        : folder(privateFolder(path)), lock(std::in_place, folder), maxBytes(bound), write(std::move(writer)) {
        index();
        makeRoom(0, "");
    }

    // ---- What is here

    fs::path pathOf(const std::string& key, bool part) const { return folder / blobPath(key, part); }

    void index() {
        struct Found {
            fs::file_time_type used;
            BlobFile file;
            uint64_t bytes;
        };
        std::vector<Found> found;
        try {
            for (const auto& fan : fs::directory_iterator(folder)) {
                if (!fan.is_directory() || fan.is_symlink()) continue;
                for (const auto& entry : fs::directory_iterator(fan)) {
                    const auto file = parseBlobName(entry.path().filename().string());
                    if (!file || entry.is_symlink() || !entry.is_regular_file()) continue;
                    if (entry.path() != pathOf(file->key, file->part)) continue;
                    found.push_back({entry.last_write_time(), *file, entry.file_size()});
                }
            }
        } catch (const fs::filesystem_error& error) {
            throw Error(ErrorCode::Output,
                        "Cannot read the cache folder '" + folder.string() + "': " + error.code().message() + ".");
        }
        std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.used < b.used; });
        for (const Found& f : found) adopt(f.file, f.bytes);
    }

    /// Takes a file of an earlier process over, unless no sound process would have left it like that.
    void adopt(const BlobFile& file, uint64_t bytes) {
        const bool sound = file.part ? bytes > 0 && bytes <= file.size : bytes == file.size;
        if (!sound || entries.contains(file.key)) {
            std::error_code ignored;
            fs::remove(pathOf(file.key, file.part), ignored);
            return;
        }
        Entry& entry = add(file.key);
        entry.whole = !file.part;
        entry.bytes = bytes;
        held += onDisk(bytes);
        if (!file.part || bytes < file.size) return;
        try {
            complete(file.key, entry);  // the process ended between the last byte and the new name
        } catch (const Error&) {
            // It has been removed and has to be sent again.
        }
    }

    Entry& add(const std::string& key) {
        Entry& entry = entries[key];
        entry.use = ++uses;
        byUse.emplace(entry.use, key);
        return entry;
    }

    void touch(const std::string& key, Entry& entry) {
        byUse.erase(entry.use);
        entry.use = ++uses;
        byUse.emplace(entry.use, key);
    }

    void remove(const std::string& key) {
        const auto entry = entries.find(key);
        std::error_code ignored;
        fs::remove(pathOf(key, !entry->second.whole), ignored);
        held -= onDisk(entry->second.bytes);
        byUse.erase(entry->second.use);
        entries.erase(entry);
    }

    /// Evicts until `growth` more bytes fit. `spared` is not evicted.
    void makeRoom(uint64_t growth, const std::string& spared) {
        for (auto next = byUse.begin(); next != byUse.end() && held + growth > maxBytes;) {
            const std::string key = (next++)->second;
            if (key != spared && !pins.contains(key)) remove(key);
        }
        if (growth > 0 && held + growth > maxBytes)
            throw Error(ErrorCode::Output, "The scene cache of " + byteSize(maxBytes) +
                                               " is full of scenes that are in use: try again later.");
    }

    /// The one that was used longest ago and may go. False where there is none.
    bool evictOne(const std::string& spared) {
        const auto oldest = std::ranges::find_if(
            byUse, [&](const auto& entry) { return entry.second != spared && !pins.contains(entry.second); });
        if (oldest == byUse.end()) return false;
        remove(std::string(oldest->second));
        return true;
    }

    /// Somebody has removed the folder: what was in it has to be sent again.
    void startAnewIfGone() {
        if (std::error_code code; fs::exists(folder, code) || code) return;
        entries.clear();
        byUse.clear();
        held = 0;
        lock.reset();
        privateFolder(folder.string());
        lock.emplace(folder);
    }

    // ---- What comes

    void append(const farm::BlobRef& blob, uint64_t offset, std::string_view bytes) {
        const std::string key = blobKey(blob);
        if (blob.size() > maxBytes || onDisk(blob.size()) > maxBytes)
            throw Error(ErrorCode::Usage, "A blob of " + byteSize(blob.size()) + " exceeds the scene cache of " +
                                              byteSize(maxBytes) + ".");
        startAnewIfGone();
        const auto known = entries.find(key);
        const uint64_t have = known == entries.end() ? 0 : known->second.bytes;
        if (offset != have || bytes.size() > blob.size() - have)
            throw Error(ErrorCode::Input, "The blob " + key + " is here up to byte " + std::to_string(have) +
                                              "; what came does not go there.");
        if (bytes.empty()) return;
        makeRoom(onDisk(have + bytes.size()) - onDisk(have), key);
        Entry& entry = known == entries.end() ? add(key) : known->second;
        try {
            writePart(key, entry, bytes);
        } catch (const Error&) {
            if (std::error_code code; !fs::exists(pathOf(key, true), code)) remove(key);
            throw;
        }
        if (entry.bytes == blob.size())
            complete(key, entry);
        else
            touch(key, entry);
    }

    void writePart(const std::string& key, Entry& entry, std::string_view bytes) {
        const fs::path path = pathOf(key, true);
        while (const int failure = write(path, entry.bytes, bytes)) {
            const bool full = failure == ENOSPC || failure == EDQUOT;
            if (full && evictOne(key)) continue;
            throw Error(ErrorCode::Output,
                        std::string("Cannot write to the server's scene cache: ") + std::strerror(failure) + ".");
        }
        held += onDisk(entry.bytes + bytes.size()) - onDisk(entry.bytes);
        entry.bytes += bytes.size();
    }

    /// All bytes are here. Nothing is synced, and nothing hashed, which could take seconds: find() does, so that wrong
    /// bytes and what a power failure spoils are found out before they are used.
    void complete(const std::string& key, Entry& entry) {
        std::error_code code;
        fs::rename(pathOf(key, true), pathOf(key, false), code);
        if (code) {
            remove(key);
            throw Error(ErrorCode::Output, "Cannot rename the blob " + key + ": " + code.message() + ".");
        }
        entry.whole = true;
        touch(key, entry);
    }

    // ---- What is asked for

    std::shared_ptr<const std::string> find(const farm::BlobRef& blob, bool& wrong) {
        const std::string key = blobKey(blob);
        wrong = false;
        if (!isWhole(key)) return nullptr;
        auto bytes = readWholeFile(pathOf(key, false), blob.size());
        const bool sound = bytes && sha256Of(*bytes) == blob.sha256();
        wrong = bytes && !sound;
        const std::lock_guard guard(mutex);
        startAnewIfGone();
        const auto entry = entries.find(key);
        if (entry != entries.end() && entry->second.whole) {
            if (sound)
                use(key, entry->second);
            else
                remove(key);
        }
        return sound ? std::make_shared<const std::string>(std::move(*bytes)) : nullptr;
    }

    bool isWhole(const std::string& key) const {
        const std::lock_guard guard(mutex);
        const auto entry = entries.find(key);
        return entry != entries.end() && entry->second.whole;
    }

    /// The file's time of modification is what a later process knows of its last use.
    void use(const std::string& key, Entry& entry) {
        touch(key, entry);
        ::utimensat(AT_FDCWD, pathOf(key, false).c_str(), nullptr, 0);
    }

    void unpin(const std::string& key) {
        const auto pin = pins.find(key);
        if (pin != pins.end() && --pin->second == 0) pins.erase(pin);
    }

    const fs::path folder;
    std::optional<FolderLock> lock;
    const uint64_t maxBytes;
    const Write write;
    mutable std::mutex mutex;  // of all below
    std::unordered_map<std::string, Entry> entries;
    std::map<uint64_t, std::string> byUse;
    std::unordered_map<std::string, uint32_t> pins;
    uint64_t held = 0, uses = 0;
};

SceneCache::SceneCache(const std::string& folder, uint64_t maxBytes, Write write)
    : impl_(std::make_unique<Impl>(folder, maxBytes, write ? std::move(write) : writeAt)) {}
SceneCache::~SceneCache() = default;

uint64_t SceneCache::available(const farm::BlobRef& blob) const {
    const std::string key = blobKey(blob);
    const std::lock_guard guard(impl_->mutex);
    const auto entry = impl_->entries.find(key);
    return entry == impl_->entries.end() ? 0 : entry->second.bytes;
}

std::shared_ptr<const std::string> SceneCache::find(const farm::BlobRef& blob, bool* wrong) {
    bool ignored = false;
    return impl_->find(blob, wrong ? *wrong : ignored);
}

void SceneCache::append(const farm::BlobRef& blob, uint64_t offset, std::string_view bytes) {
    const std::lock_guard guard(impl_->mutex);
    impl_->append(blob, offset, bytes);
}

void SceneCache::pin(const farm::BlobRef& blob) {
    const std::lock_guard guard(impl_->mutex);
    ++impl_->pins[blobKey(blob)];
}

void SceneCache::unpin(const farm::BlobRef& blob) {
    const std::lock_guard guard(impl_->mutex);
    impl_->unpin(blobKey(blob));
}

uint64_t SceneCache::bytes() const {
    const std::lock_guard guard(impl_->mutex);
    return impl_->held;
}

uint64_t SceneCache::maxBytes() const { return impl_->maxBytes; }

}  // namespace antipode
