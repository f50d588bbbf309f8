#include "farm/nodes/local_node.h"

#include <algorithm>
#include <utility>

namespace antipode {
namespace {

const BlockWorker::JobKey jobKey = "local";
constexpr uint32_t leaseDepth = 2;

}  // namespace

void LocalNode::Post::operator()(std::function<void()> action) const {
    // Looked at on the coordinator's thread, where the node is destroyed, too.
    post_([alive = alive_, action = std::move(action)] {
        if (!alive.expired()) action();
    });
}

LocalNode::LocalNode(LocalNodeContext context, const std::string& deviceName, const std::string& deviceClass,
                     std::shared_ptr<const Scene> scene, const RenderSettings& settings)
    : context_(std::move(context)),
      post_(context_.post, alive_),
      description_{"local", deviceName, deviceClass, leaseDepth} {
    context_.worker.openJob(
        jobKey, std::move(scene), settings,
        [this, post = post_, settings, name = description_.deviceClass](const JobReady& ready) {
            const std::string renderings = renderingClass(name, settings, ready.lightPathsPerIteration);
            post([this, ready, renderings] { becomeReady(ready, renderings); });
        },
        [this, post = post_](const Error& error) { post([this, error] { fail(error); }); });
}

LocalNode::~LocalNode() {
    if (node_) context_.coordinator.removeNode(*node_, context_.clock());
    if (!leases_.empty()) context_.worker.truncateBlock(jobKey, leases_.front().range.first);
    context_.worker.closeJob(jobKey);
}

void LocalNode::becomeReady(const JobReady& ready, const std::string& renderings) {
    ready_ = ready;
    description_.deviceClass = renderings;
    const double now = context_.clock();
    node_ = context_.coordinator.addNode(description_, *this, now);
    context_.coordinator.tick(now);
}

// ---- What the coordinator asks -----------------------------------------------------------------------------------

void LocalNode::grant(const Lease& lease) {
    leases_.push_back(lease);
    if (leases_.size() == 1) beginFront();
}

void LocalNode::truncate(LeaseId id) {
    const auto lease = std::find_if(leases_.begin(), leases_.end(), [id](const Lease& l) { return l.id == id; });
    if (lease == leases_.end()) return;
    if (lease == leases_.begin()) {
        context_.worker.truncateBlock(jobKey, lease->range.first);
        return;
    }
    leases_.erase(lease);
    post_([this, id] { giveBack(id); });
}

// ---- What the worker answers -------------------------------------------------------------------------------------

void LocalNode::beginFront() {
    const LeaseId lease = leases_.front().id;
    BlockCallbacks callbacks;
    callbacks.progress = [this, post = post_, lease, progress = std::make_shared<BlockProgress>()](uint64_t done) {
        progress->done = done;
        if (!progress->posted.exchange(true)) post([this, lease, progress] { reportProgress(lease, *progress); });
    };
    callbacks.finished = [this, post = post_](std::optional<BlockResult> result) {
        // Shared, because functions are copied and frames are large.
        const auto shared = std::make_shared<std::optional<BlockResult>>(std::move(result));
        post([this, shared] { finish(std::move(*shared)); });
    };
    callbacks.failed = [this, post = post_](const Error& error) { post([this, error] { fail(error); }); };
    context_.worker.renderBlock(jobKey, leases_.front().range, std::move(callbacks));
}

void LocalNode::reportProgress(LeaseId lease, BlockProgress& progress) {
    progress.posted = false;
    context_.coordinator.progress(*node_, lease, progress.done, context_.clock());
}

void LocalNode::finish(std::optional<BlockResult> result) {
    const LeaseId lease = leases_.front().id;
    leases_.pop_front();
    if (!leases_.empty()) beginFront();

    Coordinator& coordinator = context_.coordinator;
    const double now = context_.clock();
    if (!result)
        coordinator.returned(*node_, lease, now);
    else if (coordinator.wanted(*node_, lease, result->range, result->sha256, now))
        coordinator.deliver(*node_, lease, *result, now);
    coordinator.tick(now);
}

void LocalNode::giveBack(LeaseId lease) {
    if (!node_) return;
    const double now = context_.clock();
    context_.coordinator.returned(*node_, lease, now);
    context_.coordinator.tick(now);
}

void LocalNode::fail(const Error& error) {
    leases_.clear();
    if (const auto node = std::exchange(node_, {})) {
        const double now = context_.clock();
        context_.coordinator.removeNode(*node, now);
        context_.coordinator.tick(now);
    }
    const auto onFailed = context_.onFailed;  // the call may destroy this node
    onFailed(error);
}

}  // namespace antipode
