// What a server's messages must be like on their own, whatever has been said before.
#pragma once

#include <optional>
#include <string>

#include "proto/farm.pb.h"
#include "renderengine/iteration_range.h"
#include "renderengine/settings.h"

namespace antipode {

/// Throws ProtocolError for texts that are too long or not printable and for a depth of 0.
void checkWelcome(const farm::Welcome& welcome);

/// Throws ProtocolError for a class of renderings that is too long or not printable.
void checkJobReady(const farm::JobReady& ready);

/// Why the two cannot work together, if they cannot: a sentence with both builds.
std::optional<std::string> incompatibility(const farm::Hello& hello, const farm::Welcome& welcome);

/// Throws ProtocolError unless the offer could be a result of the job: its size, chunks, range, numbers and events.
/// Whether its lease was granted is another question.
void checkOffer(const farm::ResultOffer& offer, const RenderSettings& settings);

IterationRange rangeOf(const farm::ResultOffer& offer);

}  // namespace antipode
