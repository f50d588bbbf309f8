#include "tests/benchmarks/markdown.h"

#include <cstdio>
#include <fstream>
#include <iostream>
#include <thread>

namespace antipode::benchmark {
namespace {

void printRow(const std::vector<std::string>& cells) {
    for (const std::string& cell : cells) std::cout << "| " << cell << " ";
    std::cout << "|\n";
}

std::string formatted(const char* format, int digits, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, digits, value);
    return text;
}

std::string cpuModel() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name"))
            if (const size_t colon = line.find(": "); colon != std::string::npos) return line.substr(colon + 2);
    return "unknown CPU";
}

}  // namespace

void MarkdownTable::print() const {
    printRow(header_);
    printRow(std::vector<std::string>(header_.size(), "---"));
    for (const auto& row : rows_) printRow(row);
    std::cout << std::endl;
}

void printLine(const std::string& text) { std::cout << text << "\n" << std::endl; }

std::string fixed(double value, int digits) { return formatted("%.*f", digits, value); }
std::string significant(double value) { return formatted("%.*g", 3, value); }

std::string machineName(const std::string& deviceName) {
    return cpuModel() + ", " + std::to_string(std::thread::hardware_concurrency()) + " threads; device " + deviceName;
}

}  // namespace antipode::benchmark
