// Processes that tests start, signal and await.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace antipode::test {

/// A child whose output goes to files. Killed when the object goes.
class Process {
public:
    /// `folder`: working directory; `log`: file that takes both outputs.
    Process(const std::vector<std::string>& command, const std::string& folder, const std::string& log);
    ~Process();
    Process(Process&& other) noexcept;
    Process& operator=(Process&&) = delete;

    void signal(int number) const;
    /// The exit code, or −signal; nothing where it still runs after `seconds`.
    std::optional<int> wait(double seconds);
    bool running();
    std::string output() const;
    /// Whether the output holds the text, or does within `seconds`.
    bool says(const std::string& text, double seconds) const;
    pid_t pid() const { return pid_; }
    /// User and system time so far, of a process that runs.
    double cpuSeconds() const;

private:
    pid_t pid_ = -1;
    std::optional<int> exit_;
    std::string log_;
};

/// A server process on a loopback port of the system's choice.
class ServerProcess {
public:
    /// `program` and what comes before the server's options; `options` after "--listen 127.0.0.1:PORT --cache …".
    ServerProcess(const std::vector<std::string>& program, const std::string& folder, const std::string& name,
                  const std::vector<std::string>& options = {}, int port = 0);

    /// Waits until it listens. Throws std::runtime_error where it does not within ten seconds.
    int port();
    std::string address() { return "127.0.0.1:" + std::to_string(port()); }
    Process& process() { return process_; }

private:
    Process process_;
    int port_;
};

}  // namespace antipode::test
