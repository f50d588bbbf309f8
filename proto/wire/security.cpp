#include "proto/wire/security.h"

#include <cerrno>
#include <cstring>
#include <string_view>

#include <fcntl.h>
#include <openssl/crypto.h>
#include <openssl/err.h>
#include <openssl/sha.h>
#include <openssl/ssl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "renderengine/error.h"
#include "renderengine/io/descriptor.h"

namespace antipode::wire {
namespace {

constexpr size_t leastSecretBytes = 16, mostSecretBytes = 64 << 10;
constexpr std::string_view secretContext =
    "antipode farm secret 1\n";  ///< keeps the key apart from other uses of a file
constexpr std::string_view identity = "antipode";
/// TLS_AES_128_GCM_SHA256: a TLS 1.3 secret goes with one hash, and the only suite that both sides then offer is this.
constexpr const char* secretSuite = "TLS_AES_128_GCM_SHA256";
constexpr unsigned char secretSuiteCode[] = {0x13, 0x01};

[[noreturn]] void unfit(const std::string& path, const std::string& why) {
    throw Error(ErrorCode::Input, "Cannot use '" + path + "': " + why + ".");
}

/// The first entry of OpenSSL's error queue, which is emptied.
std::string opensslReason() {
    const char* reason = ERR_reason_error_string(ERR_get_error());
    ERR_clear_error();
    return reason ? reason : "OpenSSL gives no reason";
}

/// An open file that nobody else may read. Like ssh, looks only at files of the user's own: whoever mounted another's
/// decided who may read it.
class PrivateFile {
public:
    explicit PrivateFile(const std::string& path) : path_(path), file_(openFile(path, O_RDONLY)) {
        if (!file_) unfit(path, std::strerror(errno));
        struct stat status {};
        if (::fstat(file_.get(), &status) != 0) unfit(path, "its owner is unknown");
        if (S_ISDIR(status.st_mode)) unfit(path, "it is a folder");
        if (status.st_uid == ::geteuid() && (status.st_mode & 077) != 0)
            unfit(path, "others can read it; run: chmod 600 '" + path + "'");
    }

