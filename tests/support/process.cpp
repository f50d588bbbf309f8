#include "tests/support/process.h"

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace antipode::test {
namespace {

using Clock = std::chrono::steady_clock;

/// Whether `holds` becomes true within the time; looks every 10 ms.
template <class Condition>
bool within(double seconds, Condition holds) {
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    for (;;) {
        if (holds()) return true;
        if (Clock::now() >= end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
}

[[noreturn]] void become(const std::vector<std::string>& command, const std::string& folder, const std::string& log) {
    const int file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
    ::dup2(file, STDOUT_FILENO);
    ::dup2(file, STDERR_FILENO);
    std::vector<char*> arguments;
    for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    if (::chdir(folder.c_str()) == 0) ::execv(arguments[0], arguments.data());
    ::_exit(127);
}

std::vector<std::string> serverCommand(std::vector<std::string> command, const std::string& folder,
                                       const std::string& name, const std::vector<std::string>& options, int port) {
    command.insert(command.end(),
                   {"--listen", "127.0.0.1:" + std::to_string(port), "--cache", folder + "/cache-" + name});
    command.insert(command.end(), options.begin(), options.end());
    return command;
}

}  // namespace

Process::Process(const std::vector<std::string>& command, const std::string& folder, const std::string& log)
    : log_(log) {
    pid_ = ::fork();
    if (pid_ < 0) throw std::runtime_error("cannot start a process");
    if (pid_ == 0) become(command, folder, log);
}

Process::Process(Process&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)), exit_(other.exit_), log_(std::move(other.log_)) {}

Process::~Process() {
    if (pid_ < 0 || exit_) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
}

void Process::signal(int number) const { ::kill(pid_, number); }

std::optional<int> Process::wait(double seconds) {
    within(seconds, [this] { return !running(); });
    return exit_;
}

bool Process::running() {
    int status = 0;
    if (!exit_ && ::waitpid(pid_, &status, WNOHANG) == pid_)
        exit_ = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    return !exit_;
}

std::string Process::output() const {
    std::ifstream file(log_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

bool Process::says(const std::string& text, double seconds) const {
    return within(seconds, [&] { return output().find(text) != std::string::npos; });
}

double Process::cpuSeconds() const {
    std::ifstream file("/proc/" + std::to_string(pid_) + "/stat");
    std::string text((std::istreambuf_iterator<char>(file)), {});
    std::istringstream fields(text.substr(text.rfind(')') + 2));
    std::string skipped;
    double user = 0, system = 0;
    for (int i = 0; i < 11; ++i) fields >> skipped;
    fields >> user >> system;
    return (user + system) / double(::sysconf(_SC_CLK_TCK));
}

ServerProcess::ServerProcess(const std::vector<std::string>& program, const std::string& folder,
                             const std::string& name, const std::vector<std::string>& options, int port)
    : process_(serverCommand(program, folder, name, options, port), folder, folder + "/" + name + ".log"),
      port_(port) {}

int ServerProcess::port() {
    if (port_ != 0) return port_;
    const std::string mark = "listening on 127.0.0.1:";
    if (!process_.says(mark, 10)) throw std::runtime_error("the server does not listen: " + process_.output());
    const std::string text = process_.output();
    return port_ = std::stoi(text.substr(text.find(mark) + mark.size()));
}

}  // namespace antipode::test
