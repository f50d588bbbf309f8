#include "server/scene_cache.h"

#include <chrono>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "proto/wire/loop_watch.h"
#include "proto/wire/scene_package.h"
#include "renderengine/io/text.h"
#include "server/blob_file.h"
#include "tests/film/expect_error.h"
#include "tests/film/temporary_folder.h"

namespace antipode::test {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t block = 4096;

/// Bytes that differ with `n`, and their name.
struct TestBlob {
    explicit TestBlob(int n, size_t size = block) : bytes(size, char('a' + n)) {
        bytes += std::to_string(n);
        bytes = bytes.substr(bytes.size() - size);
        reference.set_sha256(sha256Of(bytes));
        reference.set_size(size);
    }
    std::string bytes;
    farm::BlobRef reference;
};

class SceneCacheTest : public ::testing::Test {
protected:
    void open(uint64_t maxBytes = 100 * block, SceneCache::Write write = nullptr) {
        cache.reset();
        cache.emplace(root(), maxBytes, std::move(write));
    }
    std::string root() const { return folder.file("cache"); }
    fs::path path(const TestBlob& blob) const {
        const std::string hash = hexadecimal(blob.reference.sha256());
        return fs::path(root()) / hash.substr(0, 2) / (hash + "-" + std::to_string(blob.reference.size()));
    }
    fs::path partPath(const TestBlob& blob) const { return path(blob).string() + ".part"; }
    void put(const TestBlob& blob) { cache->append(blob.reference, 0, blob.bytes); }
    bool has(const TestBlob& blob) {
        const auto found = cache->find(blob.reference);
        EXPECT_TRUE(!found || *found == blob.bytes);
        return found != nullptr;
    }

