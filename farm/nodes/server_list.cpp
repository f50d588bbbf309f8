#include "farm/nodes/server_list.h"

#include <algorithm>
#include <utility>

#include "renderengine/error.h"

namespace antipode {
namespace {

constexpr double rereadSeconds = 2;

}  // namespace

ServerList::ServerList(asio::io_context& io, ServerListOptions options, std::shared_ptr<RemoteContext> context)
    : io_(io),
      options_(std::move(options)),
      security_(std::make_shared<const wire::Security>(options_.security, wire::Security::Role::Client)),
      context_(std::move(context)) {
    if (!options_.serversFile.empty()) file_.emplace(options_.serversFile);
    update();
}

void ServerList::update() {
    std::vector<wire::Endpoint> wanted = options_.servers;
    if (file_) wanted.insert(wanted.end(), file_->servers().begin(), file_->servers().end());
    // Before anything changes.
    for (const wire::Endpoint& endpoint : wanted)
        if (!nodes_.contains(endpoint.text())) wire::requireSecured(options_.security, endpoint, "--servers-file");
    std::map<std::string, std::unique_ptr<RemoteNode>> kept;
    for (const wire::Endpoint& endpoint : wanted) {
        const std::string name = endpoint.text();
        if (kept.contains(name)) continue;
        if (auto known = nodes_.extract(name)) {
            kept.insert(std::move(known));
            continue;
        }
        auto node = std::make_unique<RemoteNode>(io_, endpoint, security_, context_);
        node->start();
        kept.emplace(name, std::move(node));
    }
    for (auto& [name, node] : nodes_) {
        node->stop();
        leaving_.push_back(std::move(node));
    }
    nodes_ = std::move(kept);
}

void ServerList::reread(double now) {
    if (!file_ || now < nextReread_) return;
    nextReread_ = now + rereadSeconds;
    std::string problem;
    try {
        if (file_->reread(problem)) update();
    } catch (const Error& error) {
        problem = error.what();
    }
    if (!problem.empty()) messages_.push_back(problem);
}

void ServerList::tick(double now) {
    reread(now);
    std::erase_if(leaving_, [](const auto& node) { return node->stopped(); });
    for (const auto& [name, node] : nodes_) {
        const RemoteStatus status = node->status();
        std::string& told = told_[name];
        if (!status.detail.empty() && status.detail != told)
            messages_.push_back(name + (status.state == "refused" ? " refuses: " : ": ") + status.detail);
        if (!status.detail.empty()) told = status.detail;
        if (status.state == "ready") told.clear();
    }
}

void ServerList::stop() {
    for (const auto& [name, node] : nodes_) node->stop();
}

bool ServerList::stopped() const {
    return std::ranges::all_of(nodes_, [](const auto& entry) { return entry.second->stopped(); });
}

std::vector<RemoteStatus> ServerList::status() const {
    std::vector<RemoteStatus> all;
    all.reserve(nodes_.size());
    for (const auto& [name, node] : nodes_) all.push_back(node->status());
    return all;
}

std::string ServerList::complaints() const {
    std::string text;
    for (const RemoteStatus& status : this->status())
        text +=
            (text.empty() ? "" : "; ") + status.name + ": " + (status.detail.empty() ? status.state : status.detail);
    return text.empty() ? "no server is named" : text;
}

}  // namespace antipode
