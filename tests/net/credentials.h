// Secrets and certificates in a folder of their own, right and wrong ones.
#pragma once

#include <fstream>
#include <string>

#include <sys/stat.h>

#include "proto/wire/stream.h"
#include "tests/film/temporary_folder.h"
#include "tests/net/certificates.h"

namespace antipode::test {

class Credentials {
public:
    /// A private file.
    std::string write(const std::string& name, const std::string& content) const {
        const std::string path = folder.file(name);
        std::ofstream(path, std::ios::binary) << content;
        ::chmod(path.c_str(), 0600);
        return path;
    }
    wire::SecurityOptions secret(const std::string& content) const {
        wire::SecurityOptions options;
        options.pskFile = write("secret" + std::to_string(++made_), content);
        return options;
    }
    /// A certificate of `issuer` for a peer that trusts `trusted`.
    wire::SecurityOptions certificate(const CertificateOptions& options, const CertificateAuthority& issuer,
                                      const CertificateAuthority& trusted) const {
        const std::string path = folder.file("certificate" + std::to_string(++made_));
        issuer.issue(path, options);
        return {"", path + ".pem", path + ".key", trusted.file()};
    }
    wire::SecurityOptions server() const { return certificate({"IP:127.0.0.1"}, ca, ca); }
    wire::SecurityOptions client() const { return certificate({"", "clientAuth"}, ca, ca); }

    const TemporaryFolder folder;
    const CertificateAuthority ca{folder.file(""), "ca"}, otherCa{folder.file(""), "other"};

private:
    mutable int made_ = 0;
};

/// Kept by all tests: every start of a test has its own process and with it its own keys.
inline const Credentials& credentials() {
    static const Credentials instance;
    return instance;
}

}  // namespace antipode::test