    /// Fills the buffer as far as the file goes.
    size_t read(char* buffer, size_t size) const {
        const std::optional<size_t> filled = readFully(file_, buffer, size);
        if (!filled) unfit(path_, std::strerror(errno));
        return *filled;
    }

private:
    const std::string& path_;
    Descriptor file_;
};

/// Bytes that are wiped when they go.
struct SecretBytes {
    std::string bytes;
    ~SecretBytes() { OPENSSL_cleanse(bytes.data(), bytes.size()); }
};

std::array<unsigned char, 32> keyFromFile(const std::string& path) {
    const PrivateFile file(path);
    SecretBytes content{std::string(mostSecretBytes + 1, '\0')};
    std::string_view secret(content.bytes.data(), file.read(content.bytes.data(), content.bytes.size()));
    if (secret.size() > mostSecretBytes) unfit(path, "it is too long for a secret");
    if (secret.ends_with('\n')) secret.remove_suffix(1);
    if (secret.size() < leastSecretBytes)
        unfit(path, "a secret has at least " + std::to_string(leastSecretBytes) +
                        " bytes; make one with: (umask 077; openssl rand -hex 32 > '" + path + "')");
    SecretBytes hashed;
    hashed.bytes.reserve(secretContext.size() + secret.size());
    hashed.bytes.append(secretContext).append(secret);
    std::array<unsigned char, 32> key;
    SHA256(reinterpret_cast<const unsigned char*>(hashed.bytes.data()), hashed.bytes.size(), key.data());
    return key;
}

// ---- TLS 1.3 with an external pre-shared key. OpenSSL adds an (EC)DHE exchange unless told not to: forward secrecy.

/// Where an SSL_CTX keeps its Security::Impl; the application data are Asio's.
int implIndex() {
    static const int index = SSL_CTX_get_ex_new_index(0, nullptr, nullptr, nullptr, nullptr);
    return index;
}

/// The session that stands for the secret; null where memory is short.
SSL_SESSION* secretSession(SSL* ssl) {
    const auto* impl = static_cast<const Security::Impl*>(SSL_CTX_get_ex_data(SSL_get_SSL_CTX(ssl), implIndex()));
    const SSL_CIPHER* cipher = SSL_CIPHER_find(ssl, secretSuiteCode);
    SSL_SESSION* session = SSL_SESSION_new();
    if (impl && cipher && session &&
        SSL_SESSION_set1_master_key(session, impl->secret.data(), impl->secret.size()) == 1 &&
        SSL_SESSION_set_cipher(session, cipher) == 1 && SSL_SESSION_set_protocol_version(session, TLS1_3_VERSION) == 1)
        return session;
    SSL_SESSION_free(session);
    return nullptr;
}

int offerSecret(SSL* ssl, const EVP_MD*, const unsigned char** id, size_t* idBytes, SSL_SESSION** session) {
    *session = secretSession(ssl);
    *id = reinterpret_cast<const unsigned char*>(identity.data());
    *idBytes = identity.size();
    return *session != nullptr;
}

int findSecret(SSL* ssl, const unsigned char* id, size_t idBytes, SSL_SESSION** session) {
    *session = nullptr;
    if (std::string_view(reinterpret_cast<const char*>(id), idBytes) != identity) return 1;
    *session = secretSession(ssl);
    return *session != nullptr;
}

/// TLS 1.3 only, no sessions to resume: each connection proves itself anew.
asio::ssl::context makeContext() {
    asio::ssl::context context(asio::ssl::context::tls);
    SSL_CTX* handle = context.native_handle();
    SSL_CTX_set_min_proto_version(handle, TLS1_3_VERSION);
    SSL_CTX_set_num_tickets(handle, 0);
    SSL_CTX_set_session_cache_mode(handle, SSL_SESS_CACHE_OFF);
    // Without a store of trusted certificates this refuses all of them, so that a server cannot pass with a certificate
    // where the secret is what counts.
    SSL_CTX_set_verify(handle, SSL_VERIFY_PEER | SSL_VERIFY_FAIL_IF_NO_PEER_CERT, nullptr);
    // A key with a password would otherwise be asked for on the terminal.
    SSL_CTX_set_default_passwd_cb(handle, [](char*, int, int, void*) { return -1; });
    return context;
}

}  // namespace

Security::Impl::~Impl() { OPENSSL_cleanse(secret.data(), secret.size()); }

void Security::Impl::useSecret(const std::string& path) {
    secret = keyFromFile(path);
    bySecret = true;
    context.emplace(makeContext());
    SSL_CTX* handle = context->native_handle();
    if (implIndex() < 0 || SSL_CTX_set_ex_data(handle, implIndex(), this) != 1 ||
        SSL_CTX_set_ciphersuites(handle, secretSuite) != 1)
        unfit(path, opensslReason());
    // A server of OpenSSL that verifies peers wants sessions labelled; a client would miss the label in the secret's.
    if (role == Role::Server)
        SSL_CTX_set_session_id_context(handle, reinterpret_cast<const unsigned char*>(identity.data()),
                                       identity.size());
    SSL_CTX_set_psk_use_session_callback(handle, offerSecret);
    SSL_CTX_set_psk_find_session_callback(handle, findSecret);
}

void Security::Impl::useCertificates(const SecurityOptions& options) {
    context.emplace(makeContext());
    SSL_CTX* handle = context->native_handle();
    ERR_clear_error();
    if (SSL_CTX_use_certificate_chain_file(handle, options.certFile.c_str()) != 1)
        unfit(options.certFile, opensslReason());
    { const PrivateFile readable(options.keyFile); }
    if (SSL_CTX_use_PrivateKey_file(handle, options.keyFile.c_str(), SSL_FILETYPE_PEM) != 1 ||
        SSL_CTX_check_private_key(handle) != 1)
        unfit(options.keyFile,
              "it is not the key of '" + options.certFile + "' without a password: " + opensslReason());
    if (SSL_CTX_load_verify_file(handle, options.caFile.c_str()) != 1) unfit(options.caFile, opensslReason());
}

Security::Security(const SecurityOptions& options, Role role) : impl_(std::make_unique<Impl>(role)) {
    const bool certificate = !options.certFile.empty(), key = !options.keyFile.empty(), ca = !options.caFile.empty();
    if (!options.pskFile.empty() && (certificate || key || ca))
        throw Error(ErrorCode::Usage, "Give either a secret (--psk-file) or certificates (--tls-cert), not both.");
    if (certificate != key || certificate != ca)
        throw Error(ErrorCode::Usage, "--tls-cert, --tls-key and --tls-ca belong together: give all three.");
    if (!options.pskFile.empty()) impl_->useSecret(options.pskFile);
    if (certificate) impl_->useCertificates(options);
}

Security::~Security() = default;

bool Security::encrypted() const { return impl_->context.has_value(); }

}  // namespace antipode::wire