    TemporaryFolder folder;
    std::optional<SceneCache> cache;
};

void write(const fs::path& path, const std::string& bytes) {
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << bytes;
}

TEST_F(SceneCacheTest, KeepsABlobThatComesInPieces) {
    open();
    const TestBlob blob(1, 10000);
    EXPECT_EQ(cache->available(blob.reference), 0u);
    EXPECT_FALSE(has(blob));
    cache->append(blob.reference, 0, std::string_view(blob.bytes).substr(0, 6000));
    EXPECT_EQ(cache->available(blob.reference), 6000u);
    EXPECT_FALSE(has(blob));
    cache->append(blob.reference, 6000, std::string_view(blob.bytes).substr(6000));
    EXPECT_EQ(cache->available(blob.reference), 10000u);
    EXPECT_TRUE(has(blob));
    EXPECT_EQ(cache->bytes(), 3 * block);
    EXPECT_TRUE(fs::exists(path(blob)));
    EXPECT_FALSE(fs::exists(partPath(blob)));
}

TEST_F(SceneCacheTest, ALaterProcessFindsBlobsAndResumesParts) {
    open();
    const TestBlob whole(1), part(2, 9000);
    put(whole);
    cache->append(part.reference, 0, std::string_view(part.bytes).substr(0, 5000));
    open();
    EXPECT_TRUE(has(whole));
    EXPECT_EQ(cache->available(part.reference), 5000u);
    EXPECT_EQ(cache->bytes(), 3 * block);
    cache->append(part.reference, 5000, std::string_view(part.bytes).substr(5000));
    EXPECT_TRUE(has(part));
}

double cpuSeconds() {
    timespec time{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

/// Whoever appends is an event loop that others wait for.
TEST_F(SceneCacheTest, ResumesALargePartAtOnce) {
    farm::BlobRef large;
    large.set_sha256(sha256Of("not what comes"));
    large.set_size(600 << 20);
    const std::string hash = hexadecimal(large.sha256());
    const fs::path part = fs::path(root()) / hash.substr(0, 2) / (hash + "-" + std::to_string(large.size()) + ".part");
    write(part, "");
    fs::resize_file(part, 512 << 20);  // without blocks on disk
    double start = cpuSeconds();
    open(1ull << 30);
    EXPECT_LT(cpuSeconds() - start, wire::LoopWatch::mostSeconds);
    ASSERT_EQ(cache->available(large), 512u << 20);
    start = cpuSeconds();
    cache->append(large, 512 << 20, std::string(64 << 10, 'x'));
    EXPECT_LT(cpuSeconds() - start, wire::LoopWatch::mostSeconds);
    EXPECT_EQ(cache->available(large), (512u << 20) + (64u << 10));
}

TEST_F(SceneCacheTest, RemovesABlobOfAWrongHash) {
    open();
    const TestBlob blob(1);
    std::string wrong = blob.bytes;
    wrong[100] ^= 1;
    cache->append(blob.reference, 0, wrong);
    bool isWrong = false;
    EXPECT_FALSE(cache->find(blob.reference, &isWrong));
    EXPECT_TRUE(isWrong);
    EXPECT_EQ(cache->available(blob.reference), 0u);
    EXPECT_EQ(cache->bytes(), 0u);
    EXPECT_FALSE(fs::exists(path(blob)));
    EXPECT_FALSE(fs::exists(partPath(blob)));
    put(blob);
    EXPECT_TRUE(has(blob));
}

TEST_F(SceneCacheTest, ASecondUploadOfABlobDoesNotSpoilIt) {
    open();
    const TestBlob blob(1, 9000);
    const std::string_view bytes = blob.bytes;
    cache->append(blob.reference, 0, bytes.substr(0, 3000));
    for (const uint64_t offset : {uint64_t(0), uint64_t(2999), uint64_t(3001), UINT64_MAX})
        expectError(ErrorCode::Input, "does not go there", [&] { cache->append(blob.reference, offset, "xyz"); });
    expectError(ErrorCode::Input, "does not go there",
                [&] { cache->append(blob.reference, 3000, std::string(6001, 'x')); });
    cache->append(blob.reference, 3000, bytes.substr(3000));
    expectError(ErrorCode::Input, "does not go there", [&] { cache->append(blob.reference, 0, bytes); });
    EXPECT_TRUE(has(blob));
}

TEST_F(SceneCacheTest, AWrongSizeIsAnotherBlob) {
    open();
    const TestBlob blob(1);
    put(blob);
    farm::BlobRef longer = blob.reference;
    longer.set_size(block + 1);
    EXPECT_EQ(cache->available(longer), 0u);
    EXPECT_FALSE(cache->find(longer));
    cache->append(longer, 0, std::string(block + 1, 'x'));
    EXPECT_FALSE(cache->find(longer));
    EXPECT_TRUE(has(blob));
}

TEST_F(SceneCacheTest, EvictsWhatWasUsedLongestAgo) {
    open(3 * block);
    const TestBlob a(1), b(2), c(3), d(4);
    put(a), put(b), put(c);
    EXPECT_TRUE(has(a));
    put(d);
    EXPECT_EQ(cache->available(b.reference), 0u);
    EXPECT_FALSE(fs::exists(path(b)));
    EXPECT_TRUE(has(a) && has(c) && has(d));
    EXPECT_LE(cache->bytes(), cache->maxBytes());
}

TEST_F(SceneCacheTest, RemembersTheLastUseOverRestarts) {
    open(3 * block);
    const TestBlob a(1), b(2), c(3), d(4);
    put(a), put(b), put(c);
    const auto now = fs::file_time_type::clock::now();
    fs::last_write_time(path(a), now - std::chrono::hours(3));
    fs::last_write_time(path(b), now - std::chrono::hours(2));
    fs::last_write_time(path(c), now - std::chrono::hours(1));
    EXPECT_TRUE(has(a));
    open(3 * block);
    put(d);
    EXPECT_TRUE(has(a));
    EXPECT_FALSE(has(b));
}

TEST_F(SceneCacheTest, PartsCountAndAreEvicted) {
    open(3 * block);
    const TestBlob part(1, 2 * block), b(2), c(3);
    cache->append(part.reference, 0, part.bytes.substr(0, block + 1));
    EXPECT_EQ(cache->bytes(), 2 * block);
    put(b), put(c);
    EXPECT_EQ(cache->available(part.reference), 0u);
    EXPECT_FALSE(fs::exists(partPath(part)));
    EXPECT_TRUE(has(b) && has(c));
}

TEST_F(SceneCacheTest, PinnedBlobsStay) {
    open(2 * block);
    const TestBlob a(1), b(2), c(3);
    cache->pin(a.reference);  // to come
    cache->pin(a.reference);
    put(a), put(b), put(c);
    EXPECT_TRUE(has(a) && has(c) && !has(b));
    cache->pin(c.reference);
    expectError(ErrorCode::Output, "in use", [&] { put(b); });
    EXPECT_EQ(cache->available(b.reference), 0u);
    EXPECT_EQ(cache->bytes(), 2 * block);
    cache->unpin(a.reference);
    expectError(ErrorCode::Output, "in use", [&] { put(b); });
    cache->unpin(a.reference);
    put(b);
    EXPECT_TRUE(!has(a) && has(b) && has(c));
}

TEST_F(SceneCacheTest, RefusesABlobLargerThanTheBound) {
    open(2 * block);
    const TestBlob large(1, 2 * block + 1);
    expectError(ErrorCode::Usage, "exceeds", [&] { cache->append(large.reference, 0, "x"); });
    farm::BlobRef huge = large.reference;
    huge.set_size(UINT64_MAX);
    expectError(ErrorCode::Usage, "exceeds", [&] { cache->append(huge, 0, "x"); });
    EXPECT_EQ(cache->bytes(), 0u);
}

TEST_F(SceneCacheTest, RefusesReferencesThatAreNone) {
    open();
    farm::BlobRef blob;
    blob.set_sha256("../../../../../../../../etc/x");
    blob.set_size(1);
    expectError(ErrorCode::Usage, "32 bytes", [&] { cache->available(blob); });
    blob.set_sha256(std::string(32, 'x'));
    blob.set_size(0);
    expectError(ErrorCode::Usage, "at least 1", [&] { cache->pin(blob); });
}

TEST_F(SceneCacheTest, FindsDamageAndRemovesTheBlob) {
    open();
    for (const auto& damage : {
             std::function<void(const fs::path&, const std::string&)>([](const fs::path&file, std::string bytes) {
                 bytes[7] ^= 4;
                 write(file, bytes);
             }),
             {[](const fs::path&file, const std::string&bytes) { write(file, bytes + "x"); }},
             {[](const fs::path&file, const std::string&bytes) { write(file, bytes.substr(1)); }},
             {[](const fs::path&file, const std::string&) { fs::remove(file); }},
         }) {
        const TestBlob blob(1);
        put(blob);
        damage(path(blob), blob.bytes);
        EXPECT_FALSE(has(blob));
        EXPECT_EQ(cache->available(blob.reference), 0u);
        EXPECT_EQ(cache->bytes(), 0u);
        EXPECT_FALSE(fs::exists(path(blob)));
    }
}

TEST_F(SceneCacheTest, LeavesForeignFilesAloneAndRemovesUnsoundOnes) {
    const TestBlob sound(1), shortened(2), complete(3), damaged(4), misplaced(5), empty(6);
    write(fs::path(root()) / "notes.txt", "mine");
    write(fs::path(root()) / "ab" / "notes.txt", "mine");
    write(fs::path(root()) / "ab" / (std::string(64, 'A') + "-5"), "mine!");
    write(fs::path(root()) / "ab" / (std::string(64, 'a') + "-05"), "mine!");
    write(fs::path(root()) / "zz" / path(misplaced).filename(), misplaced.bytes);
    write(path(sound), sound.bytes);
    write(path(shortened), shortened.bytes.substr(1));
    write(partPath(complete), complete.bytes);  // the process ended just before the new name
    write(partPath(damaged), std::string(damaged.bytes.size(), 'x'));
    write(partPath(empty), "");
    write(partPath(sound), "x");  // beside the whole blob
    open();
    EXPECT_TRUE(has(sound) && has(complete));
    EXPECT_FALSE(has(shortened) || has(misplaced) || has(damaged));
    EXPECT_EQ(cache->available(damaged.reference), 0u);
    EXPECT_FALSE(fs::exists(path(shortened)) || fs::exists(partPath(damaged)) || fs::exists(partPath(empty)));
    EXPECT_EQ(cache->bytes(), 2 * block);
    EXPECT_TRUE(fs::exists(fs::path(root()) / "notes.txt") && fs::exists(fs::path(root()) / "ab" / "notes.txt"));
    EXPECT_TRUE(fs::exists(fs::path(root()) / "ab" / (std::string(64, 'A') + "-5")));
    EXPECT_TRUE(fs::exists(fs::path(root()) / "zz" / path(misplaced).filename()));
}

TEST_F(SceneCacheTest, DoesNotFollowLinks) {
    const TestBlob blob(1);
    const std::string outside = folder.file("outside");
    write(outside, blob.bytes);
    fs::create_directories(path(blob).parent_path());
    fs::create_symlink(outside, path(blob));
    open();
    EXPECT_FALSE(has(blob));
    put(blob);
    EXPECT_TRUE(has(blob));
    const TestBlob other(2);
    fs::create_directories(path(other).parent_path());
    fs::create_symlink(outside, partPath(other));
    expectError(ErrorCode::Output, "Cannot write", [&] { put(other); });
    put(other);  // the link has been removed
    EXPECT_TRUE(has(other));
    std::ifstream file(outside);
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), blob.bytes);
}

unsigned modeOf(const fs::path& path) { return unsigned(fs::status(path).permissions()) & 0777; }

TEST_F(SceneCacheTest, IsThisUsersAlone) {
    const mode_t before = ::umask(0);
    fs::create_directories(root());
    fs::permissions(root(), fs::perms(0777));
    open();
    const TestBlob blob(1);
    put(blob);
    ::umask(before);
    EXPECT_EQ(modeOf(root()), 0700u) << "also where it was there before";
    EXPECT_EQ(modeOf(fs::path(root()) / "lock"), 0600u);
    EXPECT_EQ(modeOf(path(blob).parent_path()), 0700u);
    EXPECT_EQ(modeOf(path(blob)), 0600u);
}

TEST_F(SceneCacheTest, FollowsNoLinkForItsLockAndItsFolders) {
    const std::string outside = folder.file("outside");
    fs::create_directories(outside);
    write(folder.file("precious"), "precious");
    fs::create_directories(root());
    fs::create_symlink(folder.file("precious"), fs::path(root()) / "lock");
    expectError(ErrorCode::Output, "lock", [&] { open(); });
    fs::remove(fs::path(root()) / "lock");
    const TestBlob blob(1);
    fs::create_directory_symlink(outside, path(blob).parent_path());
    open();
    put(blob);
    EXPECT_TRUE(has(blob));
    EXPECT_TRUE(fs::is_empty(outside));
}

TEST_F(SceneCacheTest, AnotherUsersFolderIsNotUsed) {
    if (::geteuid() != 0) GTEST_SKIP() << "only root can give a folder away";
    fs::create_directories(root());
    ASSERT_EQ(::chown(root().c_str(), 12345, 12345), 0);
    expectError(ErrorCode::Output, "another user's", [&] { open(); });
}

TEST_F(SceneCacheTest, AFolderThatVanishesIsMadeAgain) {
    open();
    const TestBlob a(1), b(2, 9000);
    put(a);
    cache->append(b.reference, 0, b.bytes.substr(0, 5000));
    fs::remove_all(root());
    expectError(ErrorCode::Input, "up to byte 0", [&] { cache->append(b.reference, 5000, b.bytes.substr(5000)); });
    EXPECT_EQ(cache->available(a.reference), 0u);
    put(b), put(a);
    EXPECT_TRUE(has(a) && has(b));
    EXPECT_EQ(modeOf(root()), 0700u);
    expectError(ErrorCode::Usage, "in use by another process", [&] { SceneCache second(root(), block); });
    fs::remove_all(root());
    EXPECT_FALSE(has(a));
    EXPECT_EQ(cache->bytes(), 0u);
}

TEST_F(SceneCacheTest, AFullDiskEvicts) {
    uint64_t room = 3;
    const auto files = [this] {
        uint64_t count = 0;
        for (const auto& entry : fs::recursive_directory_iterator(root())) count += entry.is_regular_file();
        return count - 1;  // the lock
    };
    open(100 * block, [&](const fs::path& path, uint64_t offset, std::string_view bytes) {
        return files() < room ? writeAt(path, offset, bytes) : ENOSPC;
    });
    const TestBlob a(1), b(2), c(3), d(4);
    put(a), put(b), put(c), put(d);
    EXPECT_EQ(cache->available(a.reference), 0u);
    EXPECT_TRUE(has(b) && has(c) && has(d));
    for (const TestBlob* blob : {&b, &c, &d}) cache->pin(blob->reference);
    try {
        put(a);
        ADD_FAILURE() << "there was no room";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::Output);
        EXPECT_EQ(std::string(error.what()).find(root()), std::string::npos) << "clients are told a path";
    }
    EXPECT_TRUE(has(b) && has(c) && has(d));
}

