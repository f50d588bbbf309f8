#include "tests/view/visitor.h"

#include <chrono>
#include <stdexcept>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace antipode::test {
namespace {

double monotonicSeconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

Visitor::Visitor(uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
        throw std::runtime_error("Cannot connect to the view's server.");
}

Visitor::~Visitor() { ::close(socket_); }

bool Visitor::send(const std::string& bytes) {
    return ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT) == ssize_t(bytes.size());
}

bool Visitor::receive(double seconds) {
    pollfd ready{socket_, POLLIN, 0};
    if (over_ || ::poll(&ready, 1, int(1000 * seconds)) != 1) return false;
    char bytes[65536];
    const ssize_t size = ::recv(socket_, bytes, sizeof bytes, 0);
    over_ = size <= 0;
    if (!over_) received_.append(bytes, size_t(size));
    return !over_;
}

std::string Visitor::until(const std::string& text, double seconds) {
    const double end = monotonicSeconds() + seconds;
    while (received_.find(text) == std::string::npos && receive(end - monotonicSeconds())) continue;
    return received_;
}

bool Visitor::ended(double seconds) {
    const double end = monotonicSeconds() + seconds;
    while (receive(end - monotonicSeconds())) continue;
    return over_;
}

std::string answerTo(uint16_t port, const std::string& line, const std::string& headers) {
    Visitor visitor(port);
    visitor.send(line + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n" + headers + "\r\n");
    visitor.ended();
    return visitor.until("\r\n\r\n");
}

}  // namespace antipode::test
