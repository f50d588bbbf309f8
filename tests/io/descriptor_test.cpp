#include "renderengine/io/descriptor.h"

#include <array>
#include <cerrno>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "renderengine/io/files.h"
#include "tests/film/temporary_folder.h"

using namespace antipode;
using test::TemporaryFolder;

namespace {

bool isOpen(int descriptor) { return ::fcntl(descriptor, F_GETFD) >= 0; }

}  // namespace

TEST(Descriptor, ClosesOnceAndIsMoved) {
    int number = -1;
    {
        Descriptor file = openFile("/dev/null", O_RDONLY);
        ASSERT_TRUE(file);
        number = file.get();
        Descriptor other = std::move(file);
        EXPECT_FALSE(file);  // NOLINT(bugprone-use-after-move): that is what is tested
        EXPECT_EQ(other.get(), number);
        EXPECT_TRUE(isOpen(number));
        EXPECT_EQ(other.close(), 0);
        EXPECT_FALSE(isOpen(number));
        EXPECT_EQ(other.close(), 0);
        other = openFile("/dev/null", O_RDONLY);
        number = other.get();
    }
    EXPECT_FALSE(isOpen(number));
}

TEST(Descriptor, IsEmptyWhereNothingCanBeOpened) {
    const TemporaryFolder folder;
    EXPECT_FALSE(openFile(folder.file("none"), O_RDONLY));
    EXPECT_EQ(errno, ENOENT);
}

TEST(Descriptor, IsNotInherited) {
    const Descriptor file = openFile("/dev/null", O_RDONLY);
    EXPECT_NE(::fcntl(file.get(), F_GETFD) & FD_CLOEXEC, 0);
}

TEST(ReadFully, GathersThePiecesOfAPipe) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const Descriptor from(ends[0]);
    std::thread writer([end = ends[1]] {
        Descriptor to(end);
        for (const char* piece : {"one ", "two ", "three"}) EXPECT_EQ(writeFully(to, piece), 0);
    });
    std::array<char, 8> buffer;
    EXPECT_EQ(readFully(from, buffer.data(), buffer.size()), buffer.size());
    EXPECT_EQ(std::string_view(buffer.data(), buffer.size()), "one two ");
    EXPECT_EQ(readFully(from, buffer.data(), buffer.size()), 5u);
    EXPECT_EQ(std::string_view(buffer.data(), 5), "three");
    writer.join();
}

TEST(ReadFully, TellsAFailureFromTheEnd) {
    char byte = 0;
    EXPECT_EQ(readFully(openFile("/dev/null", O_RDONLY), &byte, 1), 0u);
    EXPECT_EQ(readFully(openFile("/dev/null", O_WRONLY), &byte, 1), std::nullopt);
    EXPECT_EQ(errno, EBADF);
}

TEST(WriteFully, AppendsAndWritesAtOffsets) {
    const TemporaryFolder folder;
    const std::string path = folder.file("file");
    Descriptor file = openFile(path, O_WRONLY | O_CREAT);
    EXPECT_EQ(writeFully(file, "0123"), 0);
    EXPECT_EQ(writeFullyAt(file, 2, "ABCD"), 0);
    EXPECT_EQ(writeFully(file, "x"), 0);
    EXPECT_EQ(file.close(), 0);
    const std::vector<uint8_t> bytes = readFileBytes(path);
    EXPECT_EQ(std::string(bytes.begin(), bytes.end()), "01ABxD");
}

TEST(WriteFully, GivesTheErrorOfAFullDisk) {
    const Descriptor full = openFile("/dev/full", O_WRONLY);
    EXPECT_EQ(writeFully(full, "x"), ENOSPC);
    EXPECT_EQ(writeFullyAt(full, 0, "x"), ENOSPC);
}
