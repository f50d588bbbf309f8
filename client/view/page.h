// The page on which a render is seen.
#pragma once

#include <string_view>

namespace antipode::view {

/// One document that asks for nothing but this server's /events, /picture, /finish and /write.
std::string_view page();

}  // namespace antipode::view
