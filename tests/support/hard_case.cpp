#include "support/hard_case.h"

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include <fcntl.h>
#include <unistd.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace antipode {
namespace {

/// "Suite.Test/Parameter". The prefix of an instantiation is no part of a case, nor is a precision: the same case may
/// be run in float and in double.
std::string nameOf(const testing::TestInfo& test) {
    const std::string suite = test.test_suite_name();
    std::string name = test.name();
    for (const std::string precision : {"/Float", "/Double", "InFloat", "InDouble"})
        if (name.ends_with(precision)) name.resize(name.size() - precision.size());
    return suite.substr(suite.find('/') + 1) + "." + name;
}

/// From the folder of the tests on, as the page links to it; compilers may be given relative paths.
std::string sourceOf(const testing::TestInfo& test) {
    const std::string file = test.file(), folder = "/tests/";
    const size_t at = file.rfind(folder);
    return at == std::string::npos ? file : file.substr(at + folder.size());
}

/// JSON has no NaN and no infinity; as a text they still arrive.
nlohmann::ordered_json number(double value) {
    if (std::isfinite(value)) return value;
    return std::to_string(value);
}

/// In one write, so that tests that run side by side do not tear each other's lines.
void append(const char* path, const std::string& line) {
    const int file = ::open(path, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
    const bool written = file >= 0 && ::write(file, line.data(), line.size()) == ssize_t(line.size());
    EXPECT_TRUE(written) << path << ": " << std::strerror(errno);
    if (file >= 0) ::close(file);
}

}  // namespace

void expectWithin(const HardCase& hardCase, double measured, const std::string& device, Precision precision) {
    EXPECT_LE(measured, hardCase.bound) << hardCase.quantity << " (" << name(precision) << " on " << device
                                        << "): " << hardCase.difficulty;
    const char* path = std::getenv("ANTIPODE_HARD_CASES");
    if (!path) return;
    const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
    const nlohmann::ordered_json row = {
        {"group", hardCase.group},           {"case", nameOf(test)},          {"source", sourceOf(test)},
        {"difficulty", hardCase.difficulty}, {"quantity", hardCase.quantity}, {"bound", number(hardCase.bound)},
        {"measured", number(measured)},      {"precision", name(precision)},  {"device", device}};
    append(path, row.dump() + "\n");
}

}  // namespace antipode
