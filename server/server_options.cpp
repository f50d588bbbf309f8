#include "server/server_options.h"

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <limits>

#include "renderengine/version.h"
#include "terminal/command_line.h"
#include "terminal/text.h"
#include "renderengine/engine.h"
#include "renderengine/error.h"

namespace antipode {
namespace {

namespace fs = std::filesystem;

/// Blocks of a job that a relay has at once: while the last iterations of some are rendered, its servers have others.
constexpr uint32_t relayLeaseDepth = 4;

AssignValue assignLogFormat(bool& json) {
    return [&json](const std::string&, const std::string& value) { json = value == "json"; };
}

AssignValue assignQuiet(std::string& level) {
    return [&level](const std::string&, const std::string&) { level = "warning"; };
}

/// What is looked at once all values are known.
struct Texts {
    std::string listen, clientName;
    std::vector<std::string> relayed;
    bool version = false;
};

std::vector<OptionRow> bindingTable(ServerOptions& options, Texts& texts) {
    RenderQueueLimits& limits = options.limits;
    return {
        {"--listen", "HOST:PORT", "where clients connect; other than loopback needs a secret or certificates",
         options.listen.text(), assignText(texts.listen)},
        {"--device", "DEVICE", "device by index, UUID or PCI id, as 'antipode devices' lists them", "the best one",
         assignText(options.device)},
        {"--relay", "HOST:PORT",
         "have this antipode-server render instead of a device: split blocks, add up sums; may be given several times",
         "no relay", assignText(texts.relayed), true},
        {"--relay-file", "FILE", "servers to relay to, one HOST:PORT a line; read again while rendering", "none",
         assignText(options.relayed.serversFile)},
        {"--relay-verify", "FRACTION", "share of their blocks that a second one of them renders, too", "none",
         assignReal(options.relayedVerifyFraction, 0, 1)},
        {"--cache", "DIR", "folder for the scenes of clients",
         "$CACHE_DIRECTORY, $XDG_CACHE_HOME/antipode or ~/.cache/antipode, server-PORT",
         assignText(options.cacheFolder)},
        {"--cache-size", "BYTES", "what the folder may hold; the least recently used goes first",
         byteSize(options.cacheBytes), assignBytes(options.cacheBytes)},
        {"--psk-file", "FILE", "shared secret of at least 16 bytes", "none", assignText(options.security.pskFile)},
        {"--client-secret",
         "NAME",
         "print a secret of a client's own, made of --psk-file, and end",
         "",
         assignText(texts.clientName),
         false,
         {},
         true},
        {"--revoked", "FILE", "clients that are not let in any more: their names, or the CA's revocation list", "none",
         assignText(options.security.revokedFile)},
        {"--tls-cert", "FILE", "this server's certificate (PEM)", "none", assignText(options.security.certFile)},
        {"--tls-key", "FILE", "its private key (PEM)", "none", assignText(options.security.keyFile)},
        {"--tls-ca", "FILE", "certificates of those who sign clients' certificates (PEM)", "none",
         assignText(options.security.caFile)},
        {"--metrics", "[HOST:]PORT", "where Prometheus finds /metrics; loopback without HOST", "nowhere",
         assignText(options.metrics)},
        {"--max-jobs", "COUNT", "jobs at once", std::to_string(limits.jobs), assignWhole(limits.jobs, 1, 1024)},
        {"--max-pixels", "COUNT", "largest image", std::to_string(limits.pixels),
         assignWhole(limits.pixels, 1, 1ull << 28)},
        {"--max-scene", "BYTES", "memory for the scenes of all jobs together", byteSize(limits.sceneBytes),
         assignBytes(limits.sceneBytes)},
        {"--max-memory", "BYTES", "device memory of all jobs together", "the device's",
         assignBytes(limits.deviceBytes)},
        {"--drain", "SECONDS", "time from SIGTERM to the end, for clients to fetch what is rendered", "30",
         assignReal(options.drainSeconds, 0)},
        {"--log-level",
         "NAME",
         "the least that is logged: info, warning or error",
         options.log.level,
         assignText(options.log.level),
         false,
         {"info", "warning", "error"}},
        {"--log-format",
         "NAME",
         "the log on stderr: text, or json, an object a line with time, level and message",
         "text",
         assignLogFormat(options.log.json),
         false,
         {"text", "json"}},
        {"--quiet", "", "the same as --log-level warning", "", assignQuiet(options.log.level)},
        {"--version", "", "print the version", "", assignFlag(texts.version, true), false, {}, true},
    };
}

/// A folder of the user's own, or of the service's; one per port, because one server owns it at a time. Nowhere else:
/// who can write where all can write could prepare it.
fs::path defaultCacheFolder(const std::string& port) {
    const auto set = [](const char* value) { return value && *value; };
    const char* service = std::getenv("CACHE_DIRECTORY");  // of systemd; the first of several
    if (set(service))
        return fs::path(std::string(service).substr(0, std::string(service).find(':'))) / ("server-" + port);
    const char* cache = std::getenv("XDG_CACHE_HOME");
    if (set(cache)) return fs::path(cache) / "antipode" / ("server-" + port);
    const char* home = std::getenv("HOME");
    if (set(home)) return fs::path(home) / ".cache" / "antipode" / ("server-" + port);
    throw Error(ErrorCode::Usage, "There is no home folder for the scenes of clients: name a folder with --cache.");
}

void makeRelayConsistent(ServerOptions& options, const std::vector<std::string>& relayed) {
    for (const std::string& server : relayed) {
        options.relayed.servers.push_back(wire::parseEndpoint("--relay", server));
        wire::requireSecured(options.security, options.relayed.servers.back(), "--relay");
    }
    // The servers let a relay in as they do clients.
    options.relayed.security = options.security;
    options.relayed.security.revokedFile.clear();
    if (!options.isRelay() && options.relayedVerifyFraction > 0)
        throw Error(ErrorCode::Usage, "--relay-verify goes with --relay or --relay-file.");
    if (options.isRelay() && !options.device.empty())
        throw Error(ErrorCode::Usage, "A relay has no device: --device and --relay do not go together.");
    if (options.isRelay()) options.limits.leaseDepth = relayLeaseDepth;
}

void makeConsistent(ServerOptions& options, const Texts& texts) {
    if (!texts.listen.empty()) options.listen = wire::parseEndpoint("--listen", texts.listen);
    wire::requireSecured(options.security, options.listen, "--listen");
    if (options.metrics) options.metrics = wire::parseEndpoint("--metrics", *options.metrics, "127.0.0.1").text();
    if (options.cacheFolder.empty()) options.cacheFolder = defaultCacheFolder(options.listen.port).string();
    options.kernelHash = kernelHash();
    makeRelayConsistent(options, texts.relayed);
}

}  // namespace

std::optional<ServerOptions> parseServerOptions(const std::vector<std::string>& arguments) {
    ServerOptions options;
    Texts texts;
    if (!parseCommandLine(
            "antipode-server",
            "Renders blocks of iterations for clients ('antipode render --server HOST:PORT') on one device, or as a "
            "relay on "
            "further servers.",
            bindingTable(options, texts), arguments,
            "The first SIGTERM or SIGINT drains: the block in hand ends after its iteration, clients fetch what is\n"
            "rendered, exit code 0. A second one stops at once. SIGHUP has secret, certificates and --revoked read\n"
            "again, and all clients prove themselves anew; without any of these it drains, too.",
            [&] {
                if (texts.clientName.empty() && !texts.version) makeConsistent(options, texts);
            }))
        return std::nullopt;
    if (!texts.clientName.empty()) {
        std::cout << wire::makeClientSecret(options.security.pskFile, texts.clientName) << std::endl;
        return std::nullopt;
    }
    if (texts.version) {
        std::cout << "antipode-server " << versionText << std::endl;
        return std::nullopt;
    }
    return options;
}

}  // namespace antipode
