#include "client/view/request_guard.h"

#include <algorithm>

#include <openssl/crypto.h>

namespace antipode::view {
namespace {

/// "localhost", "127.x.x.x" or "[::1]" with or without a port, which a tunnel may have changed.
bool namesLoopback(std::string_view host) {
    const size_t end = host.starts_with('[') ? host.find(']') : host.find(':');
    const std::string_view name = host.substr(0, host.starts_with('[') && end != host.npos ? end + 1 : end);
    if (name == "localhost" || name == "[::1]") return true;
    // What ends in a number is nobody's domain.
    return name.starts_with("127.") && name.find_first_not_of("0123456789.") == name.npos;
}

bool isBearerOf(std::string_view authorization, const std::string& token) {
    constexpr std::string_view scheme = "Bearer ";
    if (!authorization.starts_with(scheme)) return false;
    const std::string_view given = authorization.substr(scheme.size());
    return given.size() == token.size() && CRYPTO_memcmp(given.data(), token.data(), token.size()) == 0;
}

}  // namespace

bool isToken(std::string_view token) {
    return !token.empty() && std::ranges::all_of(token, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '.' ||
               c == '_' || c == '~';
    });
}

std::optional<Refusal> refusal(const Asked& asked, const std::string& token) {
    const bool reads = asked.method == "GET", page = asked.path == "/";
    const bool acts = asked.path == "/finish" || asked.path == "/write";
    if (token.empty() && !namesLoopback(asked.host))
        return Refusal{421, "This page is for this machine alone: ask for localhost or 127.0.0.1."};
    if (!page && !acts && asked.path != "/events" && asked.path != "/picture")
        return Refusal{404, "There is nothing here: the page is at /."};
    if (!token.empty() && !page && !isBearerOf(asked.authorization, token))
        return Refusal{401, "The token is missing or wrong: open the page with #TOKEN behind its address."};
    if (acts ? asked.method != "POST" : !reads) return Refusal{405, "That is not how this is asked for."};
    if (!acts) return std::nullopt;
    const size_t scheme = asked.origin.find("://");
    const bool ownPage =
        asked.origin.empty() || (scheme != asked.origin.npos && asked.origin.substr(scheme + 3) == asked.host);
    if (asked.action != "yes" || !ownPage) return Refusal{403, "Only the render's own page may ask for that."};
    return std::nullopt;
}

}  // namespace antipode::view
