// A chunk of film sums from a peer. The first two bytes of an input are the number of values that it should decode to.
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

#include "proto/wire/block_codec.h"
#include "proto/wire/frame.h"
#include "tests/fuzz/quiet.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace antipode::wire;
    if (size < 2) return 0;
    uint16_t count = 0;
    std::memcpy(&count, data, sizeof count);
    data += sizeof count, size -= sizeof count;
    try {
        std::vector<int64_t> values(count), again(count);
        decodeChunk({reinterpret_cast<const char*>(data), size}, values);
        decodeChunk(encodeChunk(values), again);
        require(again == values, "values that were decoded survive");
    } catch (const ProtocolError&) {
    }
    std::vector<int64_t> values(size / sizeof(int64_t)), again(values.size());
    if (values.empty()) return 0;
    std::memcpy(values.data(), data, values.size() * sizeof(int64_t));
    decodeChunk(encodeChunk(values), again);
    require(again == values, "any values survive");
    return 0;
}
