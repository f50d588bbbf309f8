#include "farm/nodes/remote_checks.h"

#include <algorithm>
#include <cmath>

#include "proto/wire/block_codec.h"
#include "proto/wire/frame.h"
#include "proto/wire/job_messages.h"
#include "renderengine/io/text.h"

namespace antipode {
namespace {

constexpr size_t maxTextBytes = 256;
constexpr int maxStages = 64;
constexpr uint64_t maxIteration = 1ull << 62;

void checkText(const std::string& text, const char* what) {
    if (text.size() > maxTextBytes) throw wire::ProtocolError(std::string(what) + " is longer than 256 bytes");
    if (std::any_of(text.begin(), text.end(), isControl))
        throw wire::ProtocolError(std::string(what) + " contains control characters");
}

void checkSeconds(double seconds, const char* what) {
    if (!std::isfinite(seconds) || seconds < 0)
        throw wire::ProtocolError(std::string(what) + " is not a number of seconds");
}

}  // namespace

void checkWelcome(const farm::Welcome& welcome) {
    checkText(welcome.build(), "the server's build");
    checkText(welcome.kernel_hash(), "the server's kernel hash");
    checkText(welcome.device().name(), "the device's name");
    checkText(welcome.device().kind(), "the device's kind");
    checkText(welcome.device().driver(), "the device's driver");
    checkText(welcome.device().device_class(), "the device's class");
    if (welcome.device().device_class().empty()) throw wire::ProtocolError("the device has no class");
    if (welcome.lease_depth() == 0) throw wire::ProtocolError("the server takes no leases: its depth is 0");
}

void checkJobReady(const farm::JobReady& ready) { checkText(ready.renderings(), "the class of the relay's servers"); }

std::optional<std::string> incompatibility(const farm::Hello& hello, const farm::Welcome& welcome) {
    const std::string builds = "the server is build " + welcome.build() + ", this client is build " + hello.build() +
                               "; install the same on both";
    if (welcome.protocol() < hello.oldest_protocol() || welcome.protocol() > hello.newest_protocol())
        return "The server speaks protocol " + std::to_string(welcome.protocol()) +
               ", which this client does not: " + builds + ".";
    if (welcome.kernel_hash() != hello.kernel_hash())
        return "The server's kernels are others than this client's, so that its pixels would not fit: " + builds + ".";
    return std::nullopt;
}

void checkOffer(const farm::ResultOffer& offer, const RenderSettings& settings) {
    if (offer.count() == 0 || offer.count() > maxIteration || offer.first() > maxIteration)
        throw wire::ProtocolError("a result is of no possible range of iterations");
    if (offer.sha256().size() != 32) throw wire::ProtocolError("a result's hash has not 32 bytes");
    const FilmLayout layout = wire::layoutOf(settings, offer.scale_exponent());
    if (offer.width() != layout.width || offer.height() != layout.height)
        throw wire::ProtocolError("a result has another size than the job");
    if (offer.chunks() != wire::chunkCount(layout.values()))
        throw wire::ProtocolError("a result has another number of chunks than its size calls for");
    wire::fromMessage(offer.events());
    checkSeconds(offer.seconds(), "a result's rendering time");
    if (offer.statistics().stage_size() > maxStages)
        throw wire::ProtocolError("a result has statistics of more than 64 stages");
    for (const farm::StageTime& stage : offer.statistics().stage()) {
        checkText(stage.stage(), "a stage's name");
        checkSeconds(stage.seconds(), "a stage's time");
    }
}

IterationRange rangeOf(const farm::ResultOffer& offer) { return {offer.first(), offer.count()}; }

}  // namespace antipode
