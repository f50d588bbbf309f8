#include "server/relay/relay_worker.h"

#include <algorithm>
#include <exception>
#include <map>
#include <optional>
#include <random>
#include <utility>

#include "proto/wire/job_messages.h"
#include "renderengine/error.h"

namespace antipode {
namespace {

std::string randomJobId() {
    std::random_device random;
    std::string id;
    while (id.size() < 16) id.push_back(char(random()));
    return id;
}

farm::Hello helloOf(const RelayOptions& options) {
    farm::Hello hello;
    hello.set_oldest_protocol(wire::protocolVersion);
    hello.set_newest_protocol(wire::protocolVersion);
    hello.set_build(options.build);
    hello.set_kernel_hash(options.kernelHash);
    hello.set_client(options.name);
    return hello;
}

CoordinatorOptions coordinatorOptions(const RelayOptions& options, const RenderSettings& settings) {
    CoordinatorOptions result;
    result.inParts = true;
    result.mostResultsPerSecond = mergeableResults(settings);
    result.verifyFraction = options.verifyFraction;
    result.verifySeed = options.verifySeed;
    return result;
}

/// What the background makes of a scene.
struct Product {
    wire::ScenePackage package;
    FilmLayout film;
    std::optional<Error> failure;
};

/// All that a job's connections refer to, and keep.
struct Core {
    Core(const RelayOptions& options, const RenderSettings& settings, Product product)
        : package(std::move(product.package)),
          coordinator({settings, package.sceneHash, options.kernelHash, std::move(product.film)},
                      coordinatorOptions(options, settings)),
          budget(options.reassemblyBytes),
          context{coordinator,
                  package,
                  wire::makeOpenJob(randomJobId(), settings, package.root(), package.sceneHash, options.kernelHash),
                  helloOf(options),
                  budget,
                  {},
                  options.watch} {}

    const wire::ScenePackage package;
    Coordinator coordinator;
    ReassemblyBudget budget;
    RemoteContext context;
};

struct Block {
    uint64_t count = 0;
    BlockCallbacks callbacks;
    double asked = 0;
    uint64_t reported = 0;
};

struct Job {
    RenderSettings settings;
    std::function<void(const JobReady&)> ready;
    std::function<void(const Error&)> failed;
    double opened = 0;
    std::shared_ptr<Core> core{};  ///< once the scene is packed
    std::unique_ptr<RelayChildren> children{};
    bool told = false;                   ///< that it is ready
    uint32_t width = 0;                  ///< that was told
    std::optional<double> aloneSince{};  ///< since when no server can be given leases
    std::map<uint64_t, Block> blocks{};  ///< in hand, by first iteration
};

}  // namespace

struct RelayWorker::Impl : std::enable_shared_from_this<RelayWorker::Impl> {
    Impl(RelayOptions relayOptions, MakeRelayChildren make, Background runInBackground, std::function<double()> seconds,
         std::function<void(const std::string&)> write)
        : options(std::move(relayOptions)),
          makeChildren(std::move(make)),
          background(std::move(runInBackground)),
          clock(std::move(seconds)),
          log(std::move(write)) {}

    // ---- Jobs

    void open(const JobKey& key, std::shared_ptr<const Scene> scene, Job job) {
        const RenderSettings settings = job.settings;
        jobs.emplace(key, std::move(job));
        const auto product = std::make_shared<Product>();
        background(
            [product, scene = std::move(scene), settings, film = options.film]() mutable {
                try {
                    product->package = wire::packageScene(*scene);
                    product->film = film(*scene, settings);
                } catch (const Error& error) {
                    product->failure = error;
                } catch (const std::exception& error) {
                    product->failure.emplace(ErrorCode::Device, error.what());
                }
                scene.reset();  // its blobs are all that is needed of it
            },
            [weak = weak_from_this(), product, key] {
                if (const auto self = weak.lock()) self->packed(key, *product);
            });
    }

    void packed(const JobKey& key, Product& product) {
        const auto found = jobs.find(key);
        if (found == jobs.end()) return;
        if (product.failure) return fail(found, *product.failure);
        Job& job = found->second;
        job.core = std::make_shared<Core>(options, job.settings, std::move(product));
        try {
            job.children = makeChildren(std::shared_ptr<RemoteContext>(job.core, &job.core->context));
        } catch (const Error& error) {
            job.core.reset();
            fail(found, error);
        }
    }

    /// Lets go of a job and of its blocks, which come to nothing.
    void close(std::map<JobKey, Job>::iterator job) {
        Job leaving = std::move(job->second);
        jobs.erase(job);
        for (auto& [first, block] : leaving.blocks) block.callbacks.finished({});
        if (!leaving.children) return;
        leaving.children->stop();
        gone.push_back(std::move(leaving.children));
    }

    void fail(std::map<JobKey, Job>::iterator job, const Error& error) {
        const auto failed = job->second.failed;
        close(job);
        failed(error);
    }

    // ---- Time

    void tick() {
        const double now = clock();
        for (auto next = jobs.begin(); next != jobs.end();) {
            const auto job = next++;
            if (job->second.core) attend(job, now);
        }
        for (const auto& children : gone) children->tick(now);
        std::erase_if(gone, [](const auto& children) { return children->stopped(); });
    }

