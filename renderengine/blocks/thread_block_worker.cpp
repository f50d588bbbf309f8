#include <chrono>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <new>
#include <thread>
#include <utility>
#include <variant>

#include "renderengine/block_worker.h"

namespace antipode {
namespace {

using JobKey = BlockWorker::JobKey;

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Runs what may fail in any way that a renderer can; the error where it did. An Error keeps its code.
template <class Work>
std::optional<Error> attempt(const Work& work) {
    try {
        work();
        return {};
    } catch (const Error& error) {
        return error;
    } catch (const std::bad_alloc&) {
        return Error(ErrorCode::Device,
                     "There is not enough memory on this machine for the job; render a smaller image or scene.");
    } catch (const std::exception& error) {
        return Error(ErrorCode::Device, std::string("The renderer failed: ") + error.what());
    } catch (...) {
        return Error(ErrorCode::Device, "The renderer failed without saying why.");
    }
}

struct OpenCommand {
    JobKey job;
    std::shared_ptr<const Scene> scene;
    RenderSettings settings;
    std::function<void(const JobReady&)> ready;
    std::function<void(const Error&)> failed;
};

struct RenderCommand {
    JobKey job;
    IterationRange range;
    BlockCallbacks callbacks;
    bool truncated = false;  ///< before it was begun
};

struct CloseCommand {
    JobKey job;
};

using Command = std::variant<OpenCommand, RenderCommand, CloseCommand>;

struct OpenJob {
    std::shared_ptr<const Scene> scene;  // outlives its renderer
    std::unique_ptr<Renderer> renderer;
};

}  // namespace

/// Callers queue commands under the mutex; the thread alone touches `jobs_`, and runs callbacks without the mutex.
struct ThreadBlockWorker::Impl {
    explicit Impl(RendererFactory factory) : factory_(std::move(factory)), thread_([this] { run(); }) {}

    ~Impl() {
        {
            const std::lock_guard lock(mutex_);
            stopping_ = true;
        }
        wake_.notify_one();
        thread_.join();
    }

    void add(Command command) {
        {
            const std::lock_guard lock(mutex_);
            commands_.push_back(std::move(command));
        }
        wake_.notify_one();
    }

    void truncate() {
        const std::lock_guard lock(mutex_);
        if (blockInHand_) {
            truncated_ = true;
            return;
        }
        for (Command& command : commands_)
            if (auto* block = std::get_if<RenderCommand>(&command)) {
                block->truncated = true;
                return;
            }
    }

private:
    void run() {
        while (std::optional<Command> command = next()) std::visit([this](auto& c) { execute(c); }, *command);
        jobs_.clear();
    }

    /// Waits for a command; nothing once the worker stops.
    std::optional<Command> next() {
        std::unique_lock lock(mutex_);
        wake_.wait(lock, [this] { return stopping_ || !commands_.empty(); });
        if (stopping_) return {};
        Command command = std::move(commands_.front());
        commands_.pop_front();
        if (const auto* block = std::get_if<RenderCommand>(&command)) {
            blockInHand_ = true;
            truncated_ = block->truncated;
        }
        return command;
    }

    bool mustEnd() {
        const std::lock_guard lock(mutex_);
        return truncated_ || stopping_;
    }

    void execute(OpenCommand& command) {
        if (jobs_.contains(command.job))
            return command.failed(Error(ErrorCode::Usage, "The job '" + command.job + "' is open already."));
        const auto start = std::chrono::steady_clock::now();
        OpenJob job{std::move(command.scene), nullptr};
        JobReady ready;
        const auto build = [&] {
            job.renderer = factory_(*job.scene, command.settings);
            const EngineStatistics statistics = job.renderer->statistics();
            ready.initialRadius = statistics.initialRadius;
            ready.lightPathsPerIteration = statistics.lightPathsPerIteration;
            ready.deviceBytes = statistics.deviceBytes;
            ready.bvhPrimitives = statistics.bvhPrimitives;
            ready.bvhBuildSeconds = statistics.bvhBuildSeconds;
        };
        if (const auto error = attempt(build)) {
            job.renderer.reset();
            return command.failed(*error);
        }
        ready.seconds = secondsSince(start);
        jobs_.emplace(command.job, std::move(job));
        command.ready(ready);
    }

    void execute(RenderCommand& command) {
        std::optional<BlockResult> result;
        const std::optional<Error> error = renderBlock(command, result);
        {
            // Before the callback: who hears it may ask for the next block, and then means that one by a truncation.
            const std::lock_guard lock(mutex_);
            blockInHand_ = false;
        }
        if (error)
            command.callbacks.failed(*error);
        else
            command.callbacks.finished(std::move(result));
    }

    /// What the command's `finished` gets, or the error.
    std::optional<Error> renderBlock(const RenderCommand& command, std::optional<BlockResult>& result) {
        const auto job = jobs_.find(command.job);
        if (job == jobs_.end())
            return Error(ErrorCode::Usage, "The job '" + command.job + "' is not open: open it before its blocks.");
        Renderer& renderer = *job->second.renderer;
        const auto fail = [&](const Error& error) {
            jobs_.erase(job);
            return Error(ErrorCode::Device, error.what());
        };

        BlockResult block;
        block.range.first = command.range.first;
        const auto start = std::chrono::steady_clock::now();
        while (block.range.count < command.range.count && !mustEnd()) {
            const auto renderNext = [&] {
                if (block.range.count == 0) renderer.reset();
                renderer.render(block.range.end() + 1);
            };
            if (const auto error = attempt(renderNext)) return fail(*error);
            ++block.range.count;
            command.callbacks.progress(block.range.count);
        }
        block.seconds = secondsSince(start);
        if (block.range.count == 0) return {};

        const auto sumUp = [&] {
            block.sums = renderer.sums();
            block.sha256 = block.sums.sha256();
            block.statistics = renderer.statistics();
        };
        if (const auto error = attempt(sumUp)) return fail(*error);
        result = std::move(block);
        return {};
    }

    void execute(CloseCommand& command) { jobs_.erase(command.job); }

    RendererFactory factory_;
    std::map<JobKey, OpenJob> jobs_;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<Command> commands_;  // bounded by callers: one block in hand and one behind it for each of their nodes
    bool stopping_ = false, blockInHand_ = false, truncated_ = false;
    std::thread thread_;  // last: uses all of the above
};

ThreadBlockWorker::ThreadBlockWorker(RendererFactory factory) : impl_(std::make_unique<Impl>(std::move(factory))) {}
ThreadBlockWorker::~ThreadBlockWorker() = default;

void ThreadBlockWorker::openJob(const JobKey& job, std::shared_ptr<const Scene> scene, const RenderSettings& settings,
                                std::function<void(const JobReady&)> ready, std::function<void(const Error&)> failed) {
    impl_->add(OpenCommand{job, std::move(scene), settings, std::move(ready), std::move(failed)});
}

void ThreadBlockWorker::renderBlock(const JobKey& job, IterationRange range, BlockCallbacks callbacks) {
    impl_->add(RenderCommand{job, range, std::move(callbacks)});
}

void ThreadBlockWorker::truncateBlock(const JobKey&, uint64_t) { impl_->truncate(); }

void ThreadBlockWorker::closeJob(const JobKey& job) { impl_->add(CloseCommand{job}); }

}  // namespace antipode
