#include "client/study/study.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <map>
#include <numeric>

#include "client/study/variant_run.h"
#include "proto/scene_loader.h"
#include "renderengine/error.h"
#include "renderengine/error_estimate.h"
#include "renderengine/flip.h"
#include "renderengine/io/files.h"
#include "renderengine/io/text.h"
#include "renderengine/sha256.h"

namespace antipode::study {
namespace {

namespace fs = std::filesystem;

constexpr double referenceBudgets = 8;
constexpr uint32_t referenceClasses = 4;
// The reference must not share random numbers with what is measured against it.
constexpr uint64_t referenceSeedOffset = uint64_t(1) << 40;

class SceneStudy {
public:
    SceneStudy(const StudyOptions& options, const StudyHooks& hooks, const std::string& path)
        : options_(options),
          hooks_(hooks),
          scene_(loadScene(path)),
          prefix_((fs::path(options.folder) / "state" /
                   (fs::path(path).stem().string() + "-" + sceneHash(scene_).substr(0, 8)))
                      .string()) {
        result_.name = scene_.name.empty() ? fs::path(path).stem().string() : scene_.name;
    }

    const std::string& name() const { return result_.name; }

    SceneResult run(double secondsAfter) {
        if (options_.referencePath.empty())
            renderReference(secondsAfter +
                            options_.budgetSeconds * double(chooseVariants(options_.base, options_.list).size()));
        else
            readReference();
        if (result_.reference.image.pixels.empty()) return std::move(result_);
        renderVariants(secondsAfter);
        return std::move(result_);
    }

private:
    JobDefinition job(const RenderSettings& settings) const { return resolveJob(scene_, settings, options_.size); }

    void renderReference(double secondsAfter) {
        RenderSettings settings;
        settings.technique = options_.referenceTechnique;
        settings.seed = options_.seed + referenceSeedOffset;
        settings.residueClasses = referenceClasses;
        const std::string statePath = prefix_ + "." + options_.referenceTechnique + "-reference";
        VariantRun run(statePath, job(settings));
        const double seconds = options_.referenceSeconds.value_or(referenceBudgets * options_.budgetSeconds);
        // One that is finished stays, or what was measured against it would mean something else.
        const std::string finished = statePath + ".finished";
        if (!fs::exists(finished)) {
            while ((run.spent().wall < seconds || run.spent().iterations < referenceClasses) && !hooks_.stop()) {
                run.step(scene_, options_.device);
                hooks_.progress(result_.name + ": reference, " + std::to_string(run.spent().iterations) + " iterations",
                                secondsAfter + seconds - run.spent().wall);
            }
            run.collect();
            run.save();
            if (hooks_.stop()) return;
            writeFileAtomically(finished, std::to_string(run.spent().iterations) + "\n");
        }
        if (const auto estimate = estimateError(run.sums()))
            result_.referencePercent = {estimate->percent, estimate->low, estimate->high};
        result_.reference = {run.sums().image(), standardErrors(run.sums())};
        result_.device = run.deviceName();
        result_.referenceText = options_.referenceTechnique + ", " + std::to_string(run.spent().iterations) +
                                " iterations with random numbers of their own";
        tag_ = "." + options_.referenceTechnique;
    }

    void readReference() {
        result_.reference.image = readExr(options_.referencePath);
        const Image& image = result_.reference.image;
        const RenderSettings settings = job({}).settings;
        if (image.width != settings.width || image.height != settings.height)
            throw Error(ErrorCode::Usage, "The reference '" + options_.referencePath + "' is of " +
                                              std::to_string(image.width) + "x" + std::to_string(image.height) +
                                              " pixels, the scene of " + std::to_string(settings.width) + "x" +
                                              std::to_string(settings.height) + ": give --width and --height.");
        const std::vector<uint8_t> bytes = readFileBytes(options_.referencePath);
        result_.referenceText = "given (" + fs::path(options_.referencePath).filename().string() + ")";
        tag_ = "." + hexadecimal(sha256Of({reinterpret_cast<const char*>(bytes.data()), bytes.size()})).substr(0, 8);
    }

