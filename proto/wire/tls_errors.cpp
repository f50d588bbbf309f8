#include "proto/wire/tls_errors.h"

#include <asio/ssl/error.hpp>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509_vfy.h>

#include "proto/wire/security.h"

namespace antipode::wire {
namespace {

/// Of alerts that peers send, as OpenSSL numbers them.
constexpr int firstAlert = SSL_AD_REASON_OFFSET, lastAlert = SSL_AD_REASON_OFFSET + 255;

std::string sentenceFor(int reason, const SSL* ssl, const Security::Impl& security, const std::string& peerName) {
    const std::string peer = security.role == Security::Role::Client ? "the server" : "the client";
    const std::string ours = security.bySecret ? "secret" : "certificate";
    switch (reason) {
        case SSL_R_CERTIFICATE_VERIFY_FAILED:
            if (security.bySecret) return peer + " shows a certificate, but a secret is expected";
            return peer + "'s certificate is not accepted" + (peerName.empty() ? "" : " for '" + peerName + "'") +
                   " (" + X509_verify_cert_error_string(SSL_get_verify_result(ssl)) + ")";
        case SSL_R_PEER_DID_NOT_RETURN_A_CERTIFICATE: return peer + " shows no certificate";
        case SSL_R_BINDER_DOES_NOT_VERIFY: return peer + " has another secret";
        case SSL_R_NO_SUITABLE_SIGNATURE_ALGORITHM:
        case SSL_R_NO_SHARED_CIPHER:
            return peer + (security.bySecret ? " does not know the secret" : " does not work with our certificate");
        case SSL_R_WRONG_VERSION_NUMBER:
        case SSL_R_HTTP_REQUEST:
        case SSL_R_HTTPS_PROXY_REQUEST:
        case SSL_R_PACKET_LENGTH_TOO_LONG:
            return peer + " does not speak TLS; it needs the same security options as this side";
        case SSL_R_UNSUPPORTED_PROTOCOL:
        case SSL_R_TLSV1_ALERT_PROTOCOL_VERSION: return peer + " does not speak TLS 1.3";
        default: break;
    }
    if (reason >= firstAlert && reason <= lastAlert) return peer + " does not accept our " + ours;
    return "TLS with " + peer + " failed";
}

}  // namespace

asio::system_error explain(const asio::error_code& code, const SSL* ssl, const Security& security,
                           const std::string& peerName) {
    if (code.category() != asio::error::get_ssl_category()) return asio::system_error(code);
    const int reason = ERR_GET_REASON(static_cast<unsigned>(code.value()));
    return asio::system_error(code, sentenceFor(reason, ssl, security.impl(), peerName));
}

}  // namespace antipode::wire
