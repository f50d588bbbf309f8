// Markdown for the project's documents.
#pragma once

#include <string>
#include <vector>

namespace antipode::benchmark {

class MarkdownTable {
public:
    explicit MarkdownTable(std::vector<std::string> header) : header_(std::move(header)) {}
    void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
    /// To standard output, with an empty line after it.
    void print() const;

private:
    std::vector<std::string> header_;
    std::vector<std::vector<std::string>> rows_;
};

/// A line of text between tables.
void printLine(const std::string& text);

/// The number with so many digits after the point.
std::string fixed(double value, int digits);
/// The number with three significant digits.
std::string significant(double value);

/// "CPU model, N threads; device NAME": the machine, and nothing else of it.
std::string machineName(const std::string& deviceName);

}  // namespace antipode::benchmark
