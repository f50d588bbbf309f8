#include "client/render_job.h"

#include <algorithm>
#include <functional>
#include <iostream>
#include <random>

#include <sys/resource.h>

#include "client/background_writer.h"
#include "client/error_forecast.h"
#include "client/error_target.h"
#include "client/explanation.h"
#include "client/farm_metrics.h"
#include "farm/jobs/checkpoint.h"
#include "farm/jobs/coordinator.h"
#include "client/live_view.h"
#include "client/outputs.h"
#include "renderengine/version.h"
#include "terminal/text.h"
#include "proto/wire/session.h"
#include "renderengine/devices.h"
#include "renderengine/engine.h"
#include "renderengine/error.h"
#include "renderengine/film_scale.h"

namespace antipode {
namespace {

constexpr double stepSeconds = 0.05;
// After an interrupt: for what servers have rendered to arrive. The local device is waited for.
constexpr double farewellSeconds = 3;

/// User and system time of all threads of the process so far.
double processCpuSeconds() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& time) { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Large images on devices that bind little memory at once trace fewer light paths: unbiased, but worth knowing.
void noteFewerLightPaths(uint64_t lightPaths, const RenderSettings& settings) {
    const uint64_t pixels = framePixels(settings);
    if (settings.lightPathCount || lightPaths == 0 || lightPaths >= pixels) return;
    std::cerr << "antipode: note: " << lightPaths << " light paths an iteration for " << pixels
              << " pixels: the device can bind the vertices of no more" << std::endl;
}

/// The checkpoint that the job goes on from, if there is one. --resume has to find one; --checkpoint goes on from what
/// it finds, so that one command line starts a job and takes it up again. Whether the bias of merging is told stays as
/// it was begun: the image does not depend on it.
std::optional<Checkpoint> loadStart(const RenderOptions& options, JobDefinition& job) {
    const bool resumes = !options.resumePath.empty();
    const std::string& kept = options.checkpointPath;
    if (resumes && kept != options.resumePath && checkpointExists(kept))
        throw Error(ErrorCode::Usage, "'" + kept + "' exists, and --resume '" + options.resumePath +
                                          "' would replace it: name a new file with --checkpoint.");
    if (kept.empty() || (!resumes && !checkpointExists(kept))) return std::nullopt;
    LoadedCheckpoint loaded = loadCheckpoint(resumes ? options.resumePath : kept);
    LayerSet& layers = job.settings.layers;
    layers.remove(LayerKind::Blur);
    if (loaded.checkpoint.job.settings.layers.has(LayerKind::Blur)) layers.add(LayerKind::Blur);
    try {
        requireSameJob(loaded.checkpoint, job);
    } catch (const Error& error) {
        if (resumes) throw;
        throw Error(error.code(), std::string(error.what()) + " '" + kept +
                                      "' is left as it is: name another file with --checkpoint.");
    }
    if (!loaded.notice.empty()) std::cerr << "antipode: warning: " << loaded.notice << std::endl;
    return std::move(loaded.checkpoint);
}

CoordinatorOptions coordinatorOptions(const RenderOptions& options, const RenderSettings& settings) {
    CoordinatorOptions result;
    result.iterations = options.iterations;
    result.errorClasses = options.errorClasses();
    // A preview shows what is committed.
    result.targetSeconds = std::clamp(options.previewSeconds.value_or(result.targetSeconds), 0.5, result.targetSeconds);
    result.mostResultsPerSecond = mergeableResults(settings);
    result.verifyFraction = options.verifyFraction.value_or(0);
    result.verifySeed = std::random_device{}();
    result.verifyPatienceSeconds = options.waitSeconds.value_or(result.verifyPatienceSeconds);
    return result;
}

FarmOptions farmOptions(const RenderOptions& options) {
    FarmOptions farm;
    farm.servers = {options.servers, options.serversFile, options.security};
    farm.local = options.local;
    farm.device = options.device;
    farm.build = versionText;
    farm.waitsForEver = !options.waitSeconds && !options.seconds;
    return farm;
}

/// The names of devices that are in the image, each once; where all of it was there before, their classes.
std::string contributors(const std::vector<NodeReport>& nodes, const std::vector<std::string>& earlier) {
    std::vector<std::string> names;
    for (const NodeReport& node : nodes)
        if (node.committed > 0 && std::find(names.begin(), names.end(), node.device) == names.end())
            names.push_back(node.device);
    if (names.empty()) names = earlier;
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

EarlierRuns earlierRuns(const Checkpoint& start) {
    return {start.committed.count(), start.statistics.rays + start.statistics.shadowRays, start.wallSeconds};
}

class RenderRun {
public:
    RenderRun(const RenderOptions& options, JobDefinition job, std::optional<Checkpoint> start, SignalGuard& signals,
              Progress& progress, LiveView* view)
        : options_(options),
          job_(std::move(job)),
          earlier_(start ? earlierRuns(*start) : EarlierRuns()),
          earlierClasses_(start ? start->deviceClasses : std::vector<std::string>()),
          coordinator_(job_, coordinatorOptions(options, job_.settings), std::move(start)),
          signals_(signals),
          progress_(progress),
          view_(view),
          created_(wire::monotonicSeconds()) {
        if (options.metrics) metrics_.emplace(*options.metrics);
        if (options.targetError) {
            target_.emplace(*options.targetError, coordinator_.committed().end());
            coordinator_.holdAt(target_->check());
        }
    }

    /// Whether the checkpoint has all iterations that are asked for.
    bool complete() const { return coordinator_.complete(); }

    void run(std::shared_ptr<const Scene> scene) {
        farm_.emplace(farmOptions(options_), std::move(scene), job_, coordinator_);
        while (!coordinator_.complete()) {
            farm_->runFor(std::min(stepSeconds, secondsLeft()));
            now_ = wire::monotonicSeconds();
            if (!started_ && farm_->everReady()) begin();
            for (const std::string& message : farm_->takeMessages()) tell(message);
            if (mayEnd()) break;
            obeyLimits();
            pursueTarget();
            followError();
            writeFiles();
            showProgress();
            showLive();
            if (metrics_)
                metrics_->publish(farm_->nodes(), coordinator_.committed().count(), elapsed(), forecast_.latest());
        }
        now_ = wire::monotonicSeconds();
        measure();
        showLastLive();
        farm_->shutDown();
        for (const std::string& message : farm_->takeMessages()) tell(message);
        writer_.wait();
        writeLastCheckpoint();
    }

    RenderResult result() const {
        RenderResult result;
        result.scenePath = options_.scenePath;
        result.sceneHash = job_.sceneHash;
        result.jobHash = job_.hash();
        result.settings = job_.settings;
        result.missing = job_.missing;
        result.choice = job_.choice;
        result.sums = coordinator_.sums();
        result.statistics = coordinator_.statistics();
        result.statistics.initialRadius = *job_.settings.initialRadius;
        if (const auto local = farm_ ? farm_->localReady() : std::nullopt) {
            result.statistics.lightPathsPerIteration = local->lightPathsPerIteration;
            result.statistics.deviceBytes = local->deviceBytes;
            result.statistics.bvhPrimitives = local->bvhPrimitives;
            result.statistics.bvhBuildSeconds = local->bvhBuildSeconds;
        }
        result.nodes = nodes_;
        result.device = contributors(result.nodes, earlierClasses_);
        result.wallSeconds = wallSeconds_;
        result.cpuSeconds = cpuSeconds_;
        result.setupSeconds = started_.value_or(now_) - created_;
        result.finalRadius = mergeRadius(*job_.settings.initialRadius, job_.settings.alpha,
                                         std::max<uint64_t>(coordinator_.committed().end(), 1));
        result.earlier = earlier_;
        result.interrupted = !coordinator_.complete();
        result.stoppedBy = stopReason();
        if (options_.estimatesError) result.error = estimateError(result.sums);
        result.failure = failure_;
        return result;
    }

private:
    double elapsed() const { return started_ ? now_ - *started_ : 0; }

    StopReason stopReason() const {
        if (waitedInVain_) return StopReason::NoServer;
        if (!failure_.empty()) return StopReason::Failure;
        if (interruptedAt_) return finishedByPage_ ? StopReason::Page : StopReason::Signal;
        if (targetReached_) return StopReason::TargetError;
        return finishing_ ? StopReason::Time : StopReason::Iterations;
    }

    /// What result() tells of this run.
    void measure() {
        wallSeconds_ = elapsed();
        cpuSeconds_ = processCpuSeconds() - cpuStart_;
        nodes_ = farm_->nodes();
    }

    /// Until the time limit, while it is still to come.
    double secondsLeft() const {
        if (!started_ || !options_.seconds || finishing_) return stepSeconds;
        return std::max(0.0, *started_ + *options_.seconds - wire::monotonicSeconds());
    }

    /// What is rendered must reach the image even where the checkpoint's disk is full.
    void writeLastCheckpoint() {
        if (options_.checkpointPath.empty() || coordinator_.committed().empty()) return;
        try {
            writeCheckpoint(options_.checkpointPath, coordinator_.checkpoint(earlier_.seconds + wallSeconds_));
        } catch (const Error& error) {
            if (failure_.empty()) failure_ = error.what();
        }
    }

    void begin() {
        started_ = now_;
        signals_.beginRendering();
        nextCheckpoint_ = now_ + options_.checkpointSeconds;
        nextPreview_ = now_ + options_.previewSeconds.value_or(0);
        cpuStart_ = processCpuSeconds();
        if (const auto local = farm_->localReady()) noteFewerLightPaths(local->lightPathsPerIteration, job_.settings);
    }

    void tell(const std::string& message) { progress_.interject("antipode: note: " + message); }

    /// Whether it ends here although iterations are missing.
    bool mayEnd() {
        if (failure_ = coordinator_.failure(); !failure_.empty()) return true;
        if (failure_ = farm_->hopeless(); !failure_.empty()) return true;
        if (failure_ = waitedInVain(); !failure_.empty()) return waitedInVain_ = true;
        if (finishing_ && farm_->idleSeconds() > farewellSeconds) {
            tell("the time is over and no server is left: what they had in hand is not in the image");
            return true;
        }
        if (!interruptedAt_) return false;
        const std::vector<NodeReport> nodes = farm_->nodes();
        const bool localBusy = std::any_of(nodes.begin(), nodes.end(),
                                           [](const NodeReport& node) { return node.local && node.leases > 0; });
        return !localBusy && (coordinator_.outstanding() == 0 || now_ > *interruptedAt_ + farewellSeconds);
    }

    /// Why it must not wait any longer for a server; empty where it may. Until the first iteration a time limit bounds
    /// the wait as --wait does.
    std::string waitedInVain() const {
        std::optional<double> limit = options_.waitSeconds;
        if (options_.seconds && !started_) limit = std::min(limit.value_or(*options_.seconds), *options_.seconds);
        if (!options_.usesServers() || !limit || farm_->idleSeconds() <= *limit) return "";
        return "no server has been at work for " + duration(*limit) +
               (options_.waitSeconds == limit ? " (--wait)" : " (--time)") + ": " + farm_->complaints();
    }

    void obeyLimits() {
        const bool byPage = view_ && view_->takeFinishRequest();
        if ((signals_.finishRequested() || byPage) && !interruptedAt_) {
            finishedByPage_ = byPage;
            interruptedAt_ = now_;
            coordinator_.stop(now_);
        }
        if (options_.seconds && started_ && !finishing_ && elapsed() >= *options_.seconds) {
            finishing_ = true;
            coordinator_.finishEarly(now_);
        }
    }

    void add(const ErrorEstimate& estimate) {
        forecast_.add(estimate);
        if (view_) view_->addError(earlier_.seconds + elapsed(), estimate);
    }

    /// Looks at exactly the iterations that the target asks for, so that any farm ends after the same one.
    void pursueTarget() {
        if (!target_ || targetReached_ || finishing_ || interruptedAt_) return;
        if (coordinator_.complete() || coordinator_.committed().prefix() < target_->check()) return;
        const std::optional<ErrorEstimate> estimate = estimateError(coordinator_.sums());
        if (estimate) add(*estimate);
        if ((targetReached_ = target_->reached(estimate)))
            coordinator_.finishEarly(now_);
        else
            coordinator_.holdAt(target_->check());
    }

    /// Estimates the error while it is rendered, for those who want to see it, in a hundredth of the time at most.
    void followError() {
        const bool unseen = options_.quiet && !metrics_ && !view_;
        if (!options_.estimatesError || unseen || !started_ || now_ < nextEstimate_) return;
        const uint64_t iterations = coordinator_.committed().count();
        if (iterations == 0 || (forecast_.latest() && forecast_.latest()->iterations == iterations)) return;
        const double before = wire::monotonicSeconds();
        if (const auto estimate = estimateError(coordinator_.sums())) add(*estimate);
        nextEstimate_ = now_ + 100 * (wire::monotonicSeconds() - before);
    }

    /// The error that was asked for, or the next one that has a round number.
    std::optional<ErrorForecastSeconds> nextForecast() const {
        if (!forecast_.latest()) return std::nullopt;
        const double percent = forecast_.latest()->percent;
        return forecastOf(options_.targetError && *options_.targetError < percent ? *options_.targetError
                                                                                  : nextMark(percent));
    }

    /// At this run's pace.
    std::optional<ErrorForecastSeconds> forecastOf(double wanted) const {
        const double rendered = double(coordinator_.committed().count()) - double(earlier_.iterations);
        if (rendered <= 0) return std::nullopt;
        const auto iterations = forecast_.iterationsTo(wanted);
        if (!iterations) return std::nullopt;
        const double pace = iterationSeconds_ / rendered;
        const double missing = iterations->expected - double(coordinator_.committed().count());
        return ErrorForecastSeconds{wanted, std::max(missing * pace - (elapsed() - iterationSeconds_), 0.0),
                                    iterations->spread * pace};
    }

    void writeFiles() {
        if (const std::string failure = writer_.takeFailure(); !failure.empty()) tell(failure);
        writeRequested_ |= signals_.takeWriteRequest() || (view_ && view_->takeWriteRequest());
        if (!started_ || coordinator_.committed().empty() || writer_.busy()) return;
        if (writeRequested_) {
            writeRequested_ = false;
            writeNow();
        } else if (!options_.checkpointPath.empty() && now_ >= nextCheckpoint_) {
            nextCheckpoint_ = now_ + options_.checkpointSeconds;
            writer_.tryWrite(
                [path = options_.checkpointPath, checkpoint = coordinator_.checkpoint(earlier_.seconds + elapsed())] {
                    writeCheckpoint(path, checkpoint);
                });
        } else if (options_.previewSeconds && now_ >= nextPreview_) {
            nextPreview_ = now_ + *options_.previewSeconds;
            writer_.tryWrite([&options = options_, image = coordinator_.sums().imageAlone(),
                              whole = options_.errorMapPath ? coordinator_.sums() : FilmSums()] {
                writeShownImage(options.pngPath, image.image(), options.exposure);
                if (options.errorMapPath) writeErrorMap(*options.errorMapPath, whole);
            });
        }
    }

    /// As SIGUSR1 asks.
    void writeNow() {
        measure();
        std::optional<Checkpoint> checkpoint;
        if (!options_.checkpointPath.empty()) checkpoint = coordinator_.checkpoint(earlier_.seconds + elapsed());
        if (!options_.quiet)
            tell("writing " + options_.exrPath + " and " + options_.pngPath +
                 (checkpoint ? " and " + options_.checkpointPath : "") + " after " +
                 std::to_string(coordinator_.committed().count()) + " iterations");
        writer_.tryWrite([options = options_, result = result(), checkpoint = std::move(checkpoint)] {
            writeImages(options, result);
            if (checkpoint) writeCheckpoint(options.checkpointPath, *checkpoint);
        });
    }

    void showSetUp() {
        std::string text;
        for (const NodeReport& node : farm_->nodes())
            text += (text.empty() ? "" : ", ") + (options_.usesServers() ? node.name + " " : "") + node.state;
        if (text == setUpShown_) return;
        setUpShown_ = text;
        progress_.showStep(text.empty() ? "waiting for a server" : text);
    }

    void showProgress() {
        if (!started_) return showSetUp();
        if (!progress_.due(elapsed())) return;
        ProgressState state = progressState();
        if (options_.usesServers()) state.nodes = farm_->nodes();
        progress_.show(state);
    }

    /// On the page, where there is one that anybody looks at.
    void showLive() {
        if (!view_ || !started_) return;
        view_->follow(coordinator_.sums(), now_);
        if (view_->due(now_)) showLiveState();
    }

    void showLiveState() {
        view_->show(progressState(), errorCosts(), farm_->nodes(), coordinator_.statistics().stages,
                    interruptedAt_ || finishing_, now_);
    }

    void showLastLive() {
        if (!view_ || !started_) return;
        showLiveState();
        view_->showLast(coordinator_.sums());
    }

    /// Of the next errors that have round numbers, and of the one that was asked for.
    std::vector<ErrorCost> errorCosts() const {
        constexpr size_t marks = 3;
        std::vector<ErrorCost> costs;
        if (!forecast_.latest()) return costs;
        const auto add = [&](double percent, bool asked) {
            std::optional<ErrorForecastSeconds> forecast = forecastOf(percent);
            // A time that is off by more than itself is none.
            if (forecast && forecast->spread >= forecast->seconds) forecast.reset();
            costs.push_back({percent, asked, forecast});
        };
        for (double percent = nextMark(forecast_.latest()->percent); costs.size() < marks; percent = nextMark(percent))
            if (percent != options_.targetError) add(percent, false);
        if (options_.targetError && *options_.targetError < forecast_.latest()->percent)
            add(*options_.targetError, true);
        std::ranges::sort(costs, std::greater(), &ErrorCost::percent);
        return costs;
    }

    ProgressState progressState() {
        const EngineStatistics statistics = coordinator_.statistics();
        ProgressState state;
        state.iterations = coordinator_.committed().count();
        state.resumedIterations = earlier_.iterations;
        state.iterationLimit = options_.iterations;
        state.secondLimit = options_.seconds;
        state.elapsedSeconds = elapsed();
        state.rays = statistics.rays + statistics.shadowRays - earlier_.rays;
        for (const NodeStatus& node : coordinator_.nodes()) state.iterationsInHand += node.inHand;
        if (state.iterations + state.iterationsInHand != iterationsShown_) {
            iterationsShown_ = state.iterations + state.iterationsInHand;
            iterationSeconds_ = elapsed();
        }
        state.iterationSeconds = iterationSeconds_;
        state.error = forecast_.latest();
        state.forecast = nextForecast();
        return state;
    }

    const RenderOptions& options_;
    JobDefinition job_;
    EarlierRuns earlier_;
    std::vector<std::string> earlierClasses_;
    Coordinator coordinator_;
    SignalGuard& signals_;
    Progress& progress_;
    LiveView* const view_;  ///< null where nobody can watch
    BackgroundWriter writer_;
    std::optional<FarmMetrics> metrics_;
    double created_, now_ = 0, nextCheckpoint_ = 0, nextPreview_ = 0;
    std::optional<double> started_, interruptedAt_;
    double wallSeconds_ = 0, cpuSeconds_ = 0, cpuStart_ = 0;
    bool finishing_ = false, writeRequested_ = false, waitedInVain_ = false, targetReached_ = false,
         finishedByPage_ = false;
    std::optional<ErrorTarget> target_;
    ErrorForecast forecast_;
    double nextEstimate_ = 0, iterationSeconds_ = 0;
    uint64_t iterationsShown_ = 0;
    std::string failure_, setUpShown_;
    std::vector<NodeReport> nodes_;
    std::optional<Farm> farm_;  ///< once something is to be rendered
};

/// Where the technique is to be chosen and a checkpoint is there, it was chosen before.
void keepChoice(const RenderOptions& options, RenderSettings& settings) {
    const std::string& path = options.resumePath.empty() ? options.checkpointPath : options.resumePath;
    if (settings.technique != automaticTechnique || path.empty() || !checkpointExists(path)) return;
    settings = withTechnique(settings, loadCheckpoint(path).checkpoint.job.settings.technique);
}

}  // namespace

JobDefinition resolveRender(const RenderOptions& options, const Scene& scene, Progress& progress) {
    RenderSettings settings = options.settings;
    keepChoice(options, settings);
    ResolveOptions resolve{options.allowMissing, {}, options.errorClasses()};
    progress.showStep("looking at the scene through the camera");
    if (settings.technique == automaticTechnique) {
        progress.showStep("trying techniques");
        // A pilot takes a twentieth of the time that is given, and three seconds at most.
        resolve.pilot.seconds = std::min(resolve.pilot.seconds, 0.05 * options.seconds.value_or(1e9));
        if (hasUsableDevice())
            resolve.pilot.renderers = [&](const Scene& tried, const RenderSettings& with) {
                return std::make_unique<Engine>(tried, with, options.device);
            };
    }
    return resolveJob(scene, settings, options.size, resolve);
}

RenderResult runRender(const RenderOptions& options, JobDefinition job, std::shared_ptr<const Scene> scene,
                       SignalGuard& signals, Progress& progress, LiveView* view) {
    std::optional<Checkpoint> start = loadStart(options, job);
    if (!options.servers.empty() || !options.serversFile.empty()) job.film = scaledFilmLayout(*scene, job.settings);
    if (!options.quiet)
        for (const std::string& line : sceneInShort(*scene, job)) progress.interject("antipode: " + line);
    if (start && !options.quiet)
        progress.interject("antipode: note: going on from a checkpoint of " + std::to_string(start->committed.count()) +
                           " iterations");
    if (view) view->beginJob(job);
    RenderRun run(options, std::move(job), std::move(start), signals, progress, view);
    if (!run.complete()) run.run(std::move(scene));
    RenderResult result = run.result();
    if (result.sums.iterations == 0)
        throw Error(ErrorCode::Device, result.failure.empty()
                                           ? "nothing was rendered before the interrupt, nothing is written."
                                           : result.failure);
    return result;
}

}  // namespace antipode
