#include "server/admission.h"

#include "terminal/text.h"

namespace antipode {
namespace {

using farm::Refusal;

/// Whether `held` + `asked` exceeds `limit`, without overflow.
bool exceeds(uint64_t limit, uint64_t held, uint64_t asked) { return asked > limit || held > limit - asked; }

std::optional<Refusal> refuseBytes(uint64_t limit, uint64_t held, uint64_t asked, const std::string& what) {
    if (!exceeds(limit, held, asked)) return {};
    const std::string needs = "The job needs about " + byteSize(asked) + " of " + what;
    if (exceeds(limit, 0, asked))
        return refusal(Refusal::TOO_LARGE, needs + ", and this server has " + byteSize(limit) +
                                               ": render a smaller image or scene, or use another server.");
    return refusal(Refusal::BUSY, needs + ", and other jobs hold " + byteSize(held) + " of this server's " +
                                      byteSize(limit) + ": try again later.");
}

}  // namespace

JobCosts& JobCosts::operator+=(const JobCosts& o) {
    jobs += o.jobs, deviceBytes += o.deviceBytes, resultBytes += o.resultBytes, sceneBytes += o.sceneBytes;
    return *this;
}

Refusal refusal(Refusal::Code code, const std::string& sentence) {
    Refusal result;
    result.set_code(code);
    result.set_sentence(sentence);
    return result;
}

std::optional<Refusal> refuseSize(const RenderQueueLimits& limits, const JobSize& size, uint64_t sceneBytes) {
    const std::string most = "; this server takes at most " + std::to_string(limits.pixels) + ".";
    if (size.pixels > limits.pixels)
        return refusal(Refusal::TOO_LARGE, "The image has " + std::to_string(size.pixels) + " pixels" + most);
    if (size.lightPaths > limits.pixels)
        return refusal(Refusal::TOO_LARGE,
                       "An iteration has " + std::to_string(size.lightPaths) + " light paths" + most);
    if (sceneBytes > limits.sceneBytes)
        return refusal(Refusal::TOO_LARGE, "The scene has " + byteSize(sceneBytes) + "; this server takes at most " +
                                               byteSize(limits.sceneBytes) + ".");
    return {};
}

std::optional<Refusal> refuseCosts(const RenderQueueLimits& limits, const JobCosts& held, const JobCosts& asked) {
    const uint64_t deviceLimit = limits.deviceBytes ? limits.deviceBytes : UINT64_MAX;
    if (auto refused = refuseBytes(deviceLimit, held.deviceBytes, asked.deviceBytes, "device memory")) return refused;
    if (auto refused = refuseBytes(limits.resultBytes, held.resultBytes, asked.resultBytes, "memory for results"))
        return refused;
    if (auto refused = refuseBytes(limits.sceneBytes, held.sceneBytes, asked.sceneBytes, "memory for scenes"))
        return refused;
    if (exceeds(limits.jobs, held.jobs, asked.jobs))
        return refusal(Refusal::BUSY,
                       "This server has " + std::to_string(held.jobs) + " jobs already: try again later.");
    return {};
}

}  // namespace antipode
