// What every fuzz target begins with.
#pragma once

#include <google/protobuf/stubs/logging.h>

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    // Protobuf logs every string that is no UTF-8.
    google::protobuf::SetLogHandler(nullptr);
    return 0;
}
