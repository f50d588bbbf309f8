// A checkpoint: refused with an Error, or the same after writing it again. An input is a file without its digest, which
// no mutation would ever get right.
#include <cstdint>
#include <string>

#include "farm/jobs/checkpoint.h"
#include "proto/wire/scene_package.h"
#include "renderengine/error.h"
#include "tests/fuzz/quiet.h"
#include "tests/fuzz/require.h"

namespace {

void tryCheckpoint(std::string bytes) {
    bytes += antipode::sha256Of(bytes);
    const antipode::Checkpoint checkpoint = antipode::decodeCheckpoint(bytes);
    require(checkpoint.committed.count() == checkpoint.sums.iterations, "sums are those of what is committed");
    const std::string again = antipode::encodeCheckpoint(checkpoint);
    require(antipode::encodeCheckpoint(antipode::decodeCheckpoint(again)) == again, "a valid checkpoint survives");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    try {
        tryCheckpoint({reinterpret_cast<const char*>(data), size});
    } catch (const antipode::Error&) {
    }
    return 0;
}
