#include "server/relay/network_children.h"

#include <utility>

namespace antipode {
namespace {

class NetworkChildren final : public RelayChildren {
public:
    NetworkChildren(asio::io_context& io, const ServerListOptions& options, std::shared_ptr<RemoteContext> context)
        : servers_(io, options, std::move(context)) {}

    std::vector<std::string> tick(double now) override {
        servers_.tick(now);
        return servers_.takeMessages();
    }

    std::string hopeless() const override {
        std::string reason;
        if (servers_.hasFile()) return reason;  // people mend what it names
        for (const RemoteStatus& server : servers_.status()) {
            if (!server.refusedForGood) return "";
            if (reason.empty()) reason = server.name + " refuses: " + server.detail;
        }
        return reason;
    }

    void stop() override { servers_.stop(); }
    bool stopped() const override { return servers_.stopped(); }

private:
    ServerList servers_;
};

}  // namespace

MakeRelayChildren networkChildren(asio::io_context& io, ServerListOptions options) {
    return [&io, options = std::move(options)](std::shared_ptr<RemoteContext> context) {
        return std::make_unique<NetworkChildren>(io, options, std::move(context));
    };
}

}  // namespace antipode
