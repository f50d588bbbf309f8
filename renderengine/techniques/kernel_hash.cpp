#include <cstddef>
#include <stdexcept>

#include <openssl/evp.h>

#include "kernels/embedded.h"
#include "renderengine/engine.h"

namespace antipode {
namespace {

/// Names and code with their lengths, in the order of the build; words least significant byte first on every machine.
std::string serialisedKernels() {
    std::string bytes;
    const auto addWord = [&bytes](uint32_t word) {
        for (int shift = 0; shift < 32; shift += 8) bytes += char(word >> shift);
    };
    for (const kernels::Kernel& kernel : kernels::all()) {
        addWord(uint32_t(kernel.name.size()));
        bytes += kernel.name;
        addWord(uint32_t(kernel.spirv.size()));
        for (const uint32_t word : kernel.spirv) addWord(word);
    }
    return bytes;
}

std::string hashKernels() {
    const std::string bytes = serialisedKernels();
    unsigned char digest[EVP_MAX_MD_SIZE];
    unsigned length = 0;
    if (EVP_Digest(bytes.data(), bytes.size(), digest, &length, EVP_sha256(), nullptr) != 1)
        throw std::runtime_error("OpenSSL refused to compute a SHA-256 digest.");
    std::string text;
    for (unsigned i = 0; i < length; ++i) {
        constexpr char digits[] = "0123456789abcdef";
        text += digits[digest[i] >> 4];
        text += digits[digest[i] & 15];
    }
    return text;
}

}  // namespace

std::string kernelHash() {
    static const std::string hash = hashKernels();
    return hash;
}

}  // namespace antipode
