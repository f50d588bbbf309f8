// "Did you mean …?"
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace antipode {

/// The candidate with the smallest edit distance to `typed` (insertions, deletions, substitutions and swaps of
/// neighbours); empty where none is close enough to help. The first candidate wins a tie.
std::string nearestName(std::string_view typed, const std::vector<std::string>& candidates);

/// The same as " Did you mean 'NAME'?" to append to a message.
std::string suggestion(std::string_view typed, const std::vector<std::string>& candidates);

/// The names joined by ", ".
std::string joined(const std::vector<std::string>& names);

}  // namespace antipode
