#include "client/live_view.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "client/view/request_guard.h"
#include "proto/wire/session.h"
#include "proto/wire/stream.h"
#include "renderengine/error.h"

namespace antipode {
namespace {

constexpr double stateSeconds = 0.5, pictureSeconds = 0.5;
constexpr double bandSeconds = 0.004;  // of 50 ms between two bands
constexpr double restPerPicture = 20;  // a picture takes a twentieth of the loop's time at most
constexpr double farewellSeconds = 5;
constexpr size_t mostNotes = 12;

view::ViewServerOptions serverOptions(const RenderOptions& options) {
    view::ViewServerOptions server{options.view->host, options.view->port, ""};
    if (options.viewTokenPath.empty()) return server;
    server.token = wire::readSecretFile(options.viewTokenPath);
    if (!view::isToken(server.token))
        throw Error(ErrorCode::Input,
                    "'" + options.viewTokenPath +
                        "': a token has to fit into an address: letters, digits and any of -._~ alone.");
    return server;
}

std::string jobText(const JobDefinition& job) {
    const RenderSettings& settings = job.settings;
    std::string text = settings.technique;
    if (!settings.without.empty()) text += " without " + name(settings.without);
    if (settings.precision == Precision::Double) text += ", double precision";
    return text + ", " + std::to_string(settings.width) + " × " + std::to_string(settings.height) + " pixels";
}

}  // namespace

LiveView::LiveView(const RenderOptions& options) : server_(serverOptions(options)), host_(options.view->host) {}

std::string LiveView::address() const {
    return "http://" + wire::Endpoint{host_, std::to_string(server_.port())}.text() + "/";
}

void LiveView::beginImage(const RenderOptions& options) {
    state_ = {};
    state_.scene = options.scenePath == "-" ? "a scene from standard input"
                                            : std::filesystem::path(options.scenePath).filename().string();
    if (options.frames) state_.scene += ", " + std::filesystem::path(options.pngPath).stem().string();
    state_.exposure = options.exposure;
    history_ = {};
    taker_ = {};
    pictured_ = 0;
}

void LiveView::showStep(const std::string& step) {
    state_.phase = step;
    publish();
}

void LiveView::note(const std::string& line) {
    constexpr std::string_view prefix = "antipode: ";
    state_.notes.push_back(line.starts_with(prefix) ? line.substr(prefix.size()) : line);
    if (state_.notes.size() > mostNotes) state_.notes.erase(state_.notes.begin());
}

void LiveView::beginJob(const JobDefinition& job) {
    state_.job = jobText(job);
    state_.techniques = job.settings.layers;
}

bool LiveView::due(double now) const { return server_.watched() && now >= nextState_; }

void LiveView::addError(double seconds, const ErrorEstimate& estimate) { history_.add(seconds, estimate); }

void LiveView::show(ProgressState progress, std::vector<ErrorCost> costs, std::vector<NodeReport> nodes,
                    std::vector<StageTime> stages, bool finishing, double now) {
    nextState_ = now + stateSeconds;
    state_.phase = finishing ? "finishing" : "rendering";
    state_.rendering = true;
    state_.progress = std::move(progress);
    state_.history = history_.points();
    state_.costs = std::move(costs);
    state_.nodes = std::move(nodes);
    state_.stages = std::move(stages);
    publish();
}

void LiveView::follow(const FilmSums& sums, double now) {
    if (!taker_.busy()) {
        if (!server_.wantsPicture() || now < nextPicture_ || sums.iterations == 0 || sums.iterations == pictured_)
            return;
        pictured_ = sums.iterations;
        pictureSeconds_ = 0;
    }
    if (sums.iterations == 0) return;  // withdrawn
    const double before = wire::monotonicSeconds();
    std::optional<view::Picture> picture = taker_.take(sums, bandSeconds);
    pictureSeconds_ += wire::monotonicSeconds() - before;
    if (!picture) return;
    nextPicture_ = now + std::max(pictureSeconds, restPerPicture * pictureSeconds_);
    server_.publishPicture(std::move(*picture));
}

void LiveView::showLast(const FilmSums& sums) {
    if (server_.watched() && sums.iterations > 0) server_.publishPicture(taker_.takeWhole(sums));
}

void LiveView::end(double seconds, const std::optional<ErrorEstimate>& error, const std::vector<std::string>& lines) {
    if (state_.progress && error) {
        state_.progress->error = error;
        history_.add(seconds, *error);
        state_.history = history_.points();
    }
    state_.phase = "finished";
    state_.rendering = false;
    state_.done = true;
    state_.costs.clear();
    state_.ending = lines;
    publish();
    server_.farewell(farewellSeconds);
}

}  // namespace antipode
