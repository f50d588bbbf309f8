// antipode study: what accuracy costs in time.
#include <filesystem>
#include <iostream>

#include <unistd.h>

#include "client/commands.h"
#include "client/interrupt.h"
#include "client/render_options.h"
#include "client/study/page.h"
#include "client/study/study.h"
#include "client/study/study_json.h"
#include "proto/wire/session.h"
#include "renderengine/error.h"
#include "renderengine/io/files.h"
#include "terminal/command_line.h"
#include "terminal/text.h"

namespace antipode {
namespace {

namespace fs = std::filesystem;

std::vector<OptionRow> bindingTable(study::StudyOptions& options, bool& quiet) {
    return {
        {"SCENE", "", "scenes to render", "", assignText(options.scenes), true},
        {"--out", "FOLDER", "where study.csv, study.json, index.html and the state go", "", assignText(options.folder)},
        {"--budget", "SECONDS", "rendering of each variant of each scene, by the wall clock", "30",
         assignReal(options.budgetSeconds, 0)},
        {"--technique", "NAME", "technique that knobs are turned on", options.base, assignText(options.base), false,
         techniqueNames()},
        {"--knobs", "LIST", "variants, parted by commas: all, techniques, or names as listed below", options.list,
         assignText(options.list)},
        {"--reference", "FILE.exr", "image to measure against", "rendered", assignText(options.referencePath)},
        {"--reference-technique", "NAME", "technique that the reference is rendered with", options.referenceTechnique,
         assignText(options.referenceTechnique), false, techniqueNames()},
        {"--reference-seconds", "SECONDS", "rendering of the reference", "8 budgets",
         assignReal(options.referenceSeconds, 0)},
        {"--width", "PIXELS", "image width", "the scene's", assignWhole(options.size.width, 1, SettingsLimits::side)},
        {"--height", "PIXELS", "image height", "the scene's",
         assignWhole(options.size.height, 1, SettingsLimits::side)},
        {"--seed", "NUMBER", "seed of the random numbers", "1", assignWhole(options.seed, 0, uint64_t(1) << 32)},
        {"--device", "DEVICE", "device by index, UUID or PCI id", "the best one", assignText(options.device)},
        {"--quiet", "", "print nothing but warnings and errors", "", assignFlag(quiet, true)},
    };
}

std::string variantTable(const study::StudyOptions& options) {
    std::string text = "Variants:\n";
    for (const study::Variant& variant : study::allVariants(options.base))
        text += "  " + variant.name + std::string(28 - variant.name.size(), ' ') +
                (variant.technique ? "the technique" : variant.label) + "\n";
    return text;
}

/// A line that overwrites itself on a terminal, one now and then elsewhere.
class StudyProgress {
public:
    explicit StudyProgress(bool quiet) : quiet_(quiet), terminal_(::isatty(STDERR_FILENO)) {}
    ~StudyProgress() {
        if (open_) std::cerr << "\n";
    }
    void show(const std::string& line, double secondsLeft) {
        const double now = wire::monotonicSeconds();
        if (quiet_ || now < next_) return;
        next_ = now + (terminal_ ? 0.2 : 10);
        std::cerr << (terminal_ ? "\r\x1b[K" : "") << line << ", " << duration(secondsLeft) << " left"
                  << (terminal_ ? "" : "\n") << std::flush;
        open_ = terminal_;
    }

private:
    bool quiet_, terminal_, open_ = false;
    double next_ = 0;
};

}  // namespace

void studyCommand(const std::vector<std::string>& arguments) {
    study::StudyOptions options;
    bool quiet = false;
    if (!parseCommandLine("antipode study", "Shows what accuracy costs in time, scene by scene, on one page.",
                          bindingTable(options, quiet), arguments, variantTable(options)))
        return;
    if (options.folder.empty()) throw Error(ErrorCode::Usage, "antipode study needs --out FOLDER.");
    if (!options.referencePath.empty() && options.scenes.size() > 1)
        throw Error(ErrorCode::Usage, "--reference goes with one scene.");
    study::chooseVariants(options.base, options.list);
    std::error_code failed;
    fs::create_directories(options.folder, failed);
    if (failed) throw Error(ErrorCode::Output, "Cannot make '" + options.folder + "': " + failed.message() + ".");

    SignalGuard signals(!quiet);
    StudyProgress progress(quiet);
    signals.beginRendering();
    const std::vector<study::SceneResult> results =
        study::runStudy(options, {[&](const std::string& line, double left) { progress.show(line, left); },
                                  [&] { return signals.finishRequested(); }});
    const fs::path folder = options.folder;
    writeFileAtomically((folder / "study.csv").string(), study::studyCsv(results));
    writeFileAtomically((folder / "study.json").string(), study::studyJson(results, false));
    writeFileAtomically((folder / "index.html").string(), study::studyPage(study::studyJson(results, true)));
    if (!quiet) std::cout << "wrote " << (folder / "index.html").string() << std::endl;
}

}  // namespace antipode
