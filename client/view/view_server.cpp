#include "client/view/view_server.h"

#include <atomic>
#include <chrono>
#include <list>
#include <optional>
#include <set>
#include <thread>
#include <utility>

#include <boost/asio/awaitable.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>

#include "client/view/page.h"
#include "client/view/request_guard.h"
#include "renderengine/error.h"

namespace antipode::view {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;
using Request = http::request<http::string_body>;
using Buffers = http::response<http::span_body<const char>>;

constexpr uint32_t headerBytes = 8192, bodyBytes = 1024;
constexpr size_t mostConnections = 64, mostStreams = 24, mostPicturesAtOnce = 4;
// To send a request, and to keep a connection without one; to take a line; to take a picture.
constexpr auto requestTime = std::chrono::seconds(5), lineTime = std::chrono::seconds(30),
               pictureTime = std::chrono::seconds(120);
constexpr auto afterFailedAccept = std::chrono::milliseconds(100);

struct Connection {
    beast::tcp_stream stream;
    bool answered = false;  ///< its request has been let through and is being answered
    bool dropped = false;
};

/// Runs an action when it goes, however a coroutine ends.
template <class Action>
class Finally {
public:
    explicit Finally(Action action) : action_(std::move(action)) {}
    ~Finally() { action_(); }
    Finally(const Finally&) = delete;
    Finally& operator=(const Finally&) = delete;

private:
    Action action_;
};

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

/// Of "/picture?techniques=5"; all where nothing of the kind is asked for.
uint32_t techniquesAskedFor(std::string_view query) {
    constexpr std::string_view name = "techniques=";
    if (!query.starts_with(name)) return ~0u;
    uint32_t bits = 0;
    for (const char c : query.substr(name.size()).substr(0, 9)) {
        if (c < '0' || c > '9') return ~0u;
        bits = 10 * bits + uint32_t(c - '0');
    }
    return bits;
}

void describe(http::fields& fields) {
    fields.set(http::field::cache_control, "no-store");
    fields.set("X-Content-Type-Options", "nosniff");
    fields.set("Referrer-Policy", "no-referrer");
    fields.set("Cross-Origin-Resource-Policy", "same-origin");
    fields.set("X-Frame-Options", "DENY");
    fields.set("Content-Security-Policy",
               "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:; "
               "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
}

/// The bytes outlive the response.
Buffers response(const Request& request, http::status status, std::string_view type, std::string_view bytes) {
    Buffers answer{status, request.version()};
    describe(answer.base());
    answer.set(http::field::content_type, beast::string_view(type.data(), type.size()));
    answer.keep_alive(request.keep_alive());
    answer.body() = {bytes.data(), bytes.size()};
    answer.prepare_payload();
    return answer;
}

}  // namespace

struct ViewServer::Impl {
    explicit Impl(const ViewServerOptions& options) : token(options.token) {
        tcp::resolver resolver(io);
        for (const auto& entry : resolver.resolve(options.host, options.port, tcp::resolver::numeric_service)) {
            const tcp::endpoint endpoint = entry.endpoint();
            acceptor.open(endpoint.protocol());
            acceptor.set_option(asio::socket_base::reuse_address(true));
            acceptor.bind(endpoint);
            acceptor.listen();
            break;
        }
        port = acceptor.local_endpoint().port();
        asio::co_spawn(io, acceptAll(), asio::detached);
        thread = std::thread([this] { io.run(); });
    }

    ~Impl() {
        io.stop();
        thread.join();
    }

    template <class Action>
    void onThread(Action action) {
        asio::post(io, std::move(action));
    }

    void wakeStreams() {
        for (asio::steady_timer* sleeper : sleepers) sleeper->cancel();
    }

    asio::awaitable<void> acceptAll() {
        boost::system::error_code code;
        asio::steady_timer pause(io);
        while (true) {
            tcp::socket socket = co_await acceptor.async_accept(asio::redirect_error(asio::use_awaitable, code));
            if (code) {  // out of descriptors, or whoever came has gone
                pause.expires_after(afterFailedAccept);
                co_await pause.async_wait(asio::redirect_error(asio::use_awaitable, code));
                continue;
            }
            if (connections.size() >= mostConnections && !dropOldestStranger()) continue;
            asio::co_spawn(io, serve(std::move(socket)), asio::detached);
        }
    }

