#include <gtest/gtest.h>

#include "proto/wire/stream.h"
#include "tests/film/expect_error.h"

namespace antipode::test {
namespace {

using wire::Endpoint;
using wire::parseEndpoint;
using wire::requireSecured;

TEST(Endpoint, HasHostAndPort) {
    for (const char* text : {"localhost:7010", "127.0.0.1:0", "node-7.farm_a.example:65535", "[::1]:7010", "[::]:1"})
        EXPECT_EQ(parseEndpoint("--server", text).text(), text);
    const Endpoint endpoint = parseEndpoint("--server", "[fd00::7]:7010");
    EXPECT_EQ(endpoint.host, "fd00::7");
    EXPECT_EQ(endpoint.port, "7010");
}

TEST(Endpoint, RefusesEverythingElse) {
    const char* texts[] = {"",           ":",     "localhost", "localhost:",    ":7010",  "a:65536", "a:-1",
                           "a:+1",       "a:1x",  "a: 1",      "::1:7010",      "[::1]",  "[]:1",    "[a]:1",
                           "http://a:1", "a b:1", "a:0000001", "[127.0.0.1]:1", "a:http", "a/b:1",   "[::1:1"};
    for (const char* text : texts) {
        SCOPED_TRACE(text);
        expectError(ErrorCode::Usage, "--listen", [&] { parseEndpoint("--listen", text); });
    }
}

TEST(RequireSecured, LetsOnlyLoopbackGoWithoutSecurity) {
    for (const char* host : {"127.0.0.1", "127.8.9.1", "::1", "localhost"})
        EXPECT_NO_THROW(requireSecured({}, {host, "7010"}, "--listen")) << host;
    for (const char* host : {"0.0.0.0", "::", "192.0.2.7", "fd00::7", "::ffff:192.0.2.7"}) {
        SCOPED_TRACE(host);
        expectError(ErrorCode::Usage, "--listen", [&] { requireSecured({}, {host, "7010"}, "--listen"); });
        expectError(ErrorCode::Usage, "--psk-file", [&] { requireSecured({}, {host, "7010"}, "--listen"); });
    }
    expectError(ErrorCode::Usage, "no-such-host.invalid", [] {
        requireSecured({}, {"no-such-host.invalid", "7010"}, "--server");
    });
    wire::SecurityOptions secret, certificate;
    secret.pskFile = certificate.certFile = "some file";
    EXPECT_NO_THROW(requireSecured(secret, {"0.0.0.0", "7010"}, "--listen"));
    EXPECT_NO_THROW(requireSecured(certificate, {"0.0.0.0", "7010"}, "--listen"));
}

}  // namespace
}  // namespace antipode::test
