#include <sys/stat.h>

#include "renderengine/io/files.h"
#include "tests/film/expect_error.h"
#include "tests/film/temporary_folder.h"

using namespace antipode;
using test::expectError;
using test::TemporaryFolder;

TEST(ReadFileBytes, GivesEveryByte) {
    const TemporaryFolder folder;
    const std::string content("\0\xFF\n\r", 4), path = folder.file("file");
    writeFileAtomically(path, content);
    EXPECT_EQ(readFileBytes(path), std::vector<uint8_t>(content.begin(), content.end()));
    writeFileAtomically(path, "");
    EXPECT_TRUE(readFileBytes(path).empty());
}

TEST(ReadFileBytes, RefusesWhatIsNoRegularFile) {
    const TemporaryFolder folder;
    ASSERT_EQ(::mkfifo(folder.file("pipe").c_str(), 0666), 0);
    for (const std::string& path : {folder.file("none"), folder.file("."), folder.file("pipe"), std::string()})
        expectError(ErrorCode::Input, "'" + path + "' does not exist or is not a file", [&] { readFileBytes(path); });
}
