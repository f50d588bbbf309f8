#include "proto/wire/security.h"

#include <gtest/gtest.h>
#include <openssl/ssl.h>

#include "tests/film/expect_error.h"
#include "tests/net/credentials.h"

namespace antipode::test {
namespace {

using wire::Security;
using wire::SecurityOptions;
using Role = Security::Role;

void expectUnfit(ErrorCode code, const std::string& words, const SecurityOptions& options) {
    SCOPED_TRACE(words);
    expectError(code, words, [&] { Security security(options, Role::Server); });
}

TEST(Security, IsPlainWithoutOptions) {
    EXPECT_FALSE(Security({}, Role::Server).encrypted());
    EXPECT_TRUE(Security(credentials().secret("sixteen bytes ok"), Role::Server).encrypted());
    EXPECT_TRUE(Security(credentials().server(), Role::Server).encrypted());
}

TEST(Security, RefusesOptionsThatDoNotFitTogether) {
    SecurityOptions both = credentials().server();
    both.pskFile = credentials().secret("0123456789abcdef").pskFile;
    expectUnfit(ErrorCode::Usage, "not both", both);
    for (const auto missing : {&SecurityOptions::certFile, &SecurityOptions::keyFile, &SecurityOptions::caFile}) {
        SecurityOptions options = credentials().server();
        (options.*missing).clear();
        expectUnfit(ErrorCode::Usage, "all three", options);
    }
}

TEST(Security, RefusesFilesThatAreMissingOrUnfit) {
    const Credentials& c = credentials();
    for (const auto part : {&SecurityOptions::certFile, &SecurityOptions::keyFile, &SecurityOptions::caFile}) {
        SecurityOptions options = c.server();
        options.*part = c.folder.file("nowhere.pem");
        expectUnfit(ErrorCode::Input, "nowhere.pem", options);
        options.*part = c.write("garbage.pem", "no certificate");
        expectUnfit(ErrorCode::Input, "garbage.pem", options);
    }
    SecurityOptions options = c.server();
    options.keyFile = c.server().keyFile;
    expectUnfit(ErrorCode::Input, options.keyFile, options);

    options = c.server();
    ::chmod(options.keyFile.c_str(), 0640);
    expectUnfit(ErrorCode::Input, "chmod 600", options);
}

TEST(Security, RefusesSecretsThatAreNone) {
    const Credentials& c = credentials();
    SecurityOptions options;
    options.pskFile = c.folder.file("nowhere");
    expectUnfit(ErrorCode::Input, "nowhere", options);
    options.pskFile = c.folder.file("");
    expectUnfit(ErrorCode::Input, "folder", options);
    expectUnfit(ErrorCode::Input, "16 bytes", c.secret(""));
    expectUnfit(ErrorCode::Input, "16 bytes", c.secret("fifteen bytes !\n"));
    expectUnfit(ErrorCode::Input, "too long", c.secret(std::string(100000, 'x')));
    EXPECT_NO_THROW(Security(c.secret("sixteen bytes !!\n"), Role::Client));

    const SecurityOptions open = c.secret("sixteen bytes !!\n");
    ::chmod(open.pskFile.c_str(), 0604);
    expectUnfit(ErrorCode::Input, "chmod 600", open);
}

TEST(Security, TellsNothingOfASecret) {
    const std::string secret = "short&secret";
    try {
        Security security(credentials().secret(secret), Role::Server);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()).find(secret), std::string::npos);
    }
}

TEST(Security, DerivesTheKeyFromTheContentButItsLastNewline) {
    const auto key = [](const std::string& content) {
        return Security(credentials().secret(content), Role::Server).impl().secret;
    };
    const std::string content = "0123456789abcdef";
    EXPECT_EQ(key(content), key(content + "\n"));
    EXPECT_NE(key(content), key(content + "\n\n"));
    EXPECT_NE(key(content), key("0123456789abcdeF"));
    EXPECT_NE(key(content + "\r"), key(content));
}

/// A handshake without sockets, for what only OpenSSL can tell.
struct MemoryHandshake {
    MemoryHandshake(const Security& clientSide, const Security& serverSide)
        : client(SSL_new(clientSide.impl().context->native_handle())),
          server(SSL_new(serverSide.impl().context->native_handle())) {
        BIO *clientEnd, *serverEnd;
        BIO_new_bio_pair(&clientEnd, 0, &serverEnd, 0);
        SSL_set_bio(client, clientEnd, clientEnd);
        SSL_set_bio(server, serverEnd, serverEnd);
        SSL_set_connect_state(client);
        SSL_set_accept_state(server);
    }
    ~MemoryHandshake() {
        SSL_free(client);
        SSL_free(server);
    }
    bool run() {
        for (int turn = 0; turn < 10; ++turn) {
            SSL_do_handshake(client);
            SSL_do_handshake(server);
        }
        return SSL_is_init_finished(client) && SSL_is_init_finished(server);
    }
    SSL *client, *server;
};

TEST(Security, UsesTls13WithForwardSecrecyBothWays) {
    const SecurityOptions secret = credentials().secret("0123456789abcdef");
    const std::pair<SecurityOptions, SecurityOptions> ways[] = {{secret, secret},
                                                                {credentials().client(), credentials().server()}};
    for (const auto& [clientOptions, serverOptions] : ways) {
        const Security client(clientOptions, Role::Client), server(serverOptions, Role::Server);
        MemoryHandshake handshake(client, server);
        // A client that would do without must not get it.
        SSL_set_options(handshake.client, SSL_OP_ALLOW_NO_DHE_KEX);
        ASSERT_TRUE(handshake.run());
        EXPECT_EQ(SSL_version(handshake.server), TLS1_3_VERSION);
        EXPECT_NE(SSL_get_negotiated_group(handshake.server), 0);
        EXPECT_EQ(SSL_session_reused(handshake.server) == 1, !clientOptions.pskFile.empty());
    }
}

TEST(Security, SpeaksNothingOlderThanTls13) {
    const Security client(credentials().client(), Role::Client), server(credentials().server(), Role::Server);
    MemoryHandshake handshake(client, server);
    SSL_set_min_proto_version(handshake.client, TLS1_2_VERSION);
    SSL_set_max_proto_version(handshake.client, TLS1_2_VERSION);
    EXPECT_FALSE(handshake.run());
}

}  // namespace
}  // namespace antipode::test
