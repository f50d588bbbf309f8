// Loopback alone, port of the system's choice. No bound on time here is what is tested but for those of the server: 5 s
// for a request, which hostile visitors run into.
#include "client/view/view_server.h"

#include <chrono>
#include <deque>
#include <functional>
#include <thread>

#include <gtest/gtest.h>

#include "renderengine/error.h"
#include "tests/view/visitor.h"

using namespace antipode;
using namespace antipode::view;
using antipode::test::answerTo;
using antipode::test::Visitor;

namespace {

const std::string follow = "GET /events HTTP/1.1\r\nHost: localhost\r\n\r\n";
const std::string act = "Antipode-Action: yes\r\nContent-Length: 0\r\n";

Picture pictureOf(uint32_t width, uint32_t height, float value) {
    Picture picture;
    picture.iterations = 7;
    picture.image = {width, height, std::vector<Vec3f>(size_t(width) * height, Vec3f{value, value, value})};
    return picture;
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

double secondsOf(const std::function<void()>& call) {
    const auto start = std::chrono::steady_clock::now();
    call();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Waits for what the server's thread is about to do.
bool becomes(const std::function<bool()>& condition) {
    for (int i = 0; i < 3000 && !condition(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return condition();
}

}  // namespace

TEST(ViewServer, ServesThePageWithoutLettingOthersFrameOrScriptIt) {
    const ViewServer server({"127.0.0.1", "0", ""});
    const std::string answer = answerTo(server.port(), "GET /");
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 200 OK"));
    EXPECT_TRUE(contains(answer, "<!doctype html>"));
    EXPECT_TRUE(contains(answer, "</html>"));
    EXPECT_TRUE(contains(answer, "frame-ancestors 'none'"));
    EXPECT_FALSE(contains(answer, "Access-Control-Allow-Origin"));
    EXPECT_FALSE(contains(answer, "src=\"http"));
    EXPECT_TRUE(answerTo(server.port(), "GET /other").starts_with("HTTP/1.1 404"));
}

TEST(ViewServer, StreamsTheLatestStateAndTellsOfPictures) {
    ViewServer server({"127.0.0.1", "0", ""});
    EXPECT_FALSE(server.watched());
    EXPECT_FALSE(server.wantsPicture()) << "nobody looks";
    server.publishState(R"({"n":1})");
    Visitor page(server.port());
    page.send(follow);
    EXPECT_TRUE(contains(page.until("{\"n\":1}\n"), "application/x-ndjson"));
    EXPECT_TRUE(server.watched());
    EXPECT_TRUE(server.wantsPicture());
    server.publishPicture(pictureOf(2, 2, 0.5f));
    EXPECT_TRUE(contains(page.until("{\"picture\":1}\n"), "{\"picture\":1}\n"));
    EXPECT_FALSE(server.wantsPicture()) << "it has not been fetched";
    server.publishState(R"({"n":2})");
    EXPECT_TRUE(contains(page.until("{\"n\":2}\n"), "{\"n\":2}\n"));

    const std::string answer = answerTo(server.port(), "GET /picture");
    EXPECT_TRUE(contains(answer, "Antipode-Width: 2\r\n")) << answer;
    EXPECT_TRUE(contains(answer, "Antipode-Iterations: 7\r\n"));
    EXPECT_TRUE(answer.ends_with(std::string("\x00\x38", 2) + std::string("\x00\x38", 2))) << "0.5 as binary16";
    EXPECT_TRUE(becomes([&] { return server.wantsPicture(); }));
}

TEST(ViewServer, APageThatGoesIsMissedAtOnce) {
    ViewServer server({"127.0.0.1", "0", ""});
    server.publishState("{}");
    {
        Visitor page(server.port());
        page.send(follow);
        page.until("{}\n");
        EXPECT_TRUE(server.watched());
    }
    EXPECT_TRUE(becomes([&] { return !server.watched(); }));
    EXPECT_LT(secondsOf([&] { server.farewell(60); }), 30) << "nobody is left to wait for";
}

TEST(ViewServer, ButtonsAreHeardOnceAndFromThePageAlone) {
    ViewServer server({"127.0.0.1", "0", ""});
    EXPECT_TRUE(answerTo(server.port(), "POST /finish", "Content-Length: 0\r\n").starts_with("HTTP/1.1 403"));
    EXPECT_TRUE(
        answerTo(server.port(), "POST /finish", act + "Origin: http://evil.example\r\n").starts_with("HTTP/1.1 403"));
    EXPECT_FALSE(server.takeFinishRequest());
    EXPECT_TRUE(
        answerTo(server.port(), "POST /finish", act + "Origin: http://localhost\r\n").starts_with("HTTP/1.1 204"));
    EXPECT_FALSE(server.takeWriteRequest());
    EXPECT_TRUE(server.takeFinishRequest());
    EXPECT_FALSE(server.takeFinishRequest());
    EXPECT_TRUE(answerTo(server.port(), "POST /write", act).starts_with("HTTP/1.1 204"));
    EXPECT_TRUE(server.takeWriteRequest());
}

TEST(ViewServer, WithATokenNothingIsToldWithoutIt) {
    ViewServer server({"127.0.0.1", "0", "0123456789abcdef"});
    server.publishState(R"({"secret":1})");
    server.publishPicture(pictureOf(1, 1, 1));
    for (const char* line : {"GET /events", "GET /picture", "POST /finish"}) {
        EXPECT_TRUE(answerTo(server.port(), line, act).starts_with("HTTP/1.1 401")) << line;
        EXPECT_TRUE(answerTo(server.port(), line, act + "Authorization: Bearer x\r\n").starts_with("HTTP/1.1 401"));
    }
    EXPECT_FALSE(server.takeFinishRequest());
    EXPECT_TRUE(answerTo(server.port(), "GET /picture", "Authorization: Bearer 0123456789abcdef\r\n")
                    .starts_with("HTTP/1.1 200"));
}

TEST(ViewServer, APageThatDoesNotReadDelaysNobody) {
    ViewServer server({"127.0.0.1", "0", ""});
    Visitor stuck(server.port()), page(server.port());
    stuck.send(follow);
    page.send(follow);
    // More than any socket's buffers hold, of which the stuck one reads nothing.
    const std::string large(1 << 20, 'x');
    const double publishing = secondsOf([&] {
        for (int i = 0; i < 64; ++i) server.publishState("{\"n\":" + std::to_string(i) + ",\"x\":\"" + large + "\"}");
    });
    EXPECT_LT(publishing, 5) << "64 MB were handed over";
    server.publishState(R"({"last":1})");
    EXPECT_TRUE(contains(page.until("{\"last\":1}"), "{\"last\":1}"));
}

TEST(ViewServer, RequestsAreBoundedInBytesAndTime) {
    const ViewServer server({"127.0.0.1", "0", ""});
    Visitor endless(server.port()), silent(server.port()), slow(server.port());
    endless.send("GET / HTTP/1.1\r\n");
    for (int i = 0; i < 10000 && endless.send("X-" + std::to_string(i) + ": y\r\n"); ++i) continue;
    EXPECT_TRUE(endless.ended());
    // One byte now and then does not buy more time than none.
    slow.send("GET / HT");
    const double seconds = secondsOf([&] {
        for (int i = 0; i < 100 && !slow.ended(0.2); ++i) slow.send("T");
    });
    EXPECT_LT(seconds, 19);
    EXPECT_TRUE(silent.ended());
    EXPECT_TRUE(answerTo(server.port(), "POST /finish", "Antipode-Action: yes\r\nContent-Length: 2000\r\n").empty());
}

TEST(ViewServer, AFloodOfStrangersShutsNoPageOut) {
    ViewServer server({"127.0.0.1", "0", ""});
    server.publishState(R"({"n":1})");
    Visitor page(server.port());
    page.send(follow);
    page.until("{\"n\":1}");
    std::deque<Visitor> strangers;
    for (int i = 0; i < 300; ++i) strangers.emplace_back(server.port());
    EXPECT_TRUE(answerTo(server.port(), "GET /").starts_with("HTTP/1.1 200")) << "the oldest strangers make room";
    EXPECT_TRUE(strangers.front().ended(4)) << "before its own time is over";
    server.publishState(R"({"n":2})");
    EXPECT_TRUE(contains(page.until("{\"n\":2}"), "{\"n\":2}"));
}

TEST(ViewServer, WhatIsNoHttpIsDropped) {
    const ViewServer server({"127.0.0.1", "0", ""});
    for (const std::string& bytes :
         {std::string("\x16\x03\x01\x02\x00\x01\x00\x01\xfc", 9), std::string("\r\n\r\n\r\n"), std::string(20000, 'A'),
          std::string("GET / HTTP/9.9\r\n\r\n")}) {
        Visitor visitor(server.port());
        visitor.send(bytes);
        EXPECT_TRUE(visitor.ended());
    }
    EXPECT_TRUE(answerTo(server.port(), "GET /").starts_with("HTTP/1.1 200"));
}

TEST(ViewServer, ATakenPortIsAUsageError) {
    const ViewServer first({"127.0.0.1", "0", ""});
    try {
        const ViewServer second({"127.0.0.1", std::to_string(first.port()), ""});
        FAIL() << "two servers on one port";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::Usage);
        EXPECT_TRUE(contains(error.what(), "--view: nobody can listen on '127.0.0.1'")) << error.what();
    }
}
