// This machine's device as one of the coordinator's nodes.
#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "farm/jobs/coordinator.h"
#include "renderengine/block_worker.h"

namespace antipode {

/// What a LocalNode works with. All of it outlives the node, and what `post` refers to outlives the worker, too.
struct LocalNodeContext {
    Coordinator& coordinator;
    BlockWorker& worker;  ///< of this node alone
    std::function<void(std::function<void()>)>
        post;                                    ///< runs functions in order on the coordinator's thread; thread-safe
    std::function<double()> clock;               ///< the coordinator's seconds
    std::function<void(const Error&)> onFailed;  ///< the device failed and the node is out; may destroy it
};

/// Lives on the coordinator's thread and tells it everything there. It holds two leases, one in the worker and one that
/// follows at once, so that the device does not wait while a result is merged; with one block at a time in the worker,
/// a truncation cannot hit the wrong one. Results come from this process and are delivered as they are.
class LocalNode final : private NodePort {
public:
    /// Opens the job, and becomes a node named "local" once it is ready.
    LocalNode(LocalNodeContext context, const std::string& deviceName, const std::string& deviceClass,
              std::shared_ptr<const Scene> scene, const RenderSettings& settings);
    /// Leaves the coordinator, truncates the block in hand and closes the job. Nothing that comes later is heard.
    ~LocalNode() override;
    LocalNode(const LocalNode&) = delete;
    LocalNode& operator=(const LocalNode&) = delete;

    /// What is known of the job, once it is built.
    const std::optional<JobReady>& ready() const { return ready_; }

private:
    /// Posts what a node has to do, unless the node is gone by then. Copies may be used on any thread.
    class Post {
    public:
        Post(std::function<void(std::function<void()>)> post, std::weak_ptr<const bool> alive)
            : post_(std::move(post)), alive_(std::move(alive)) {}
        void operator()(std::function<void()> action) const;

    private:
        std::function<void(std::function<void()>)> post_;
        std::weak_ptr<const bool> alive_;
    };
    /// Iterations done of a block. The worker's thread writes; however fast it is, one message at a time is posted.
    struct BlockProgress {
        std::atomic<uint64_t> done = 0;
        std::atomic<bool> posted = false;
    };

    void grant(const Lease& lease) override;
    void truncate(LeaseId lease) override;

    /// `renderings`: see renderingClass().
    void becomeReady(const JobReady& ready, const std::string& renderings);
    void beginFront();
    void reportProgress(LeaseId lease, BlockProgress& progress);
    void finish(std::optional<BlockResult> result);
    void giveBack(LeaseId lease);
    void fail(const Error& error);

    const LocalNodeContext context_;
    const std::shared_ptr<const bool> alive_ = std::make_shared<const bool>(true);
    const Post post_;
    NodeDescription description_;
    std::optional<JobReady> ready_;
    std::optional<NodeId> node_;  ///< while the coordinator counts on it
    std::deque<Lease> leases_;    ///< the first is in the worker
};

}  // namespace antipode
