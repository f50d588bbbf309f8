// What Security holds, for the streams of this folder.
#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>

#include <asio/ssl/context.hpp>

#include "proto/wire/stream.h"

namespace antipode::wire {

struct Security::Impl {
    explicit Impl(Role side) : role(side) {}
    ~Impl();
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    void useSecret(const SecurityOptions& options);
    void useCertificates(const SecurityOptions& options);

    const Role role;
    std::optional<asio::ssl::context> context;  ///< none: plain TCP
    bool bySecret = false;                      ///< the handshake must have used `secret`
    std::array<unsigned char, 32> secret{};
    std::string identity;           ///< that a client shows: the servers' secret's, or its own
    std::set<std::string> revoked;  ///< identities that a server does not know any more
};

}  // namespace antipode::wire
