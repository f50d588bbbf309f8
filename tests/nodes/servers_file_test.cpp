#include "farm/nodes/servers_file.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "renderengine/error.h"
#include "tests/film/temporary_folder.h"

using namespace antipode;

namespace {

class ServersFileTest : public testing::Test {
protected:
    void write(const std::string& content) { std::ofstream(path) << content; }
    test::TemporaryFolder folder;
    const std::string path = folder.file("servers");
};

}  // namespace

TEST_F(ServersFileTest, OneAddressALine) {
    write("# nodes\n\nnode1:7010  # the fast one\n  [::1]:7011\n");
    const ServersFile file(path);
    ASSERT_EQ(file.servers().size(), 2u);
    EXPECT_EQ(file.servers()[0].text(), "node1:7010");
    EXPECT_EQ(file.servers()[1].text(), "[::1]:7011");
}

TEST_F(ServersFileTest, WhatIsNoAddressIsNamedWithItsLine) {
    write("node1:7010\nnode2\n");
    try {
        const ServersFile file(path);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::Input);
        EXPECT_NE(std::string(error.what()).find(path + ":2"), std::string::npos) << error.what();
    }
    write("node1:7010 node2:7010\n");
    EXPECT_THROW(ServersFile{path}, Error);
    EXPECT_THROW(ServersFile{folder.file("missing")}, Error);
}

TEST_F(ServersFileTest, ChangesAreNoticedAndBadOnesChangeNothing) {
    write("node1:7010\n");
    ServersFile file(path);
    std::string problem;
    EXPECT_FALSE(file.reread(problem));
    write("node1:7010\nnode2:7010\n");
    EXPECT_TRUE(file.reread(problem));
    EXPECT_EQ(file.servers().size(), 2u);
    EXPECT_EQ(problem, "");

    write("nonsense\n");
    EXPECT_FALSE(file.reread(problem));
    EXPECT_NE(problem, "");
    problem.clear();
    EXPECT_FALSE(file.reread(problem));
    EXPECT_EQ(problem, "") << "said twice";
    std::filesystem::remove(path);
    EXPECT_FALSE(file.reread(problem));
    EXPECT_NE(problem, "") << "another problem is news";
    EXPECT_EQ(file.servers().size(), 2u);

    write("node3:7010\n");
    EXPECT_TRUE(file.reread(problem));
    EXPECT_EQ(file.servers().front().text(), "node3:7010");
}
