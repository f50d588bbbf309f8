// Certificates for tests, also such as no script would make.
#pragma once

#include <string>

#include <openssl/types.h>

namespace antipode::test {

/// What a certificate says; every value can be wrong on purpose.
struct CertificateOptions {
    std::string alternativeName;       ///< "DNS:localhost", "IP:127.0.0.1"
    std::string usage = "serverAuth";  ///< extendedKeyUsage
    long secondsFromNow = 3600;        ///< end of validity; it began two hours ago
};

/// A CA that writes PEM files into a folder.
class CertificateAuthority {
public:
    /// Writes NAME.pem.
    CertificateAuthority(const std::string& folder, const std::string& name);
    ~CertificateAuthority();
    CertificateAuthority(const CertificateAuthority&) = delete;
    CertificateAuthority& operator=(const CertificateAuthority&) = delete;

    const std::string& file() const { return file_; }
    /// Writes PATH.pem and PATH.key.
    void issue(const std::string& path, const CertificateOptions& options) const;

private:
    std::string file_;
    EVP_PKEY* key_;
    X509* certificate_;
};

}  // namespace antipode::test
