// Who may use a server, and what strangers can do to it: nothing.
#include <algorithm>
#include <arpa/inet.h>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <deque>
#include <filesystem>
#include <fstream>
#include <sys/resource.h>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

#include "tests/farm/processes/farm_fixture.h"

using namespace antipode::test;

namespace {

using Arguments = std::vector<std::string>;

class FarmStrangers : public FarmProcesses {
protected:
    void writeSecret(const std::string& name, const std::string& secret) {
        std::ofstream(folder.file(name)) << secret << "\n";
        std::filesystem::permissions(folder.file(name),
                                     std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    }
    static double seconds() {
        return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    }
    /// From an address of loopback.
    static int connectTo(int port, const char* from = "127.0.0.1") {
        const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
        sockaddr_in source{};
        source.sin_family = AF_INET;
        ::inet_pton(AF_INET, from, &source.sin_addr);
        ::bind(socket, reinterpret_cast<sockaddr*>(&source), sizeof source);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(uint16_t(port));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        if (::connect(socket, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0) return socket;
        ::close(socket);
        return -1;
    }
    /// A port that nobody listens on, for now.
    static int freePort() {
        const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address;
        ::bind(socket, reinterpret_cast<sockaddr*>(&address), size);
        ::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
        ::close(socket);
        return ntohs(address.sin_port);
    }
    std::string get(int port, const std::string& path) {
        const int socket = connectTo(port);
        const std::string request = "GET " + path + " HTTP/1.0\r\n\r\n";
        if (::send(socket, request.data(), request.size(), 0) < 0) return "";
        std::string answer;
        char buffer[4096];
        for (ssize_t n; (n = ::recv(socket, buffer, sizeof buffer, 0)) > 0;) answer.append(buffer, size_t(n));
        ::close(socket);
        return answer;
    }
};

const Arguments smallJob{"--iterations", "20"};

}  // namespace

TEST_F(FarmStrangers, WithoutSecretOnlyLoopback) {
    Process server({ANTIPODE_SERVER, "--listen", "0.0.0.0:0", "--cache", folder.file("cache")}, folder.file("."),
                   folder.file("server.log"));
    EXPECT_EQ(server.wait(10), 2) << server.output();
    EXPECT_TRUE(server.says("--listen", 0) && server.says("--psk-file", 0)) << server.output();
    Process render = client("farm", smallJob + Arguments{"--server", "192.0.2.1:7010"});
    EXPECT_EQ(render.wait(10), 2) << render.output();
    EXPECT_TRUE(render.says("--psk-file", 0)) << render.output();
}

TEST_F(FarmStrangers, ASharedSecretLetsInWhoHasIt) {
    writeSecret("right", "correct horse battery staple");
    writeSecret("wrong", "incorrect horse battery staple");
    ServerProcess server = countingServer("server", 0.01, "honest", {"--psk-file", folder.file("right")});
    const Arguments target{"--server", server.address()};
    Process wrong = client("wrong", smallJob + target + Arguments{"--psk-file", "wrong"});
    Process none = client("none", smallJob + target);
    EXPECT_TRUE(wrong.says(server.address(), 8)) << wrong.output();
    EXPECT_TRUE(none.says(server.address(), 8)) << none.output();
    Process right = client("right", smallJob + target + Arguments{"--psk-file", "right"});
    EXPECT_EQ(hashOf("right", right), countedHash(20));
    // Waiting would not help them: they end with the reason.
    EXPECT_EQ(wrong.wait(15), 1) << wrong.output();
    EXPECT_TRUE(wrong.says("refuses: the server", 0) && wrong.says("secret", 0)) << wrong.output();
    EXPECT_EQ(none.wait(15), 1) << none.output();
    EXPECT_TRUE(none.says("This server takes TLS alone: give --psk-file", 0)) << none.output();
    EXPECT_FALSE(std::ifstream(folder.file("wrong.exr")) || std::ifstream(folder.file("none.exr")));
    EXPECT_FALSE(server.process().says("horse", 0)) << "a secret is in the log";
}

TEST_F(FarmStrangers, AHangUpReadsTheSecretAgainOrDrains) {
    writeSecret("secret", "correct horse battery staple");
    ServerProcess server = countingServer("server", 0.01, "honest", {"--psk-file", folder.file("secret")});
    const Arguments target{"--server", server.address(), "--psk-file", "secret"};
    Process before = client("before", smallJob + target);
    EXPECT_EQ(hashOf("before", before), countedHash(20));
    writeSecret("secret", "too weak");
    server.process().signal(SIGHUP);
    EXPECT_TRUE(server.process().says("stay as they were", 5)) << server.process().output();
    writeSecret("secret", "another horse and another staple");
    server.process().signal(SIGHUP);
    ASSERT_TRUE(server.process().says("have been read again", 5)) << server.process().output();
    Process after = client("after", smallJob + target);
    EXPECT_EQ(hashOf("after", after), countedHash(20));
    server.process().signal(SIGTERM);
    EXPECT_EQ(server.process().wait(10), 0);
    ServerProcess plain = countingServer("plain");
    ASSERT_GT(plain.port(), 0);
    plain.process().signal(SIGHUP);
    EXPECT_EQ(plain.process().wait(10), 0) << "without credentials it drains";
}

TEST_F(FarmStrangers, AServerWithoutTlsIsNotWaitedForWithASecret) {
    writeSecret("secret", "correct horse battery staple");
    ServerProcess server = countingServer("server");
    Process render = client("farm", smallJob + Arguments{"--server", server.address(), "--psk-file", "secret"});
    EXPECT_EQ(render.wait(20), 1) << render.output();
    EXPECT_TRUE(render.says("does not speak TLS", 0)) << render.output();
}

TEST_F(FarmStrangers, AWrongSecretBesideAServerThatWorksEndsNothing) {
    writeSecret("right", "correct horse battery staple");
    writeSecret("wrong", "incorrect horse battery staple");
    ServerProcess ours = countingServer("ours", 0.02, "honest", {"--psk-file", folder.file("right")});
    ServerProcess theirs = countingServer("theirs", 0.02, "honest", {"--psk-file", folder.file("wrong")});
    Process render = client("farm", Arguments{"--iterations", "300", "--server", theirs.address(), "--server",
                                              ours.address(), "--psk-file", "right"});
    EXPECT_EQ(hashOf("farm", render), countedHash(300));
    EXPECT_TRUE(render.says(theirs.address() + " refuses", 0)) << render.output();
}

TEST_F(FarmStrangers, CertificatesOfMakeCertsLetInWhoHasOne) {
    const std::string certs = folder.file("certs"), strangers = folder.file("strangers");
    for (const std::string& target : {certs, strangers}) {
        Process make({ANTIPODE_SOURCE_DIR "/deploy/make-certs", target, "127.0.0.1"}, folder.file("."),
                     folder.file("make.log"));
        ASSERT_EQ(make.wait(30), 0) << make.output();
    }
    const auto identity = [](const std::string& from, const std::string& name) {
        return Arguments{"--tls-cert", from + "/" + name + ".pem",
                         "--tls-key",  from + "/" + name + ".key",
                         "--tls-ca",   from + "/ca.pem"};
    };
    ServerProcess server = countingServer("server", 0.01, "honest", identity(certs, "server-127.0.0.1"));
    const Arguments target{"--server", server.address()};
    Process stranger = client("stranger", smallJob + target + identity(strangers, "client"));
    EXPECT_EQ(stranger.wait(15), 1) << stranger.output();
    EXPECT_TRUE(stranger.says(server.address() + " refuses", 0)) << stranger.output();
    Process friendly = client("friendly", smallJob + target + identity(certs, "client"));
    EXPECT_EQ(hashOf("friendly", friendly), countedHash(20));
}

TEST_F(FarmStrangers, AThousandSilentConnectionsKeepNobodyOut) {
    rlimit limit{};
    ::getrlimit(RLIMIT_NOFILE, &limit);
    limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, 4096);
    ::setrlimit(RLIMIT_NOFILE, &limit);
    ServerProcess server = countingServer("server", 0.0);
    // The first run leaves the scene in the server's cache.
    Process before = client("before", Arguments{"--iterations", "1", "--server", server.address()});
    hashOf("before", before);
    std::vector<int> silent;
    std::atomic<bool> stop = false;
    std::thread flood([&] {
        for (int i = 0; i < 1000; ++i) silent.push_back(connectTo(server.port()));
        while (!stop) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    const double start = seconds();
    Process render = client("farm", Arguments{"--iterations", "1", "--server", server.address()});
    EXPECT_EQ(hashOf("farm", render), countedHash(1));
    EXPECT_LT(stats("farm")["setup_seconds"].get<double>(), 1.0);
    EXPECT_LT(seconds() - start, 5.0);
    stop = true;
    flood.join();
    EXPECT_EQ(silent.size(), 1000u);
    for (const int socket : silent)
        if (socket >= 0) ::close(socket);
}

/// A flood from one address (2,762 a second shut distant clients out, when the oldest stranger of all went), each of
/// which stays; beside it a client from another, whose network takes a third of a second each way.
TEST_F(FarmStrangers, AFloodFromOneAddressShutsNobodyElseOut) {
    ServerProcess server = countingServer("server", 0.0);
    Process before = client("before", Arguments{"--iterations", "1", "--server", server.address()});
    hashOf("before", before);
    std::atomic<bool> stop = false;
    std::atomic<int> made = 0;
    const int port = server.port();
    std::thread flood([&] {
        std::deque<int> silent;
        while (!stop) {
            silent.push_back(connectTo(port, "127.0.0.66"));
            ++made;
            if (silent.size() > 500) {
                ::close(silent.front());
                silent.pop_front();
            }
        }
        for (const int socket : silent) ::close(socket);
    });
    const int distant = connectTo(port);
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    char byte = 0;
    const bool open = ::recv(distant, &byte, 1, MSG_DONTWAIT) == -1 && errno == EAGAIN;
    EXPECT_TRUE(open) << "the distant client was shut out before it could say Hello";
    ::close(distant);
    Process render = client("farm", Arguments{"--iterations", "1", "--server", server.address()});
    EXPECT_EQ(hashOf("farm", render), countedHash(1));
    stop = true;
    flood.join();
    EXPECT_GT(made, 1000);
    const std::string log = server.process().output();
    EXPECT_LT(std::ranges::count(log, '\n'), 100) << "strangers fill the log";
}

TEST_F(FarmStrangers, MetricsAnswerBesideSilentConnections) {
    const int port = freePort();
    ServerProcess server = countingServer("server", 0.0, "honest", {"--metrics", std::to_string(port)});
    const auto answers = [&] { return get(port, "/metrics").find("antipode_server_jobs") != std::string::npos; };
    ASSERT_GT(server.port(), 0);
    for (int i = 0; i < 50 && !answers(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    const int silent[] = {connectTo(port), connectTo(port)};
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    const double start = seconds();
    EXPECT_TRUE(answers());
    EXPECT_LT(seconds() - start, 1.5);
    for (const int socket : silent) ::close(socket);
}

TEST_F(FarmStrangers, GarbageDoesNotHurt) {
    ServerProcess server = countingServer("server");
    for (const std::string& bytes :
         {std::string(100000, '\0'), std::string(100000, '\xff'), std::string("GET / HTTP/1.1\r\n\r\n"),
          std::string("APF1\1\0\1\0\xff\xff\xff\xff\xff\xff\xff\xff", 16)}) {
        const int socket = connectTo(server.port());
        ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        ::close(socket);
    }
    Process render = client("farm", smallJob + Arguments{"--server", server.address()});
    EXPECT_EQ(hashOf("farm", render), countedHash(20));
}

TEST_F(FarmStrangers, OtherKernelsAreRefusedInASentence) {
    ServerProcess server({ANTIPODE_COUNTING_SERVER, "0.01", "honest", std::string(64, 'a')}, folder.file("."),
                         "server");
    Process render = client("farm", smallJob + Arguments{"--server", server.address()});
    EXPECT_EQ(render.wait(10), 1) << render.output();
    EXPECT_TRUE(render.says("kernels", 0)) << render.output();
    EXPECT_FALSE(std::ifstream(folder.file("farm.exr")));
}

TEST_F(FarmStrangers, TooLargeAnImageIsRefusedWithTheReason) {
    ServerProcess server = countingServer("server", 0.01, "honest", {"--max-pixels", "100"});
    Process render = client("farm", smallJob + Arguments{"--server", server.address()});
    EXPECT_EQ(render.wait(10), 1) << render.output();
    EXPECT_TRUE(render.says("pixels", 0)) << render.output();
}

TEST_F(FarmStrangers, MetricsAndPreviewAreThereWhileItRenders) {
    const int ofServerPort = freePort(), ofClientPort = freePort();
    ServerProcess server =
        countingServer("server", 0.02, "honest", {"--metrics", "127.0.0.1:" + std::to_string(ofServerPort)});
    Process render = client("farm", Arguments{"--iterations", "100000", "--server", server.address(), "--metrics",
                                              "127.0.0.1:" + std::to_string(ofClientPort), "--preview", "0.2"});
    const std::string png = folder.file("farm.png");
    for (int i = 0; i < 1000 && !std::filesystem::exists(png); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ASSERT_TRUE(std::filesystem::exists(png)) << render.output();
    const auto first = std::filesystem::last_write_time(png);
    for (int i = 0; i < 300 && std::filesystem::last_write_time(png) == first; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_NE(std::filesystem::last_write_time(png), first) << "the preview is written once only";
    const std::string ofServer = get(ofServerPort, "/metrics"), ofClient = get(ofClientPort, "/metrics");
    EXPECT_NE(ofServer.find("antipode_server_iterations_total"), std::string::npos) << ofServer;
    EXPECT_NE(ofClient.find("antipode_node_iterations_total{node=\"" + server.address() + "\""), std::string::npos)
        << ofClient;
    render.signal(SIGINT);
    EXPECT_EQ(render.wait(10), 0) << render.output();
}