    void measure(VariantRun& run) const {
        run.collect();
        const Image image = run.sums().image();
        const std::vector<float> flip = flipErrors(image, result_.reference.image);
        run.snapshots().push_back({run.spent().iterations, run.spent().wall, run.spent().cpu, run.spent().device(),
                                   measureTiles(image, result_.reference),
                                   std::accumulate(flip.begin(), flip.end(), 0.0) / double(flip.size())});
        run.save();
    }

    /// Of each variant its job. A knob that stands where the scene has it already is no variant: what would be measured
    /// against it is measured against the one that it equals.
    std::vector<std::pair<Variant, JobDefinition>> differentJobs() const {
        std::vector<std::pair<Variant, JobDefinition>> jobs;
        std::map<std::string, std::string> firstOf, equals;
        for (Variant variant : chooseVariants(options_.base, options_.list)) {
            RenderSettings settings = variant.settings;
            settings.seed = options_.seed;
            const RenderSettings sized = job(settings).settings;
            settings.width = sized.width, settings.height = sized.height;
            turnKnob(variant.name, settings);
            const JobDefinition definition = job(settings);
            const auto [first, isNew] = firstOf.try_emplace(definition.hash(), variant.name);
            equals[variant.name] = first->second;
            if (!isNew) continue;
            if (!variant.against.empty()) variant.against = equals.at(variant.against);
            jobs.emplace_back(variant, definition);
        }
        return jobs;
    }

    /// The variant that had the least time so far goes next, so that what disturbs the machine disturbs all alike.
    void renderVariants(double secondsAfter) {
        std::vector<VariantRun> runs;
        for (const auto& [variant, definition] : differentJobs()) {
            runs.emplace_back(prefix_ + tag_ + "." + variant.name, definition);
            result_.variants.push_back({variant, {}, {}, {}});
        }
        while (!hooks_.stop()) {
            const auto next = std::min_element(runs.begin(), runs.end(), [](const VariantRun& a, const VariantRun& b) {
                return a.spent().wall < b.spent().wall;
            });
            if (next->spent().wall >= options_.budgetSeconds) break;
            next->step(scene_, options_.device);
            if (std::has_single_bit(next->spent().iterations)) measure(*next);
            double left = secondsAfter;
            for (const VariantRun& run : runs) left += std::max(options_.budgetSeconds - run.spent().wall, 0.0);
            hooks_.progress(result_.name + ": " + result_.variants[size_t(next - runs.begin())].variant.name + ", " +
                                std::to_string(next->spent().iterations) + " iterations",
                            left);
        }
        for (size_t i = 0; i < runs.size(); ++i) {
            VariantRun& run = runs[i];
            if (run.spent().iterations > 0 &&
                (run.snapshots().empty() || run.snapshots().back().iterations != run.spent().iterations))
                measure(run);
            VariantResult& result = result_.variants[i];
            result.spent = run.spent();
            result.snapshots = run.snapshots();
            if (run.spent().iterations > 0) result.image = run.sums().image(), result_.device = run.deviceName();
        }
    }

    const StudyOptions& options_;
    const StudyHooks& hooks_;
    const Scene scene_;
    const std::string prefix_;
    std::string tag_;
    SceneResult result_;
};

}  // namespace

double Spent::device() const {
    double seconds = 0;
    for (const StageTime& stage : stages) seconds += stage.seconds;
    return seconds;
}

std::vector<SceneResult> runStudy(const StudyOptions& options, const StudyHooks& hooks) {
    fs::create_directories(fs::path(options.folder) / "state");
    const double variants = double(chooseVariants(options.base, options.list).size());
    const double reference =
        options.referencePath.empty() ? options.referenceSeconds.value_or(referenceBudgets * options.budgetSeconds) : 0;
    std::vector<SceneResult> results;
    for (size_t i = 0; i < options.scenes.size() && !hooks.stop(); ++i) {
        const double after = double(options.scenes.size() - 1 - i) * (variants * options.budgetSeconds + reference);
        results.push_back(SceneStudy(options, hooks, options.scenes[i]).run(after));
    }
    // A reference that was not finished has nothing measured against it.
    std::erase_if(results, [](const SceneResult& result) { return result.reference.image.pixels.empty(); });
    return results;
}

}  // namespace antipode::study
