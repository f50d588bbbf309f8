#include "terminal/program.h"

#include <iostream>
#include <new>

#include "renderengine/error.h"

namespace antipode {

int runProgram(const std::string& name, const std::function<void()>& work) {
    const auto complain = [&](const std::string& message, int exitCode) {
        std::cerr << name << ": " << message << std::endl;
        return exitCode;
    };
    try {
        work();
        return 0;
    } catch (const Error& error) {
        return complain(error.what(), error.code() == ErrorCode::Usage ? 2 : 1);
    } catch (const std::bad_alloc&) {
        return complain("There is not enough memory for this.", 1);
    } catch (const std::exception& error) {
        return complain(std::string("Internal error: ") + error.what(), 1);
    }
}

}  // namespace antipode
