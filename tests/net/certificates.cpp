#include "tests/net/certificates.h"

#include <cstdio>
#include <memory>
#include <stdexcept>

#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>
#include <sys/stat.h>

namespace antipode::test {
namespace {

void require(bool fine, const char* what) {
    if (!fine) throw std::runtime_error(std::string("OpenSSL: ") + what);
}

struct FileCloser {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, FileCloser>;

void writeCertificate(const std::string& path, X509* certificate) {
    const File file(std::fopen(path.c_str(), "w"));
    require(file && PEM_write_X509(file.get(), certificate) == 1, "write certificate");
}

void extend(X509* certificate, X509* issuer, int kind, const std::string& value) {
    X509V3_CTX context;
    X509V3_set_ctx(&context, issuer, certificate, nullptr, nullptr, 0);
    X509_EXTENSION* extension = X509V3_EXT_conf_nid(nullptr, &context, kind, value.c_str());
    require(extension && X509_add_ext(certificate, extension, -1) == 1, "extension");
    X509_EXTENSION_free(extension);
}

/// With neither issuer nor signature.
X509* blankCertificate(EVP_PKEY* key, const std::string& name, long secondsFromNow) {
    X509* certificate = X509_new();
    require(certificate != nullptr, "certificate");
    X509_set_version(certificate, X509_VERSION_3);
    long serial = 0;
    require(RAND_bytes(reinterpret_cast<unsigned char*>(&serial), 4) == 1, "serial number");
    ASN1_INTEGER_set(X509_get_serialNumber(certificate), serial);
    X509_gmtime_adj(X509_getm_notBefore(certificate), -7200);
    X509_gmtime_adj(X509_getm_notAfter(certificate), secondsFromNow);
    X509_NAME_add_entry_by_txt(X509_get_subject_name(certificate), "CN", MBSTRING_UTF8,
                               reinterpret_cast<const unsigned char*>(name.c_str()), -1, -1, 0);
    X509_set_pubkey(certificate, key);
    return certificate;
}

}  // namespace

CertificateAuthority::CertificateAuthority(const std::string& folder, const std::string& name)
    : file_(folder + "/" + name + ".pem"), key_(EVP_EC_gen("P-256")), certificate_(blankCertificate(key_, name, 3600)) {
    X509_set_issuer_name(certificate_, X509_get_subject_name(certificate_));
    extend(certificate_, certificate_, NID_basic_constraints, "critical,CA:TRUE");
    extend(certificate_, certificate_, NID_key_usage, "critical,keyCertSign");
    require(X509_sign(certificate_, key_, EVP_sha256()) > 0, "sign");
    writeCertificate(file_, certificate_);
}

CertificateAuthority::~CertificateAuthority() {
    X509_free(certificate_);
    EVP_PKEY_free(key_);
}

void CertificateAuthority::issue(const std::string& path, const CertificateOptions& options) const {
    EVP_PKEY* key = EVP_EC_gen("P-256");
    require(key != nullptr, "key");
    X509* certificate = blankCertificate(key, "test", options.secondsFromNow);
    X509_set_issuer_name(certificate, X509_get_subject_name(certificate_));
    extend(certificate, certificate_, NID_ext_key_usage, options.usage);
    if (!options.alternativeName.empty())
        extend(certificate, certificate_, NID_subject_alt_name, options.alternativeName);
    require(X509_sign(certificate, key_, EVP_sha256()) > 0, "sign");
    writeCertificate(path + ".pem", certificate);
    {
        const File file(std::fopen((path + ".key").c_str(), "w"));
        require(file && ::chmod((path + ".key").c_str(), 0600) == 0 &&
                    PEM_write_PrivateKey(file.get(), key, nullptr, nullptr, 0, nullptr, nullptr) == 1,
                "write key");
    }
    X509_free(certificate);
    EVP_PKEY_free(key);
}

}  // namespace antipode::test
