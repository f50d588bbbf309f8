#include "scene/import_rehearsal.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <new>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "renderengine/error.h"
#include "renderengine/io/descriptor.h"

namespace antipode {
namespace {

/// Processor time that reading takes at most, in seconds: measured are 0.3 for a megabyte of the slowest format.
rlim_t allowance(const std::string& path) {
    std::error_code code;
    const auto size = std::filesystem::file_size(path, code);
    return 5 + (code ? 0 : rlim_t(size >> 18));
}

/// What `read` throws; empty where it returns.
std::string complaint(const std::function<void()>& read) {
    try {
        read();
        return {};
    } catch (const std::bad_alloc&) {
        return "it asks for more memory than there is";
    } catch (const std::exception& e) {
        return e.what();
    }
}

[[noreturn]] void runChild(const std::function<void()>& read, rlim_t seconds, int report) {
    for (int number : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGXCPU, SIGPIPE, SIGSEGV, SIGABRT}) ::signal(number, SIG_DFL);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    const rlimit none{0, 0}, time{seconds, seconds + 1};
    ::setrlimit(RLIMIT_CORE, &none);
    ::setrlimit(RLIMIT_CPU, &time);
    const int nowhere = ::open("/dev/null", O_WRONLY);
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
    const std::string text = complaint(read).substr(0, 1024);  // less than a pipe takes without a reader
    ::_exit(::write(report, text.data(), text.size()) == ssize_t(text.size()) ? 0 : 1);
}

std::string readAll(const Descriptor& file) {
    std::string text;
    std::array<char, 1024> buffer;
    for (;;) {
        const size_t count = readFully(file, buffer.data(), buffer.size()).value_or(0);
        text.append(buffer.data(), count);
        if (count < buffer.size()) return text;
    }
}

int waitFor(pid_t child) {
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

[[noreturn]] void fail(const std::string& why) { throw Error(ErrorCode::Input, why); }

}  // namespace

void rehearseImport(const std::string& path, const std::function<void()>& read) {
    const rlim_t seconds = allowance(path);
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) fail(std::string("no pipe for reading it: ") + std::strerror(errno));
    const Descriptor from(ends[0]);
    Descriptor to(ends[1]);
    const pid_t child = ::fork();
    if (child < 0) fail(std::string("no process for reading it: ") + std::strerror(errno));
    if (child == 0) runChild(read, seconds, to.get());
    to.close();
    const std::string complaint = readAll(from);
    const int status = waitFor(child);
    if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL))
        fail("reading it came to no end within " + std::to_string(seconds) +
             " s or took all memory; it is probably broken");
    if (status != 0) fail("the importer crashed on it; it is probably broken, or convert it to .glb");
    if (!complaint.empty()) fail(complaint);
}

}  // namespace antipode
