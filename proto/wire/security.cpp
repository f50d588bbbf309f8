#include "proto/wire/security.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string_view>

#include <fcntl.h>
#include <openssl/crypto.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>
#include <openssl/sha.h>
#include <openssl/ssl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "proto/wire/secret_strength.h"
#include "renderengine/error.h"
#include "renderengine/io/descriptor.h"
#include "renderengine/io/text.h"

namespace antipode::wire {
namespace {

constexpr size_t leastSecretBytes = 16, mostSecretBytes = 64 << 10;
constexpr std::string_view secretContext =
    "antipode farm secret 1\n";  ///< keeps the key apart from other uses of a file
constexpr std::string_view sharedIdentity = "antipode";
/// Roles are in identities: a client with a secret of its own is another one, and its secret is none of a server's.
constexpr std::string_view clientIdentity = "antipode client ", clientSecretMark = "antipode-client ";
constexpr size_t mostNameBytes = 64;
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

using Key = std::array<unsigned char, 32>;

SecretBytes readSecret(const std::string& path) {
    const PrivateFile file(path);
    SecretBytes content{std::string(mostSecretBytes + 1, '\0')};
    const size_t size = file.read(content.bytes.data(), content.bytes.size());
    if (size > mostSecretBytes) unfit(path, "it is too long for a secret");
    content.bytes.resize(size);
    if (content.bytes.ends_with('\n')) content.bytes.pop_back();
    return content;
}

void requireStrong(const std::string& path, std::string_view secret) {
    const std::string advice = "; make one with: (umask 077; openssl rand -hex 32 > '" + path + "')";
    if (secret.size() < leastSecretBytes)
        unfit(path, "a secret has at least " + std::to_string(leastSecretBytes) + " bytes" + advice);
    if (estimatedBits(secret) < leastSecretBits) unfit(path, "the secret is easy to guess" + advice);
}

/// Of the secret that servers have.
Key sharedKey(const std::string& path, std::string_view secret) {
    requireStrong(path, secret);
    SecretBytes hashed;
    hashed.bytes.reserve(secretContext.size() + secret.size());
    hashed.bytes.append(secretContext).append(secret);
    Key key;
    SHA256(reinterpret_cast<const unsigned char*>(hashed.bytes.data()), hashed.bytes.size(), key.data());
    return key;
}

/// Of a client, whose identity it is. One-way: a client knows neither the servers' key nor another client's.
Key clientKey(const Key& shared, std::string_view identity) {
    Key key;
    unsigned int size = 0;
    HMAC(EVP_sha256(), shared.data(), int(shared.size()), reinterpret_cast<const unsigned char*>(identity.data()),
         identity.size(), key.data(), &size);
    return key;
}

bool isName(std::string_view name) {
    const auto fits = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-';
    };
    return !name.empty() && name.size() <= mostNameBytes && std::ranges::all_of(name, fits);
}

/// "antipode-client NAME KEY", KEY in hexadecimal.
void parseClientSecret(const std::string& path, std::string_view text, std::string& identity, Key& key) {
    text.remove_prefix(clientSecretMark.size());
    const size_t space = text.find(' ');
    const std::string_view name = text.substr(0, space);
    const std::string_view digits = space == std::string_view::npos ? "" : text.substr(space + 1);
    if (!isName(name) || digits.size() != 2 * key.size() ||
        digits.find_first_not_of("0123456789abcdef") != std::string_view::npos)
        unfit(path, "it is no client's secret as --client-secret prints it");
    identity = std::string(clientIdentity) + std::string(name);
    SecretBytes bytes{fromHexadecimal(std::string(digits))};
    std::ranges::copy(bytes.bytes, key.begin());
}

/// The identities of the names in a file, one a line; what follows a '#' does not count.
std::set<std::string> readRevoked(const std::string& path) {
    std::ifstream file(path);
    if (!file) unfit(path, std::strerror(errno));
    std::set<std::string> identities;
    for (std::string line; std::getline(file, line);) {
        line.erase(std::min(line.find('#'), line.size()));
        std::istringstream words(line);
        std::string name, rest;
        if (!(words >> name)) continue;
        if (words >> rest || !isName(name)) unfit(path, "one client's name a line, not '" + line + "'");
        identities.insert(std::string(clientIdentity) + name);
    }
    return identities;
}

// ---- TLS 1.3 with an external pre-shared key. OpenSSL adds an (EC)DHE exchange unless told not to: forward secrecy.

/// Where an SSL_CTX keeps its Security::Impl; the application data are Asio's.
int implIndex() {
    static const int index = SSL_CTX_get_ex_new_index(0, nullptr, nullptr, nullptr, nullptr);
    return index;
}

const Security::Impl* implOf(const SSL* ssl) {
    return static_cast<const Security::Impl*>(SSL_CTX_get_ex_data(SSL_get_SSL_CTX(ssl), implIndex()));
}

/// The session that stands for a key; null where memory is short.
SSL_SESSION* sessionOf(SSL* ssl, const Key& key) {
    const SSL_CIPHER* cipher = SSL_CIPHER_find(ssl, secretSuiteCode);
    SSL_SESSION* session = SSL_SESSION_new();
    if (cipher && session && SSL_SESSION_set1_master_key(session, key.data(), key.size()) == 1 &&
        SSL_SESSION_set_cipher(session, cipher) == 1 && SSL_SESSION_set_protocol_version(session, TLS1_3_VERSION) == 1)
        return session;
    SSL_SESSION_free(session);
    return nullptr;
}

int offerSecret(SSL* ssl, const EVP_MD*, const unsigned char** id, size_t* idBytes, SSL_SESSION** session) {
    const Security::Impl* impl = implOf(ssl);
    *session = sessionOf(ssl, impl->secret);
    *id = reinterpret_cast<const unsigned char*>(impl->identity.data());
    *idBytes = impl->identity.size();
    return *session != nullptr;
}

int findSecret(SSL* ssl, const unsigned char* id, size_t idBytes, SSL_SESSION** session) {
    *session = nullptr;
    const Security::Impl* impl = implOf(ssl);
    const std::string identity(reinterpret_cast<const char*>(id), idBytes);
    if (identity == sharedIdentity) {
        *session = sessionOf(ssl, impl->secret);
    } else {
        const bool known = identity.starts_with(clientIdentity) &&
                           isName(std::string_view(identity).substr(clientIdentity.size())) &&
                           !impl->revoked.contains(identity);
        if (!known) return 1;
        Key key = clientKey(impl->secret, identity);
        *session = sessionOf(ssl, key);
        OPENSSL_cleanse(key.data(), key.size());
    }
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

void Security::Impl::useSecret(const SecurityOptions& options) {
    const std::string& path = options.pskFile;
    const SecretBytes content = readSecret(path);
    identity = sharedIdentity;
    if (!content.bytes.starts_with(clientSecretMark))
        secret = sharedKey(path, content.bytes);
    else if (role == Role::Server)
        unfit(path, "it is a client's secret; a server needs the one that it was made of");
    else
        parseClientSecret(path, content.bytes, identity, secret);
    if (!options.revokedFile.empty()) revoked = readRevoked(options.revokedFile);
    bySecret = true;
    context.emplace(makeContext());
    SSL_CTX* handle = context->native_handle();
    if (implIndex() < 0 || SSL_CTX_set_ex_data(handle, implIndex(), this) != 1 ||
        SSL_CTX_set_ciphersuites(handle, secretSuite) != 1)
        unfit(path, opensslReason());
    // A server of OpenSSL that verifies peers wants sessions labelled; a client would miss the label in the secret's.
    if (role == Role::Server)
        SSL_CTX_set_session_id_context(handle, reinterpret_cast<const unsigned char*>(sharedIdentity.data()),
                                       sharedIdentity.size());
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
    if (options.revokedFile.empty()) return;
    X509_STORE* trusted = SSL_CTX_get_cert_store(handle);
    X509_LOOKUP* lookup = X509_STORE_add_lookup(trusted, X509_LOOKUP_file());
    if (!lookup || X509_load_crl_file(lookup, options.revokedFile.c_str(), X509_FILETYPE_PEM) < 1 ||
        X509_STORE_set_flags(trusted, X509_V_FLAG_CRL_CHECK) != 1)
        unfit(options.revokedFile, "it is no revocation list of the CA (PEM): " + opensslReason());
}

Security::Security(const SecurityOptions& options, Role role) : impl_(std::make_unique<Impl>(role)) {
    const bool certificate = !options.certFile.empty(), key = !options.keyFile.empty(), ca = !options.caFile.empty();
    if (!options.pskFile.empty() && (certificate || key || ca))
        throw Error(ErrorCode::Usage, "Give either a secret (--psk-file) or certificates (--tls-cert), not both.");
    if (certificate != key || certificate != ca)
        throw Error(ErrorCode::Usage, "--tls-cert, --tls-key and --tls-ca belong together: give all three.");
    if (!options.revokedFile.empty() && !options.any())
        throw Error(ErrorCode::Usage, "--revoked needs --psk-file or certificates: others are not known by name.");
    if (!options.pskFile.empty()) impl_->useSecret(options);
    if (certificate) impl_->useCertificates(options);
}

Security::~Security() = default;

std::string readSecretFile(const std::string& path) {
    const SecretBytes content = readSecret(path);
    requireStrong(path, content.bytes);
    return content.bytes;
}

std::string makeClientSecret(const std::string& pskFile, const std::string& name) {
    if (!isName(name))
        throw Error(ErrorCode::Usage, "--client-secret takes a name of at most 64 letters, digits, dots and hyphens.");
    const SecretBytes content = readSecret(pskFile);
    if (content.bytes.starts_with(clientSecretMark))
        unfit(pskFile, "it is a client's secret already; others are made of the servers'");
    const Key key = clientKey(sharedKey(pskFile, content.bytes), std::string(clientIdentity) + name);
    return std::string(clientSecretMark) + name + " " +
           hexadecimal({reinterpret_cast<const char*>(key.data()), key.size()});
}

bool Security::encrypted() const { return impl_->context.has_value(); }

}  // namespace antipode::wire
