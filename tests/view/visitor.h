// Whoever connects to a view's server, byte by byte.
#pragma once

#include <cstdint>
#include <string>

namespace antipode::test {

class Visitor {
public:
    explicit Visitor(uint16_t port);
    ~Visitor();
    Visitor(const Visitor&) = delete;
    Visitor& operator=(const Visitor&) = delete;

    /// Never waits for a server that does not read; false where it has gone.
    bool send(const std::string& bytes);
    /// What has come by the time that it holds `text`, or after so many seconds, or when the server has gone.
    std::string until(const std::string& text, double seconds = 30);
    /// Whether the server ends the connection within so many seconds.
    bool ended(double seconds = 30);

private:
    /// False at the end, or where nothing comes in that time.
    bool receive(double seconds);

    int socket_;
    bool over_ = false;
    std::string received_;
};

/// The whole answer to a request with these further header lines, each ended by CRLF; the connection is closed after
/// it.
std::string answerTo(uint16_t port, const std::string& line, const std::string& headers = "");

}  // namespace antipode::test
