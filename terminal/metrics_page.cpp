#include "terminal/metrics_page.h"

#include <mutex>

#include <prometheus/collectable.h>
#include <prometheus/exposer.h>
#include <prometheus/metric_family.h>

#include "renderengine/error.h"

namespace antipode {
namespace {

// Whoever says nothing holds a thread for as long as this.
constexpr int threads = 4, requestMilliseconds = 2000, requestBytes = 8192;

/// Holds the latest measurements for whoever scrapes them.
class Snapshot : public prometheus::Collectable {
public:
    std::vector<prometheus::MetricFamily> Collect() const override {
        const std::lock_guard lock(mutex_);
        return families_;
    }
    void replace(std::vector<prometheus::MetricFamily> families) {
        const std::lock_guard lock(mutex_);
        families_ = std::move(families);
    }

private:
    mutable std::mutex mutex_;
    std::vector<prometheus::MetricFamily> families_;
};

std::unique_ptr<prometheus::Exposer> listen(const std::string& endpoint) {
    try {
        return std::make_unique<prometheus::Exposer>(std::vector<std::string>{
            "listening_ports", endpoint, "num_threads", std::to_string(threads), "request_timeout_ms",
            std::to_string(requestMilliseconds), "max_request_size", std::to_string(requestBytes)});
    } catch (const std::exception&) {
        throw Error(ErrorCode::Usage, "--metrics: nobody can listen on '" + endpoint +
                                          "'; name an address of this machine and a port that is free.");
    }
}

}  // namespace

struct MetricsPage::Impl {
    std::shared_ptr<Snapshot> snapshot = std::make_shared<Snapshot>();
    std::unique_ptr<prometheus::Exposer> exposer;
};

MetricsPage::MetricsPage(const std::string& endpoint) : impl_(std::make_unique<Impl>()) {
    impl_->exposer = listen(endpoint);
    impl_->exposer->RegisterCollectable(impl_->snapshot);
}

MetricsPage::~MetricsPage() = default;

void MetricsPage::publish(const std::vector<Metric>& metrics) {
    std::vector<prometheus::MetricFamily> families;
    for (const Metric& metric : metrics) {
        const bool counter = metric.kind == Metric::Kind::Counter;
        if (families.empty() || families.back().name != metric.name)
            families.push_back({metric.name,
                                metric.help,
                                counter ? prometheus::MetricType::Counter : prometheus::MetricType::Gauge,
                                {}});
        prometheus::ClientMetric& value = families.back().metric.emplace_back();
        for (const auto& [name, text] : metric.labels) value.label.push_back({name, text});
        (counter ? value.counter.value : value.gauge.value) = metric.value;
    }
    impl_->snapshot->replace(std::move(families));
}

int MetricsPage::port() const { return impl_->exposer->GetListeningPorts().front(); }

}  // namespace antipode
