#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <sys/resource.h>

#include "renderengine/film.h"
#include "renderengine/io/files.h"
#include "tests/film/expect_error.h"
#include "tests/film/temporary_folder.h"

using namespace antipode;
using test::expectError;
using test::TemporaryFolder;

namespace {

std::string contentOf(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Makes every write of this process beyond `bytes` per file fail, as on a full disk, while it lives.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t bytes) : previousHandler_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &previous_);
        const rlimit limit{bytes, previous_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &previous_);
        std::signal(SIGXFSZ, previousHandler_);
    }

private:
    void (*previousHandler_)(int);
    rlimit previous_{};
};

}  // namespace

TEST(AtomicFile, CreatesAndReplaces) {
    TemporaryFolder folder;
    const std::string path = folder.file("data");
    writeFileAtomically(path, "first");
    EXPECT_EQ(contentOf(path), "first");
    writeFileAtomically(path, std::string_view("\0x", 2));
    EXPECT_EQ(contentOf(path), std::string("\0x", 2));
    EXPECT_EQ(folder.names(), std::vector<std::string>{"data"});
}

TEST(AtomicFile, FailedWriteKeepsTheOldFileAndLeavesNothing) {
    TemporaryFolder folder;
    const std::string path = folder.file("data");
    writeFileAtomically(path, "old");
    {
        const FileSizeLimit limit(1000);
        expectError(ErrorCode::Output, path, [&] { writeFileAtomically(path, std::string(5000, 'x')); });
    }
    EXPECT_EQ(contentOf(path), "old");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"data"});
}

TEST(AtomicFile, FailedImageWriteLeavesNothing) {
    TemporaryFolder folder;
    const Image image{64, 64, std::vector<Vec3f>(64 * 64, Vec3f(0.3f, 0.2f, 0.1f))};
    {
        const FileSizeLimit limit(50);
        expectError(ErrorCode::Output, "a.exr", [&] { writeExr(folder.file("a.exr"), image, {}); });
        expectError(ErrorCode::Output, "a.png", [&] { writePng(folder.file("a.png"), image); });
    }
    EXPECT_TRUE(folder.names().empty());
}

TEST(AtomicFile, FollowsSymbolicLinks) {
    TemporaryFolder folder;
    writeFileAtomically(folder.file("target"), "old");
    std::filesystem::create_symlink("target", folder.file("link"));
    writeFileAtomically(folder.file("link"), "new");
    EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link")));
    EXPECT_EQ(contentOf(folder.file("target")), "new");
}

TEST(CheckWritable, LeavesNothingBehind) {
    TemporaryFolder folder;
    checkWritable(folder.file("new"));
    EXPECT_TRUE(folder.names().empty());
    writeFileAtomically(folder.file("old"), "kept");
    checkWritable(folder.file("old"));
    EXPECT_EQ(contentOf(folder.file("old")), "kept");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"old"});
}

TEST(CheckWritable, SaysWhatIsWrong) {
    TemporaryFolder folder;
    expectError(ErrorCode::Output, "No such file or directory", [&] { checkWritable(folder.file("missing/a.exr")); });
    expectError(ErrorCode::Output, "it is a folder", [&] { checkWritable(folder.file(".")); });
    expectError(ErrorCode::Output, "does not name a file", [&] { checkWritable(folder.file("")); });
    expectError(ErrorCode::Output, "does not name a file", [&] { checkWritable(""); });
    expectError(ErrorCode::Output, "not a regular file", [&] { checkWritable("/dev/null"); });
    writeFileAtomically(folder.file("file"), "x");
    expectError(ErrorCode::Output, "Not a directory", [&] { checkWritable(folder.file("file/a.exr")); });
}
