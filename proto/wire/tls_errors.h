// What a failure of TLS means for whoever runs a client or a server.
#pragma once

#include <string>

#include <asio/error_code.hpp>
#include <asio/system_error.hpp>
#include <openssl/types.h>

#include "proto/wire/stream.h"

namespace antipode::wire {

/// The error with a sentence before OpenSSL's own words. `peerName`: what the peer's certificate must be valid for.
asio::system_error explain(const asio::error_code& code, const SSL* ssl, const Security& security,
                           const std::string& peerName);

}  // namespace antipode::wire
