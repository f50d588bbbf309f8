// How hard a secret is to guess.
#pragma once

#include <string_view>

namespace antipode::wire {

/// A secret of fewer bits is refused: whoever records a handshake may try as many as it likes.
constexpr double leastSecretBits = 40;

/// Bits of entropy that the secret's own statistics leave it, at most: repetitions, few different bytes and sequences
/// ("abcd…") count little. What stands in a dictionary it does not know.
double estimatedBits(std::string_view secret);

}  // namespace antipode::wire
