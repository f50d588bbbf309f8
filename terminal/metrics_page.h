// Measurements for a monitoring system: Prometheus' text format over HTTP at /metrics.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace antipode {

struct Metric {
    std::string name, help;  ///< name: snake_case with unit and, for counters, _total
    enum class Kind { Gauge, Counter } kind = Kind::Gauge;
    std::vector<std::pair<std::string, std::string>> labels;
    double value = 0;
};

/// Listens from construction on; answers with what was published last, from threads of its own.
class MetricsPage {
public:
    /// `endpoint`: HOST:PORT. Throws Error(Usage) where nobody can listen there.
    explicit MetricsPage(const std::string& endpoint);
    ~MetricsPage();
    MetricsPage(const MetricsPage&) = delete;
    MetricsPage& operator=(const MetricsPage&) = delete;

    /// Replaces all measurements; those of one name must stand together. Thread-safe.
    void publish(const std::vector<Metric>& metrics);
    int port() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace antipode