    void attend(std::map<JobKey, Job>::iterator found, double now) {
        Job& job = found->second;
        Coordinator& coordinator = job.core->coordinator;
        for (const std::string& sentence : job.children->tick(now)) log(sentence);
        coordinator.tick(now);
        for (const std::string& sentence : coordinator.takeMessages()) log(sentence);
        if (!coordinator.failure().empty()) return fail(found, Error(ErrorCode::Device, coordinator.failure()));
        const uint32_t width = coordinator.width();
        if (const std::string reason = width == 0 ? job.children->hopeless() : ""; !reason.empty())
            return fail(found, Error(ErrorCode::Device, "None of the relay's servers takes the job: " + reason));
        tellWidth(found->first, job, width, now);
        reportProgress(job);
        for (const uint64_t first : coordinator.finishedParts()) finish(job, first, now);
    }

    void tellWidth(const JobKey& key, Job& job, uint32_t width, double now) {
        if (width == 0) {
            if (!job.aloneSince) job.aloneSince = now;
            if (job.told && now - *job.aloneSince > options.patienceSeconds) {
                if (std::exchange(job.width, 0) != 0) widthTold(key, 0);
                for (const auto& [first, block] : job.blocks) job.core->coordinator.cut(first, now);
            }
            return;
        }
        job.aloneSince.reset();
        if (std::exchange(job.width, width) == width && job.told) return;
        if (std::exchange(job.told, true)) return widthTold(key, width);
        JobReady ready;
        ready.initialRadius = job.settings.initialRadius.value_or(0);
        ready.renderings = job.core->coordinator.renderingClass();
        ready.width = width;
        ready.seconds = now - job.opened;
        job.ready(ready);
    }

    static void reportProgress(Job& job) {
        for (auto& [first, block] : job.blocks) {
            // All of it is said by its result: until then some of it may be lost with a server.
            const uint64_t done = std::min(job.core->coordinator.rendered(first), block.count - 1);
            if (done <= block.reported) continue;
            block.reported = done;
            block.callbacks.progress(done);
        }
    }

    void finish(Job& job, uint64_t first, double now) {
        const auto result = std::make_shared<std::optional<BlockResult>>(job.core->coordinator.takePart(first, now));
        const auto block = job.blocks.extract(first);
        if (!*result) return block.mapped().callbacks.finished({});
        (*result)->seconds = now - block.mapped().asked;
        ++totals.blocks;
        background([result] { (*result)->sha256 = (*result)->sums.sha256(); },
                   [result, finished = block.mapped().callbacks.finished] { finished(std::move(*result)); });
    }

    const RelayOptions options;
    const MakeRelayChildren makeChildren;
    const Background background;
    const std::function<double()> clock;
    const std::function<void(const std::string&)> log;
    std::function<void(const JobKey&, uint32_t)> widthTold = [](const JobKey&, uint32_t) {};
    std::map<JobKey, Job> jobs;
    std::vector<std::unique_ptr<RelayChildren>> gone;  ///< on their way
    Totals totals;
};

RelayWorker::RelayWorker(RelayOptions options, MakeRelayChildren children, Background background,
                         std::function<double()> clock, std::function<void(const std::string&)> log)
    : impl_(std::make_shared<Impl>(std::move(options), std::move(children), std::move(background), std::move(clock),
                                   std::move(log))) {}
RelayWorker::~RelayWorker() = default;

void RelayWorker::openJob(const JobKey& job, std::shared_ptr<const Scene> scene, const RenderSettings& settings,
                          std::function<void(const JobReady&)> ready, std::function<void(const Error&)> failed) {
    impl_->open(job, std::move(scene), {settings, std::move(ready), std::move(failed), impl_->clock()});
}

void RelayWorker::renderBlock(const JobKey& key, IterationRange range, BlockCallbacks callbacks) {
    const auto job = impl_->jobs.find(key);
    if (job == impl_->jobs.end()) return callbacks.finished({});
    const double now = impl_->clock();
    job->second.blocks.emplace(range.first, Block{range.count, std::move(callbacks), now});
    job->second.core->coordinator.ask(range);
    job->second.core->coordinator.tick(now);
}

void RelayWorker::truncateBlock(const JobKey& key, uint64_t first) {
    const auto job = impl_->jobs.find(key);
    if (job != impl_->jobs.end() && job->second.blocks.contains(first))
        job->second.core->coordinator.cut(first, impl_->clock());
}

void RelayWorker::closeJob(const JobKey& key) {
    if (const auto job = impl_->jobs.find(key); job != impl_->jobs.end()) impl_->close(job);
}

BlocksAtOnce RelayWorker::blocksAtOnce() const { return {SIZE_MAX, impl_->options.blocks}; }

void RelayWorker::tellWidth(const std::function<void(const JobKey&, uint32_t)>& told) { impl_->widthTold = told; }

void RelayWorker::tick() { impl_->tick(); }

void RelayWorker::stop() {
    while (!impl_->jobs.empty()) impl_->close(impl_->jobs.begin());
}

bool RelayWorker::idle() const { return impl_->jobs.empty() && impl_->gone.empty(); }

RelayWorker::Totals RelayWorker::totals() const {
    Totals totals = impl_->totals;
    totals.jobs = impl_->jobs.size();
    for (const auto& [key, job] : impl_->jobs) {
        if (!job.core) continue;
        totals.width += job.width;
        for (const NodeStatus& node : job.core->coordinator.nodes())
            totals.servers += node.state != NodeStatus::State::Gone && node.state != NodeStatus::State::Quarantined;
    }
    return totals;
}

}  // namespace antipode
