// Two generations on disk that survive whatever happens while a third one is written.
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "farm/jobs/checkpoint.h"
#include "farm/jobs/checkpoint_format.h"
#include "renderengine/io/files.h"
#include "tests/film/expect_error.h"
#include "tests/film/temporary_folder.h"
#include "tests/jobs/job_fixture.h"

using namespace antipode;
using namespace antipode::test;

namespace {

/// In a child process: how many of the calls below still succeed before it is killed, and whether links fail.
int callsToLive = -1;
bool linksFail = false;

void countCall() {
    if (callsToLive > 0 && --callsToLive == 0) ::raise(SIGKILL);
}

}  // namespace

// In place of the C library's: killed before and after each of them, a process has been in every state that a write
// of a checkpoint goes through.
extern "C" {
int fsync(int descriptor) {
    countCall();
    return int(::syscall(SYS_fsync, descriptor));
}
int rename(const char* from, const char* to) noexcept {
    countCall();
    const int result = int(::syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
    countCall();
    return result;
}
int link(const char* from, const char* to) noexcept {
    countCall();
    if (linksFail && ::access(from, F_OK) == 0) {
        errno = EPERM;
        return -1;
    }
    const int result = int(::syscall(SYS_linkat, AT_FDCWD, from, AT_FDCWD, to, 0));
    countCall();
    return result;
}
}

namespace {

Checkpoint generation(uint64_t iterations) {
    Checkpoint checkpoint;
    checkpoint.job = smallJob();
    if (iterations == 0) return checkpoint;
    checkpoint.committed.add({0, iterations});
    checkpoint.sums = fakeSums(checkpoint.job.settings, {{0, iterations}});
    return checkpoint;
}

uint64_t iterationsOf(const std::string& path) { return loadCheckpoint(path).checkpoint.committed.count(); }

/// Writes in a child process that is killed at its `calls`-th call. Whether it was.
bool writeKilled(const std::string& path, const Checkpoint& checkpoint, int calls, bool withoutLinks) {
    const pid_t child = ::fork();
    if (child == 0) {
        callsToLive = calls;
        linksFail = withoutLinks;
        writeCheckpoint(path, checkpoint);
        ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFSIGNALED(status);
}

std::string contentOf(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST(CheckpointFile, KeepsThePreviousGeneration) {
    const TemporaryFolder folder;
    const std::string path = folder.file("job");
    for (uint64_t iterations = 1; iterations <= 3; ++iterations) writeCheckpoint(path, generation(iterations));
    EXPECT_EQ(iterationsOf(path), 3u);
    EXPECT_EQ(iterationsOf(path + ".previous"), 2u);
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"job", "job.previous"}));
    EXPECT_EQ(loadCheckpoint(path).notice, "");
    EXPECT_EQ(contentOf(path), encodeCheckpoint(generation(3)));
}

TEST(CheckpointFile, FallsBackToThePreviousGenerationAndSaysSo) {
    const TemporaryFolder folder;
    const std::string path = folder.file("job");
    writeCheckpoint(path, generation(1));
    writeCheckpoint(path, generation(2));
    const std::string whole = contentOf(path);
    for (size_t size = 0; size < whole.size(); size += 7) {
        std::ofstream(path, std::ios::binary) << whole.substr(0, size);
        const LoadedCheckpoint loaded = loadCheckpoint(path);
        EXPECT_EQ(loaded.checkpoint.committed.count(), 1u);
        EXPECT_NE(loaded.notice.find("job.previous"), std::string::npos) << loaded.notice;
    }
    std::filesystem::remove(path);
    EXPECT_EQ(iterationsOf(path), 1u);
}

TEST(CheckpointFile, SaysWhatIsWrong) {
    const TemporaryFolder folder;
    expectError(ErrorCode::Input, "No such file", [&] { loadCheckpoint(folder.file("job")); });
    expectError(ErrorCode::Input, "not a regular file", [&] { loadCheckpoint(folder.file(".")); });
    expectError(ErrorCode::Input, "not a regular file", [&] { loadCheckpoint("/dev/zero"); });
    writeFileAtomically(folder.file("image"), "something else");
    expectError(ErrorCode::Input, "does not begin like one", [&] { loadCheckpoint(folder.file("image")); });
    expectError(ErrorCode::Output, "No such file", [&] { writeCheckpoint(folder.file("no/job"), generation(1)); });
}

TEST(CheckpointFile, KilledAtAnyStepItIsThere) {
    for (const bool withoutLinks : {false, true}) {
        // Before: nothing, one generation, two generations, a torn one with a whole one behind it.
        for (const int before : {0, 1, 2, 3}) {
            if (before == 3 && withoutLinks) continue;
            int calls = 1;
            for (bool killed = true; killed; ++calls) {
                SCOPED_TRACE("before " + std::to_string(before) + ", call " + std::to_string(calls));
                const TemporaryFolder folder;
                const std::string path = folder.file("job");
                for (int i = 1; i <= before; ++i) writeCheckpoint(path, generation(uint64_t(i)));
                if (before == 3) std::ofstream(path) << "torn";
                const uint64_t known = before == 3 ? 2 : uint64_t(before);
                killed = writeKilled(path, generation(10), calls, withoutLinks);
                if (before == 0 && killed && !std::filesystem::exists(path)) continue;
                const uint64_t found = iterationsOf(path);
                EXPECT_TRUE(found == 10 || (killed && found == known)) << found;
                writeCheckpoint(path, generation(11));
                EXPECT_EQ(iterationsOf(path), 11u);
            }
            EXPECT_GE(calls, before == 0 ? 4 : 6);
        }
    }
}

TEST(CheckpointFile, AFullDiskLeavesBothGenerations) {
    const TemporaryFolder folder;
    const std::string path = folder.file("job");
    writeCheckpoint(path, generation(1));
    writeCheckpoint(path, generation(2));
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit unlimited{};
    ::getrlimit(RLIMIT_FSIZE, &unlimited);
    const size_t size = encodeCheckpoint(generation(3)).size();
    for (size_t bytes = 0; bytes < size; bytes += 5) {
        const rlimit limit{bytes, unlimited.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        expectError(ErrorCode::Output, path, [&] { writeCheckpoint(path, generation(3)); });
    }
    ::setrlimit(RLIMIT_FSIZE, &unlimited);
    std::signal(SIGXFSZ, handler);
    EXPECT_EQ(iterationsOf(path), 2u);
    EXPECT_EQ(iterationsOf(path + ".previous"), 1u);
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"job", "job.previous"}));
}

TEST(CheckpointFile, ALargeOneIsWrittenInSmallPieces) {
    const TemporaryFolder folder;
    Checkpoint checkpoint = generation(1);
    checkpoint.job.settings.width = checkpoint.job.settings.height = 1024;
    checkpoint.sums.layout.width = checkpoint.sums.layout.height = 1024;
    checkpoint.sums.values.resize(checkpoint.sums.layout.values());
    uint64_t state = 1;
    for (int64_t& sum : checkpoint.sums.values) sum = int64_t((state = state * 6364136223846793005u + 1) >> 20);
    size_t largest = 0, all = 0;
    encodeCheckpoint(checkpoint, [&](std::string_view piece) {
        largest = std::max(largest, piece.size());
        all += piece.size();
    });
    EXPECT_LE(largest, size_t(1) << 20);
    EXPECT_GT(all, size_t(10) << 20);
    writeCheckpoint(folder.file("job"), checkpoint);
    EXPECT_EQ(std::filesystem::file_size(folder.file("job")), all);
    EXPECT_EQ(loadCheckpoint(folder.file("job")).checkpoint.sums.values, checkpoint.sums.values);
}
