#include "proto/wire/security.h"

#include "proto/wire/secret_strength.h"

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
    both.pskFile = credentials().secret("9c1f04e7ab52d836").pskFile;
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

TEST(Security, RefusesSecretsThatAreEasyToGuess) {
    for (const char* weak : {"aaaaaaaaaaaaaaaaaaaaaaaa", "passwordpassword", "0123456789abcdef", "abababababababab",
                             "secretsecretsecretsecret", "1111111122222222"})
        expectUnfit(ErrorCode::Input, "easy to guess", credentials().secret(weak));
    EXPECT_LT(wire::estimatedBits("0123456789abcdefghijklmnopqrstuvwxyz"), wire::leastSecretBits);
    EXPECT_GT(wire::estimatedBits("9c1f04e7ab52d836"), wire::leastSecretBits);
    EXPECT_GT(wire::estimatedBits("correct horse battery staple"), 2 * wire::leastSecretBits);
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
    const std::string content = "9c1f04e7ab52d836";
    EXPECT_EQ(key(content), key(content + "\n"));
    EXPECT_NE(key(content), key(content + "\n\n"));
    EXPECT_NE(key(content), key("9c1f04e7ab52d837"));
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
    const SecurityOptions secret = credentials().secret("9c1f04e7ab52d836");
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

/// A secret of a client's own opens servers, and poses as none: neither to other clients nor to those with the
/// servers'.
TEST(Security, AClientsOwnSecretIsNoServers) {
    const Credentials& c = credentials();
    const SecurityOptions shared = c.secret("9c1f04e7ab52d836"), other = c.secret("correct horse battery staple");
    const SecurityOptions ann = c.secret(wire::makeClientSecret(shared.pskFile, "ann") + "\n"),
                          bob = c.secret(wire::makeClientSecret(shared.pskFile, "bob")),
                          strange = c.secret(wire::makeClientSecret(other.pskFile, "ann"));
    const Security server(shared, Role::Server);
    const auto meets = [&](const SecurityOptions& options) {
        const Security client(options, Role::Client);
        return MemoryHandshake(client, server).run();
    };
    EXPECT_TRUE(meets(ann) && meets(bob) && meets(shared));
    EXPECT_FALSE(meets(strange) || meets(other));
    expectUnfit(ErrorCode::Input, "client's secret", ann);
    // Bob, who calls what he has the servers' secret.
    const std::string text = wire::makeClientSecret(shared.pskFile, "bob");
    const Security bobAsServer(c.secret(text.substr(text.rfind(' ') + 1)), Role::Server);
    for (const SecurityOptions& victim : {ann, bob, shared}) {
        const Security client(victim, Role::Client);
        EXPECT_FALSE(MemoryHandshake(client, bobAsServer).run());
    }
    for (const char* name : {"", "two words", "../x"})
        expectError(ErrorCode::Usage, "--client-secret", [&] { wire::makeClientSecret(shared.pskFile, name); });
    expectError(ErrorCode::Input, "already", [&] { wire::makeClientSecret(ann.pskFile, "bob"); });
    for (const char* broken : {"antipode-client ann", "antipode-client ann 12ab", "antipode-client a/b 00"})
        expectError(ErrorCode::Input, "--client-secret", [&] { Security(c.secret(broken), Role::Client); });
}

TEST(Security, RevokedClientsAreNotLetIn) {
    const Credentials& c = credentials();
    SecurityOptions shared = c.secret("9c1f04e7ab52d836");
    const SecurityOptions ann = c.secret(wire::makeClientSecret(shared.pskFile, "ann")),
                          bob = c.secret(wire::makeClientSecret(shared.pskFile, "bob"));
    shared.revokedFile = c.write("revoked", "# left in May\nbob\n\n");
    const Security server(shared, Role::Server), clientAnn(ann, Role::Client), clientBob(bob, Role::Client);
    EXPECT_TRUE(MemoryHandshake(clientAnn, server).run());
    EXPECT_FALSE(MemoryHandshake(clientBob, server).run());
    shared.revokedFile = c.write("revoked", "two names\n");
    expectUnfit(ErrorCode::Input, "one client's name a line", shared);
    SecurityOptions none;
    none.revokedFile = shared.revokedFile;
    expectUnfit(ErrorCode::Usage, "--revoked", none);
    SecurityOptions certificates = c.server();
    certificates.revokedFile = shared.revokedFile;
    expectUnfit(ErrorCode::Input, "revocation list", certificates);
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
