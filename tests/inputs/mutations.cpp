#include "tests/inputs/mutations.h"

#include <fstream>
#include <iterator>

#include "tests/support/random.h"

namespace antipode::test {

Bytes readBytes(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return Bytes(std::istreambuf_iterator<char>(file), {});
}

Bytes withFlippedBits(const Bytes& source, uint64_t seed) {
    Random random(seed);
    Bytes flipped = source;
    for (uint32_t left = 1 + random.index(3); left > 0; --left)
        flipped[random.index(uint32_t(flipped.size()))] ^= uint8_t(1u << random.index(8));
    return flipped;
}

}  // namespace antipode::test