    /// Those that have not said anything yet make room for others.
    bool dropOldestStranger() {
        for (Connection* connection : connections)
            if (!connection->answered && !connection->dropped) {
                connection->dropped = true;
                connection->stream.close();
                return true;
            }
        return false;
    }

    asio::awaitable<void> serve(tcp::socket socket) {
        Connection connection{beast::tcp_stream(std::move(socket))};
        connections.push_back(&connection);
        const Finally leave([this, &connection] { connections.remove(&connection); });
        try {
            beast::flat_buffer buffer(headerBytes + bodyBytes);
            bool goesOn = true;
            while (goesOn) {
                http::request_parser<http::string_body> parser;
                parser.header_limit(headerBytes);
                parser.body_limit(bodyBytes);
                connection.answered = false;
                connection.stream.expires_after(requestTime);
                co_await http::async_read(connection.stream, buffer, parser, asio::use_awaitable);
                goesOn = co_await answer(connection, parser.get());
            }
        } catch (const boost::system::system_error&) {
            // Gone, too slow, or no HTTP: there is nobody to tell.
        }
    }

    /// False where the connection has to end.
    asio::awaitable<bool> answer(Connection& connection, const Request& request) {
        const std::string_view target = view(request.target());
        const size_t mark = target.find('?');
        const Asked asked{view(request.method_string()),
                          target.substr(0, mark),
                          view(request[http::field::host]),
                          view(request[http::field::origin]),
                          view(request[http::field::authorization]),
                          view(request[actionHeader])};
        if (const auto refused = refusal(asked, token)) {
            const Buffers reply =
                response(request, http::status(refused->status), "text/plain; charset=utf-8", refused->sentence);
            co_await write(connection, reply, lineTime);
            co_return request.keep_alive();
        }
        connection.answered = true;
        if (asked.path == "/events") {
            co_await follow(connection, request);
            co_return false;
        }
        if (asked.path == "/picture") {
            const std::string_view query = mark == target.npos ? "" : target.substr(mark + 1);
            co_await sendPicture(connection, request, techniquesAskedFor(query));
        } else if (asked.path == "/") {
            const Buffers reply = response(request, http::status::ok, "text/html; charset=utf-8", page());
            co_await write(connection, reply, lineTime);
        } else {
            (asked.path == "/finish" ? finishRequested : writeRequested) = true;
            const Buffers done = response(request, http::status::no_content, "text/plain", "");
            co_await write(connection, done, lineTime);
        }
        co_return request.keep_alive();
    }

    static asio::awaitable<void> write(Connection& connection, const Buffers& reply, std::chrono::seconds time) {
        http::response_serializer<http::span_body<const char>> serializer(reply);
        connection.stream.expires_after(time);
        co_await http::async_write(connection.stream, serializer, asio::use_awaitable);
    }

    asio::awaitable<void> sendPicture(Connection& connection, const Request& request, uint32_t techniques) {
        const bool tooMany = picturesInFlight >= mostPicturesAtOnce;
        if (!picture || tooMany) {
            const auto status = tooMany ? http::status::service_unavailable : http::status::no_content;
            const Buffers none = response(request, status, "text/plain", "");
            co_await write(connection, none, lineTime);
            co_return;
        }
        ++picturesInFlight;
        const Finally landed([this] { --picturesInFlight; });
        if (!encoded || encodedOf != techniques) {
            encoded = std::make_shared<const EncodedPicture>(encodePicture(*picture, techniques));
            encodedOf = techniques;
        }
        const std::shared_ptr<const EncodedPicture> sent = encoded;
        Buffers reply = response(request, http::status::ok, "application/octet-stream", sent->halves);
        const auto tell = [&](const char* name, const std::string& value) { reply.set(name, value); };
        tell("Antipode-Picture", std::to_string(pictureVersion));
        tell("Antipode-Width", std::to_string(sent->width));
        tell("Antipode-Height", std::to_string(sent->height));
        tell("Antipode-Reduction", std::to_string(sent->reduction));
        tell("Antipode-Iterations", std::to_string(sent->iterations));
        tell("Antipode-Stops", std::to_string(sent->stops));
        tell("Antipode-Exponent", std::to_string(sent->exponent));
        const uint64_t version = pictureVersion;
        co_await write(connection, reply, pictureTime);
        if (version == pictureVersion) pictureFetched = true;
    }

