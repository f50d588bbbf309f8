// Merging, normalising and hashing of fixed-point sums.
#include <cmath>
#include <memory>

#include <openssl/evp.h>

#include "renderengine/error.h"
#include "renderengine/film.h"

namespace antipode {
namespace {

std::string describe(const FilmSums& sums) {
    return std::to_string(sums.width) + "x" + std::to_string(sums.height) + " at scale 2^" +
           std::to_string(sums.scaleExponent) + " with " + std::to_string(sums.rgb.size()) + " sums";
}

size_t sumCount(const FilmSums& sums) { return size_t(sums.width) * sums.height * 3; }

/// Streams integers into SHA-256, least significant byte first on every machine.
class LittleEndianSha256 {
public:
    LittleEndianSha256() : context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
        require(context_ && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1);
        buffer_.reserve(bufferBytes);
    }

    template <class T>
    void add(T value) {
        if (buffer_.size() + sizeof(T) > bufferBytes) flush();
        for (size_t i = 0; i < sizeof(T); ++i) buffer_.push_back(uint8_t(value >> (8 * i)));
    }

    std::string hexadecimal() {
        flush();
        unsigned char digest[EVP_MAX_MD_SIZE];
        unsigned length = 0;
        require(EVP_DigestFinal_ex(context_.get(), digest, &length) == 1);
        static const char digits[] = "0123456789abcdef";
        std::string text;
        for (unsigned i = 0; i < length; ++i) {
            text += digits[digest[i] >> 4];
            text += digits[digest[i] & 15];
        }
        return text;
    }

private:
    static constexpr size_t bufferBytes = 1 << 16;

    static void require(bool succeeded) {
        if (!succeeded) throw std::runtime_error("OpenSSL refused to compute a SHA-256 digest.");
    }
    void flush() {
        require(EVP_DigestUpdate(context_.get(), buffer_.data(), buffer_.size()) == 1);
        buffer_.clear();
    }

    std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
    std::vector<uint8_t> buffer_;
};

}  // namespace

FilmCounters& FilmCounters::operator+=(const FilmCounters& o) {
    nonFinite += o.nonFinite;
    negative += o.negative;
    saturated += o.saturated;
    loopLimit += o.loopLimit;
    return *this;
}

void FilmSums::merge(const FilmSums& other) {
    if (width != other.width || height != other.height || scaleExponent != other.scaleExponent ||
        rgb.size() != other.rgb.size())
        throw Error(ErrorCode::Usage,
                    "Film sums of " + describe(other) + " cannot be merged into " + describe(*this) + ".");
    for (size_t i = 0; i < rgb.size(); ++i) {
        int64_t sum;
        if (__builtin_add_overflow(rgb[i], other.rgb[i], &sum))
            throw Error(ErrorCode::Usage, "Merging would overflow the 64-bit film sum of pixel " +
                                              std::to_string(i / 3 % width) + "," + std::to_string(i / 3 / width) +
                                              "; render fewer iterations into one image.");
    }
    for (size_t i = 0; i < rgb.size(); ++i) rgb[i] += other.rgb[i];
    iterations += other.iterations;
    counters += other.counters;
}

Image FilmSums::image() const {
    if (iterations == 0) throw Error(ErrorCode::Usage, "A film without iterations has no image.");
    if (rgb.size() != sumCount(*this))
        throw Error(ErrorCode::Usage, "A film of " + describe(*this) + " is inconsistent.");
    Image image{width, height, std::vector<Vec3f>(size_t(width) * height)};
    const auto mean = [&](size_t i) { return float(std::ldexp(double(rgb[i]) / double(iterations), -scaleExponent)); };
    for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = {mean(3 * i), mean(3 * i + 1), mean(3 * i + 2)};
    return image;
}

std::string FilmSums::sha256() const {
    LittleEndianSha256 digest;
    digest.add(width);
    digest.add(height);
    digest.add(uint32_t(scaleExponent));
    digest.add(iterations);
    for (const int64_t sum : rgb) digest.add(uint64_t(sum));
    return digest.hexadecimal();
}

}  // namespace antipode
