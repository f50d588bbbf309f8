#include "renderengine/sha256.h"

#include <bit>
#include <stdexcept>

#include <openssl/evp.h>

namespace antipode {
namespace {

static_assert(std::endian::native == std::endian::little, "values are hashed as they lie in memory");

void require(bool succeeded) {
    if (!succeeded) throw std::runtime_error("OpenSSL refuses to compute a SHA-256 digest.");
}

}  // namespace

struct Sha256::Context {
    Context() { require(state && EVP_DigestInit_ex(state, EVP_sha256(), nullptr) == 1); }
    ~Context() { EVP_MD_CTX_free(state); }
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    EVP_MD_CTX* state = EVP_MD_CTX_new();
};

Sha256::Sha256() : context_(std::make_unique<Context>()) {}
Sha256::~Sha256() = default;
Sha256::Sha256(Sha256&&) noexcept = default;
Sha256& Sha256::operator=(Sha256&&) noexcept = default;

void Sha256::add(std::string_view bytes) {
    require(EVP_DigestUpdate(context_->state, bytes.data(), bytes.size()) == 1);
}

std::string Sha256::finish() {
    std::string digest(32, '\0');
    require(EVP_DigestFinal_ex(context_->state, reinterpret_cast<unsigned char*>(digest.data()), nullptr) == 1);
    return digest;
}

std::string sha256Of(std::string_view bytes) {
    Sha256 digest;
    digest.add(bytes);
    return digest.finish();
}

}  // namespace antipode
