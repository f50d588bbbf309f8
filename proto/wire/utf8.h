// Text from files that need not say how it is encoded.
#pragma once

#include <string>

namespace antipode::wire {

/// Leaves valid UTF-8 (RFC 3629) alone; otherwise puts a question mark in place of every byte that is not ASCII.
void makeUtf8(std::string& text);

}  // namespace antipode::wire
