// What Security holds, for the streams of this folder.
#pragma once

#include <array>
#include <optional>

#include <asio/ssl/context.hpp>

#include "proto/wire/stream.h"

namespace antipode::wire {

struct Security::Impl {
    explicit Impl(Role side) : role(side) {}
    ~Impl();
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    void useSecret(const std::string& path);
    void useCertificates(const SecurityOptions& options);

    const Role role;
    std::optional<asio::ssl::context> context;  ///< none: plain TCP
    bool bySecret = false;                      ///< the handshake must have used `secret`
    std::array<unsigned char, 32> secret{};
};

}  // namespace antipode::wire
