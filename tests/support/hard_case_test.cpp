#include "support/hard_case.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <optional>

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "film/temporary_folder.h"

namespace antipode {
namespace {

/// Rows go to a file of the test's own, even while another one collects the page's.
class HardCaseRows : public testing::TestWithParam<const char*> {
protected:
    HardCaseRows() {
        if (const char* before = std::getenv(kVariable)) before_ = before;
        setenv(kVariable, folder_.file("rows.jsonl").c_str(), 1);
    }
    ~HardCaseRows() override { before_ ? setenv(kVariable, before_->c_str(), 1) : unsetenv(kVariable); }

    std::vector<nlohmann::json> rows() const {
        std::vector<nlohmann::json> all;
        std::ifstream file(folder_.file("rows.jsonl"));
        for (std::string line; std::getline(file, line);) all.push_back(nlohmann::json::parse(line));
        return all;
    }

    static constexpr const char* kVariable = "ANTIPODE_HARD_CASES";
    const HardCase hardCase_{"Scale", "a \"quoted\" phrase, with | and ρ", "largest |t|", 2.5};

private:
    test::TemporaryFolder folder_;
    std::optional<std::string> before_;
};

TEST_P(HardCaseRows, AreAppendedOneALine) {
    expectWithin(hardCase_, 2.5);
    expectWithin(hardCase_, -1e-30, "some device", Precision::Double);
    ASSERT_EQ(rows().size(), 2u);
    EXPECT_EQ(rows()[0], (nlohmann::json{{"group", "Scale"},
                                         {"case", rows()[0]["case"]},
                                         {"source", "support/hard_case_test.cpp"},
                                         {"difficulty", hardCase_.difficulty},
                                         {"quantity", "largest |t|"},
                                         {"bound", 2.5},
                                         {"measured", 2.5},
                                         {"precision", "float"},
                                         {"device", "host"}}));
    EXPECT_EQ(rows()[1]["measured"], -1e-30);
    EXPECT_EQ(rows()[1]["precision"], "double");
    EXPECT_EQ(rows()[1]["device"], "some device");
}

TEST_P(HardCaseRows, OfFailuresAreWrittenToo) {
    EXPECT_NONFATAL_FAILURE(expectWithin(hardCase_, 2.5000001), "largest |t| (float on host)");
    EXPECT_NONFATAL_FAILURE(expectWithin(hardCase_, std::nan("")), "phrase");
    EXPECT_NONFATAL_FAILURE(expectWithin(hardCase_, std::numeric_limits<double>::infinity()), "2.5");
    ASSERT_EQ(rows().size(), 3u);
    EXPECT_EQ(rows()[0]["measured"], 2.5000001);
    EXPECT_EQ(rows()[1]["measured"], "nan");
    EXPECT_EQ(rows()[2]["measured"], "inf");
}

TEST_P(HardCaseRows, ThatCannotBeWrittenFail) {
    setenv(kVariable, "/nowhere/rows.jsonl", 1);
    EXPECT_NONFATAL_FAILURE(expectWithin(hardCase_, 0), "/nowhere/rows.jsonl: No such file");
}

TEST_P(HardCaseRows, AreNotAskedFor) {
    unsetenv(kVariable);
    expectWithin(hardCase_, 0);
    EXPECT_TRUE(rows().empty());
}

/// What a parameter says of the precision is no part of the case.
TEST_P(HardCaseRows, AreNamedWithoutThePrecision) {
    expectWithin(hardCase_, 0);
    const std::string parameter = GetParam();
    EXPECT_EQ(rows().at(0)["case"],
              std::string("HardCaseRows.AreNamedWithoutThePrecision") + (parameter == "Double" ? "" : "/Named"));
}

INSTANTIATE_TEST_SUITE_P(Prefix, HardCaseRows, testing::Values("Named", "NamedInDouble", "Double"),
                         [](const auto& named) { return std::string(named.param); });

}  // namespace
}  // namespace antipode
