#include "client/view/request_guard.h"

#include <gtest/gtest.h>

using namespace antipode::view;

namespace {

const std::string token = "3f9c2b7e51d84a06";

unsigned statusOf(const Asked& asked, const std::string& with = "") {
    const auto refused = refusal(asked, with);
    return refused ? refused->status : 200;
}

}  // namespace

TEST(RequestGuard, LoopbackAnswersItsOwnNamesOnly) {
    for (const char* host : {"localhost", "localhost:8080", "127.0.0.1:1", "127.0.0.2", "[::1]", "[::1]:8080"})
        EXPECT_EQ(statusOf({"GET", "/", host, "", "", ""}), 200u) << host;
    // A name that another site has pointed here, and what only looks like one of ours.
    for (const char* host : {"", "evil.example", "evil.example:8080", "localhost.evil.example",
                             "127.0.0.1.evil.example", "127.example", "[::2]", "::1", "0.0.0.0"})
        for (const char* path : {"/", "/events", "/picture", "/finish"})
            EXPECT_EQ(statusOf({"GET", path, host, "", "", ""}), 421u) << host << path;
}

TEST(RequestGuard, OnlyTheOwnPageChangesTheRender) {
    const auto post = [](const char* origin, const char* action, const char* method = "POST") {
        return statusOf({method, "/finish", "localhost:80", origin, "", action});
    };
    EXPECT_EQ(post("http://localhost:80", "yes"), 200u);
    EXPECT_EQ(post("", "yes"), 200u) << "no browser";
    EXPECT_EQ(post("http://localhost:80", ""), 403u) << "a form";
    EXPECT_EQ(post("http://evil.example", "yes"), 403u);
    EXPECT_EQ(post("http://localhost:81", "yes"), 403u);
    EXPECT_EQ(post("null", "yes"), 403u) << "a page in a sandbox";
    EXPECT_EQ(post("http://localhost:80", "yes", "GET"), 405u) << "a picture's address";
    EXPECT_EQ(statusOf({"OPTIONS", "/write", "localhost", "http://evil.example", "", ""}), 405u) << "no site may ask";
}

TEST(RequestGuard, ATokenIsNeededForAllButThePageItself) {
    const std::string right = "Bearer " + token;
    const auto ask = [](const char* path, const std::string& authorization) {
        return statusOf({"GET", path, "render.example:8080", "", authorization, ""}, token);
    };
    EXPECT_EQ(ask("/", ""), 200u);
    for (const char* path : {"/events", "/picture"}) {
        EXPECT_EQ(ask(path, right), 200u);
        for (const std::string& wrong : {std::string(), std::string("Bearer "), "Bearer " + token.substr(1),
                                         right + "0", "Basic " + token, token, std::string("Bearer 3f9c2b7e51d84a07")})
            EXPECT_EQ(ask(path, wrong), 401u) << wrong;
    }
    const auto finish = [&](const std::string& authorization, const char* action) {
        return statusOf({"POST", "/finish", "render.example", "https://render.example", authorization, action}, token);
    };
    EXPECT_EQ(finish(right, "yes"), 200u);
    EXPECT_EQ(finish("", "yes"), 401u);
    EXPECT_EQ(finish(right, ""), 403u);
}

TEST(RequestGuard, NothingElseIsThere) {
    for (const char* path : {"/favicon.ico", "", "//", "/../etc/passwd", "/events/"})
        EXPECT_EQ(statusOf({"GET", path, "localhost", "", "", ""}), 404u) << path;
    EXPECT_EQ(statusOf({"POST", "/", "localhost", "", "", ""}), 405u);
    EXPECT_EQ(statusOf({"PUT", "/picture", "localhost", "", "", "yes"}), 405u);
}

TEST(RequestGuard, TokensFitIntoAddresses) {
    EXPECT_TRUE(isToken(token));
    EXPECT_TRUE(isToken("aZ09-._~"));
    for (const char* text : {"", "a b", "a#b", "a%20", "ü", "a/b", "a\n"}) EXPECT_FALSE(isToken(text)) << text;
}