    /// Lines of JSON until the page goes.
    asio::awaitable<void> follow(Connection& connection, const Request& request) {
        if (streams >= mostStreams) {
            const Buffers full = response(request, http::status::service_unavailable, "text/plain", "");
            co_await write(connection, full, lineTime);
            co_return;
        }
        ++streams;
        const Finally ended([this] { --streams; });
        asio::steady_timer sleeper(io);
        sleepers.insert(&sleeper);
        const Finally leave([this, &sleeper] { sleepers.erase(&sleeper); });

        // What a page sends now, or that it goes, ends the stream.
        const auto gone = std::make_shared<bool>(false);
        connection.stream.socket().async_wait(tcp::socket::wait_read, [gone, this](auto) {
            *gone = true;
            wakeStreams();
        });
        http::response<http::empty_body> head{http::status::ok, request.version()};
        describe(head.base());
        head.set(http::field::content_type, "application/x-ndjson");
        head.keep_alive(false);
        http::response_serializer<http::empty_body> serializer(head);
        connection.stream.expires_after(lineTime);
        co_await http::async_write_header(connection.stream, serializer, asio::use_awaitable);

        uint64_t sentState = 0, sentPicture = 0;
        boost::system::error_code woken;
        while (!*gone) {
            // The picture first: a page goes once it has read the last state and seen the last picture that it knows
            // of.
            std::string lines;
            if (sentPicture != pictureVersion) lines = "{\"picture\":" + std::to_string(pictureVersion) + "}\n";
            if (sentState != stateVersion) lines += *state + "\n";
            sentState = stateVersion;
            sentPicture = pictureVersion;
            if (lines.empty()) {
                connection.stream.expires_never();
                sleeper.expires_at(asio::steady_timer::time_point::max());
                co_await sleeper.async_wait(asio::redirect_error(asio::use_awaitable, woken));
                continue;
            }
            connection.stream.expires_after(lineTime);
            co_await asio::async_write(connection.stream, asio::buffer(lines), asio::use_awaitable);
        }
    }

    const std::string token;
    uint16_t port = 0;
    std::atomic<size_t> streams = 0;
    std::atomic<bool> pictureFetched = true, finishRequested = false, writeRequested = false;

    // Of the thread alone.
    std::optional<std::string> state;
    uint64_t stateVersion = 0, pictureVersion = 0;
    std::optional<Picture> picture;
    std::shared_ptr<const EncodedPicture> encoded;
    uint32_t encodedOf = 0;
    size_t picturesInFlight = 0;
    std::list<Connection*> connections;  ///< the oldest first
    std::set<asio::steady_timer*> sleepers;

    // Last: what it destroys refers to all of the above.
    asio::io_context io{1};
    tcp::acceptor acceptor{io};
    std::thread thread;
};

ViewServer::ViewServer(const ViewServerOptions& options) {
    try {
        impl_ = std::make_unique<Impl>(options);
    } catch (const boost::system::system_error& error) {
        throw Error(ErrorCode::Usage, "--view: nobody can listen on '" + options.host + "', port " + options.port +
                                          ": " + error.code().message() +
                                          "; name an address of this machine and a port that is free.");
    }
}

ViewServer::~ViewServer() = default;

uint16_t ViewServer::port() const { return impl_->port; }
bool ViewServer::watched() const { return impl_->streams > 0; }
bool ViewServer::wantsPicture() const { return watched() && impl_->pictureFetched; }

void ViewServer::publishState(std::string json) {
    impl_->onThread([&impl = *impl_, json = std::move(json)]() mutable {
        impl.state = std::move(json);
        ++impl.stateVersion;
        impl.wakeStreams();
    });
}

void ViewServer::publishPicture(Picture picture) {
    impl_->pictureFetched = false;
    // Shared, because Asio copies what is moved into it only where it must, and pictures are large.
    impl_->onThread([&impl = *impl_, picture = std::make_shared<Picture>(std::move(picture))] {
        impl.picture = std::move(*picture);
        impl.encoded.reset();
        ++impl.pictureVersion;
        impl.wakeStreams();
    });
}

bool ViewServer::takeFinishRequest() { return impl_->finishRequested.exchange(false); }
bool ViewServer::takeWriteRequest() { return impl_->writeRequested.exchange(false); }

void ViewServer::farewell(double seconds) const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (watched() && std::chrono::steady_clock::now() < end)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

}  // namespace antipode::view
