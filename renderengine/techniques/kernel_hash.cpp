#include "renderengine/sha256.h"
#include "kernels/embedded.h"
#include "renderengine/engine.h"
#include "renderengine/io/text.h"

namespace antipode {
namespace {

/// Names and code with their lengths, in the order of the build.
std::string hashKernels() {
    Sha256 digest;
    for (const kernels::Kernel& kernel : kernels::all()) {
        digest.addValue(uint32_t(kernel.name.size()));
        digest.add(kernel.name);
        digest.addValue(uint32_t(kernel.spirv.size()));
        digest.addValues(kernel.spirv);
    }
    return hexadecimal(digest.finish());
}

}  // namespace

std::string kernelHash() {
    static const std::string hash = hashKernels();
    return hash;
}

}  // namespace antipode
