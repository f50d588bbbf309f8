// Who may ask the page's server for what.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace antipode::view {

/// Of a request what decides whether it is answered; headers that it lacks are empty.
struct Asked {
    std::string_view method, path;  ///< path: without query
    std::string_view host, origin, authorization, action;
};

struct Refusal {
    unsigned status = 0;   ///< of HTTP
    std::string sentence;  ///< for whoever asked
};

/// Why a request gets no answer; nothing where it does.
///
/// Without a token the server listens on loopback, where other users of the machine may see the render, but pages of
/// other sites in this user's browser may not: their own names do not stand for it (a name of theirs that leads here is
/// refused by the Host header), and what changes the render must carry a header that no other site's page can send
/// without asking first, and come from a page of this host. With a token all but the page itself, which holds nothing,
/// needs "Authorization: Bearer TOKEN"; the page takes it from its address behind the #, which browsers do not send.
std::optional<Refusal> refusal(const Asked& asked, const std::string& token);

/// Whether a token can stand in an address: letters, digits, and any of -._~
bool isToken(std::string_view token);

/// What requests that change the render carry: "Antipode-Action: yes".
inline constexpr const char* actionHeader = "Antipode-Action";

}  // namespace antipode::view
