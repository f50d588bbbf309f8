#include "tests/farm/simulation/simulated_farm.h"

#include <algorithm>
#include <filesystem>

#include "tests/film/temporary_folder.h"

namespace antipode::simulation {
namespace {

constexpr size_t mostQueuedBytes = 8 << 20;

std::shared_ptr<const wire::ScenePackage> tinyPackage() {
    static const auto package = std::make_shared<wire::ScenePackage>(wire::packageScene(test::tinyScene()));
    return package;
}

}  // namespace

std::string cacheFolderOf(const std::string& server) {
    static const test::TemporaryFolder folder;
    return folder.file(server);
}

void emptyCache(const std::string& server) { std::filesystem::remove_all(cacheFolderOf(server)); }

void fillCache(const std::string& server, const wire::ScenePackage& scene) {
    SceneCache cache(cacheFolderOf(server), 64 << 20);
    for (const wire::Blob& blob : scene.blobs)
        if (const uint64_t here = cache.available(blob.reference); here < blob.bytes->size())
            cache.append(blob.reference, here, std::string_view(*blob.bytes).substr(here));
}

SimulatedFarm::SimulatedFarm(uint64_t seed, bool watched) : scene(tinyPackage()), start_(loop_.now()), random_(seed) {
    loop_.after(0.25, [this] { checkBounds(); });
    if (watched) loop_.watch([this](const std::string& sentence) { failures_.push_back(sentence); });
}

SimulatedFarm::~SimulatedFarm() {
    for (const auto& client : clients_) client->kill(false);
    for (const auto& server : servers_) server->kill(false);
}

SimulatedServer& SimulatedFarm::addServer(const ServerModel& model, bool emptied) {
    const std::string name = "server" + std::to_string(servers_.size() + 1);
    if (emptied)
        emptyCache(name);
    else
        fillCache(name, *scene);
    servers_.push_back(std::make_unique<SimulatedServer>(loop_, name, model, cacheFolderOf(name), connect()));
    servers_.back()->start();
    return *servers_.back();
}

SimulatedClient& SimulatedFarm::addClient(const ClientModel& model) {
    const std::string name = "client" + std::to_string(clients_.size() + 1);
    clients_.push_back(
        std::make_unique<SimulatedClient>(loop_, name, model, scene, random_.index(1u << 31), connect()));
    clients_.back()->start();
    return *clients_.back();
}

Connect SimulatedFarm::connect() {
    return [this](const std::string& name, Process& from, SimulatedServer& to) -> Link& {
        return makeLink(name, from, to);
    };
}

Link& SimulatedFarm::makeLink(const std::string& name, Process& from, SimulatedServer& to) {
    Link& link = links_.emplace_back(name + "-" + to.name(), quality, from, to.process());
    link.onError = [this, name = link.name()](const std::string& error) { failures_.push_back(name + ": " + error); };
    return link;
}

std::vector<Link*> SimulatedFarm::openLinks() {
    std::vector<Link*> open;
    for (Link& link : links_)
        if (link.client().open() && link.server().open()) open.push_back(&link);
    return open;
}

void SimulatedFarm::checkBounds() {
    for (const auto& server : servers_)
        if (const auto broken = server->brokenBound()) failures_.push_back(*broken);
    for (const auto& client : clients_)
        if (const auto broken = client->brokenBound()) failures_.push_back(*broken);
    if (failures_.size() < 10) loop_.after(0.25, [this] { checkBounds(); });
}

bool SimulatedFarm::complete() const {
    return std::ranges::all_of(clients_, [](const auto& client) { return client->complete(); });
}

void SimulatedFarm::run(double seconds) {
    loop_.run(loop_.now() + seconds, [this] { return complete(); });
}

void SimulatedFarm::pass(double seconds) {
    const double end = loop_.now() + seconds;
    bool over = false;
    loop_.at(end, [&over] { over = true; });
    loop_.run(end, [&over] { return over; });
}

std::vector<std::string> SimulatedFarm::failures() const {
    std::vector<std::string> all = failures_;
    for (const Link& link : links_)
        if (std::max(link.largestClientQueue(), link.largestServerQueue()) > mostQueuedBytes)
            all.push_back(link.name() + " has queued too many bytes");
    return all;
}

size_t SimulatedFarm::largestServerQueue() const {
    size_t largest = 0;
    for (const Link& link : links_) largest = std::max(largest, link.largestServerQueue());
    return largest;
}

ClientModel tinyJob(uint64_t iterations) {
    ClientModel model;
    model.settings.width = 3;
    model.settings.height = 2;
    model.settings.initialRadius = 0.125;
    model.settings.maxPathLength = 8;
    model.options.iterations = iterations;
    model.budgetBytes = 2 * 24 * 6;
    return model;
}

}  // namespace antipode::simulation
