// A render as it is seen in a browser (--view).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "farm/jobs/job_definition.h"
#include "client/live_state.h"
#include "client/render_options.h"
#include "client/view/picture.h"
#include "client/view/view_server.h"

namespace antipode {

/// Stands between the render's event loop, on whose thread all calls are made, and the server of its page. None of them
/// waits, but end(); while nobody watches they do next to nothing.
class LiveView {
public:
    /// Listens where `options.view` says. Throws Error(Usage) where nobody can, Error(Input) for an unfit token.
    explicit LiveView(const RenderOptions& options);

    /// Where the page is, for people.
    std::string address() const;

    /// Another image is begun.
    void beginImage(const RenderOptions& options);
    void showStep(const std::string& step);
    void note(const std::string& line);
    void beginJob(const JobDefinition& job);

    /// Whether the state would be shown to anybody now.
    bool due(double now) const;
    void addError(double seconds, const ErrorEstimate& estimate);
    void show(ProgressState progress, std::vector<ErrorCost> costs, std::vector<NodeReport> nodes,
              std::vector<StageTime> stages, bool finishing, double now);
    /// Takes some milliseconds' worth of a picture where one is wanted.
    void follow(const FilmSums& sums, double now);
    /// The image as it will be written, where anybody watches.
    void showLast(const FilmSums& sums);

    bool takeFinishRequest() { return server_.takeFinishRequest(); }
    bool takeWriteRequest() { return server_.takeWriteRequest(); }

    /// Shows that all is over and written, and waits for pages to have seen it and the last picture: five seconds at
    /// most, and not where there are none.
    /// `seconds` of rendering; `error`: of the image that was written, where it is known.
    void end(double seconds, const std::optional<ErrorEstimate>& error, const std::vector<std::string>& lines);

private:
    void publish() { server_.publishState(liveStateJson(state_)); }

    view::ViewServer server_;
    std::string host_;
    LiveState state_;
    view::ErrorHistory history_;
    view::PictureTaker taker_;
    double nextState_ = 0, nextPicture_ = 0, pictureSeconds_ = 0;
    uint64_t pictured_ = 0;  ///< iterations of the latest picture
};

}  // namespace antipode