TEST_F(SceneCacheTest, ALowerBoundHoldsFromTheStart) {
    open();
    const TestBlob a(1), b(2), c(3);
    put(a), put(b), put(c);
    open(2 * block);
    EXPECT_EQ(cache->bytes(), 2 * block);
}

TEST_F(SceneCacheTest, OneProcessOwnsTheFolder) {
    open();
    expectError(ErrorCode::Usage, "in use by another process", [&] { SceneCache second(root(), block); });
    cache.reset();
    SceneCache second(root(), block);
}

TEST_F(SceneCacheTest, SaysWhereItCannotBe) {
    write(folder.file("file"), "x");
    expectError(ErrorCode::Output, "file", [&] { SceneCache bad(folder.file("file"), block); });
    expectError(ErrorCode::Output, "file/below", [&] { SceneCache bad(folder.file("file/below"), block); });
}

/// While it lives, no file of this process grows beyond `bytes`: what a full disk looks like.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        rlimit limit = before_;
        limit.rlim_cur = bytes;
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

private:
    rlimit before_{};
    void (*handler_)(int);
};

TEST_F(SceneCacheTest, AFullDiskLeavesAPartToResume) {
    open();
    const TestBlob blob(1, 10000);
    const std::string_view bytes = blob.bytes;
    cache->append(blob.reference, 0, bytes.substr(0, 3000));
    {
        const FileSizeLimit full(5000);
        expectError(ErrorCode::Output, "Cannot write",
                    [&] { cache->append(blob.reference, 3000, bytes.substr(3000)); });
        const TestBlob other(2, 6000);
        expectError(ErrorCode::Output, "Cannot write", [&] { put(other); });
        EXPECT_EQ(cache->available(other.reference), 0u);
        EXPECT_FALSE(fs::exists(partPath(other)));
    }
    EXPECT_EQ(cache->available(blob.reference), 3000u);
    EXPECT_EQ(fs::file_size(partPath(blob)), 3000u);
    EXPECT_EQ(cache->bytes(), block);
    cache->append(blob.reference, 3000, bytes.substr(3000));
    EXPECT_TRUE(has(blob));
}

/// A child uploads and is killed at a different time in each round: wherever that was, the blob can be completed. (What
/// a kill between two system calls leaves is also made on purpose in LeavesForeignFilesAloneAndRemovesUnsoundOnes.)
TEST_F(SceneCacheTest, AKillAtAnyTimeLeavesPartsAndWholeBlobs) {
    const TestBlob blob(1, 300000);
    for (int round = 0; round < 20; ++round) {
        fs::remove_all(root());
        const pid_t child = ::fork();
        ASSERT_GE(child, 0);
        if (child == 0) {
            SceneCache own(root(), 100 * block);
            for (size_t at = 0; at < blob.bytes.size(); at += 1000)
                own.append(blob.reference, at, std::string_view(blob.bytes).substr(at, 1000));
            ::_exit(0);
        }
        ::usleep(useconds_t(200 * round));
        ::kill(child, SIGKILL);
        ::waitpid(child, nullptr, 0);
        open();
        const uint64_t have = cache->available(blob.reference);
        if (have < blob.bytes.size()) cache->append(blob.reference, have, std::string_view(blob.bytes).substr(have));
        EXPECT_TRUE(has(blob)) << "killed with " << have << " bytes";
        cache.reset();
    }
}

}  // namespace
}  // namespace antipode::test
