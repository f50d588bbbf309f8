#include "terminal/program.h"

#include <iostream>
#include <new>

#include "renderengine/error.h"
#include "terminal/exit_codes.h"

namespace antipode {

void complain(const std::string& name, const std::string& message) {
    std::cerr << name << ": " << message << std::endl;
}

int runProgram(const std::function<void()>& work, const std::function<void(const std::string& message)>& tell) {
    const auto fail = [&](const std::string& message, ExitCode code) {
        tell(message);
        return int(code);
    };
    try {
        work();
        return exitDone;
    } catch (const Error& error) {
        return fail(error.what(), error.code() == ErrorCode::Usage ? exitUsage : exitFailed);
    } catch (const std::bad_alloc&) {
        return fail("There is not enough memory for this.", exitFailed);
    } catch (const std::exception& error) {
        return fail(std::string("Internal error: ") + error.what(), exitFailed);
    }
}

int runProgram(const std::string& name, const std::function<void()>& work) {
    return runProgram(work, [&](const std::string& message) { complain(name, message); });
}

}  // namespace antipode
