#include "client/render_options.h"

#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "terminal/command_line.h"
#include "renderengine/io/suggest.h"
#include "renderengine/denoise.h"
#include "renderengine/error.h"

namespace antipode {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t defaultIterations = 64;
constexpr const char* noiseLayerName = "noise";
constexpr uint64_t largest64 = std::numeric_limits<uint64_t>::max();

template <class T>
std::string shown(T value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

std::string techniqueDescriptions() {
    std::string text = "Techniques:\n";
    for (const TechniqueInfo& technique : techniqueTable())
        text += "  " + technique.name + std::string(28 - technique.name.size(), ' ') + technique.description + "\n";
    return text;
}

std::string transportDescriptions() {
    std::string text = "\nWhat can be left out:\n";
    for (const TransportInfo& info : transportTable()) {
        const std::string name = info.option;
        text += "  " + name + std::string(28 - name.size(), ' ') + info.description + "\n";
    }
    return text;
}

std::vector<std::string> techniqueNamesAndAuto() {
    std::vector<std::string> names = techniqueNames();
    names.push_back(automaticTechnique);
    return names;
}

std::vector<std::string> transportNames() {
    std::vector<std::string> names;
    for (const TransportInfo& info : transportTable()) names.push_back(info.option);
    return names;
}

std::vector<std::string> layerNames() {
    std::vector<std::string> names{noiseLayerName};
    for (const LayerInfo& layer : layerTable()) names.push_back(layer.option);
    return names;
}

AssignValue assignCrop(std::optional<PixelWindow>& target) {
    return [&target](const std::string& option, const std::string& value) {
        std::array<uint32_t, 4> sides{};
        const char* at = value.data();
        const char* const end = at + value.size();
        for (size_t i = 0; i < sides.size(); ++i) {
            const auto [next, error] = std::from_chars(at, end, sides[i]);
            const bool last = i + 1 == sides.size();
            if (error != std::errc() || (last ? next != end : next == end || *next != ','))
                throw Error(ErrorCode::Usage, option + " takes four whole numbers X0,Y0,X1,Y1, not '" + value + "'.");
            at = next + (last ? 0 : 1);
        }
        target = PixelWindow{sides[0], sides[1], sides[2], sides[3]};
    };
}

AssignValue assignPrecision(Precision& target) {
    return [&target](const std::string&, const std::string& value) {
        target = value == name(Precision::Double) ? Precision::Double : Precision::Float;
    };
}

AssignValue assignSampler(Sampler& target) {
    return [&target](const std::string&, const std::string& value) {
        target = value == name(Sampler::Sobol) ? Sampler::Sobol : Sampler::Independent;
    };
}

AssignValue assignProgress(bool& json) {
    return [&json](const std::string&, const std::string& value) { json = value == "json"; };
}

/// Adds what the names, parted by commas, stand for in the table, whose row i is of the set's value i.
template <class E, uint32_t size, class Table>
void addNamed(EnumSet<E, size>& set, const Table& table, const std::string& names) {
    std::istringstream list(names);
    for (std::string name; std::getline(list, name, ',');)
        for (size_t i = 0; i < table.size(); ++i)
            if (name == table[i].option) set.add(E(i));
}

/// Layers of the film, and what the client tells from it.
AssignValue assignLayers(RenderOptions& target) {
    return [&target](const std::string&, const std::string& value) {
        addNamed(target.settings.layers, layerTable(), value);
        target.biasLayer |= target.settings.layers.has(LayerKind::Blur);
        target.noiseLayer |= ("," + value + ",").find("," + std::string(noiseLayerName) + ",") != std::string::npos;
    };
}

AssignValue assignWithout(TransportSet& target) {
    return [&target](const std::string&, const std::string& value) { addNamed(target, transportTable(), value); };
}

/// No light paths: none of what needs them.
AssignValue assignLightPaths(RenderSettings& settings, bool& none) {
    return [&settings, &none](const std::string& option, const std::string& value) {
        const uint64_t count = parseWhole(option, value, 0, SettingsLimits::lightPaths);
        none = count == 0;
        if (!none) settings.lightPathCount = count;
    };
}

void leaveOutLightPaths(RenderSettings& settings) {
    const std::string& chosen = settings.technique;
    for (const TechniqueInfo& technique : techniqueTable()) {
        if (technique.name != (chosen == automaticTechnique ? techniqueTable().front().name : chosen)) continue;
        for (const Transport transport : {Transport::LightTracing, Transport::Connections, Transport::Merging})
            if (technique.transports.has(transport)) settings.without.add(transport);
    }
}

AssignValue assignStudio(Studio& target) {
    return [&target](const std::string&, const std::string& value) {
        target = value == "none" ? Studio::None : value == "soft" ? Studio::Soft : Studio::Sun;
    };
}

AssignValue assignLampUnits(LampUnits& target) {
    return [&target](const std::string&, const std::string& value) {
        target = value == "auto"          ? LampUnits::ByGenerator
                 : value == "radiometric" ? LampUnits::Radiometric
                                          : LampUnits::Photometric;
    };
}

AssignValue assignUpAxis(UpAxis& target) {
    return [&target](const std::string&, const std::string& value) { target = value == "z" ? UpAxis::Z : UpAxis::Y; };
}

AssignValue assignGuides(std::optional<Guides>& target) {
    return [&target](const std::string&, const std::string& value) {
        target = value == name(Guides::FirstHit) ? Guides::FirstHit : Guides::FirstDiffuse;
    };
}

AssignValue assignFieldChange(std::vector<FieldChange>& changes) {
    return [&changes](const std::string& option, const std::string& value) {
        const size_t sign = value.find('=');
        if (sign == std::string::npos || sign == 0)
            throw Error(ErrorCode::Usage,
                        option + " takes FIELD=VALUE, as in camera.position=0,1,2, not '" + value + "'.");
        changes.push_back({value.substr(0, sign), value.substr(sign + 1)});
    };
}

/// HOST:PORT, or PORT on loopback.
AssignValue assignEndpoint(std::optional<wire::Endpoint>& target) {
    return [&target](const std::string& option, const std::string& value) {
        target = wire::parseEndpoint(option, value, "127.0.0.1");
    };
}

/// "1-48", or "7" for one.
AssignValue assignFrames(std::optional<FrameRange>& frames) {
    return [&frames](const std::string& option, const std::string& value) {
        constexpr uint64_t most = 1'000'000'000;
        const size_t dash = value.find('-');
        FrameRange range;
        range.first = uint32_t(parseWhole(option, value.substr(0, dash), 0, most));
        range.last =
            dash == std::string::npos ? range.first : uint32_t(parseWhole(option, value.substr(dash + 1), 0, most));
        if (range.last < range.first)
            throw Error(ErrorCode::Usage, option + " takes FIRST-LAST, as in 1-48, not '" + value + "'.");
        frames = range;
    };
}

std::string layerDescriptions() {
    std::string text = "\nLayers:\n";
    for (const LayerInfo& layer : layerTable()) {
        const std::string name = layer.option;
        text += "  " + name + std::string(28 - name.size(), ' ') + layer.description + "\n";
    }
    return text + "  " + noiseLayerName + std::string(23, ' ') + "standard error of the image\n";
}

/// The binding table: `options` holds the defaults and takes the values.
std::vector<OptionRow> bindingTable(RenderOptions& options, std::vector<std::string>& servers, bool& noLightPaths) {
    RenderSettings& settings = options.settings;
    return {
        {"SCENE", "", "scene to render: a scene (.textproto; - from standard input) or a model (.glb .gltf .obj …)", "",
         assignText(options.scenePath)},
        {"--camera", "NAME", "which of a model's cameras is looked through", "its first",
         assignText(options.import.camera)},
        {"--environment", "FILE", "map (.exr .hdr) that lights the scene instead of its own environment", "the scene's",
         assignText(options.changes.environmentFile)},
        {"--set", "FIELD=VALUE", "change the scene, as in camera.position=0,1,2; may be given several times", "",
         assignFieldChange(options.changes.fields), true},
        {"--exposure", "STOPS|auto", "the PNG is shown at 2^STOPS; auto: only where it would be too dark or too bright",
         "auto", assignExposure(options.exposure)},
        {"--strict", "", "an image that a model lacks is an error, not a magenta checker", "",
         assignFlag(options.import.strict, true)},
        {"--studio",
         "NAME",
         "light of a model that brings none: none (a white sky), soft or sun",
         "soft",
         assignStudio(options.import.studio),
         false,
         {"none", "soft", "sun"}},
        {"--lamp-units",
         "NAME",
         "lamps of glTF: radiometric (W/sr, W/m^2), photometric (cd, lux at 683 lm/W) or auto",
         "auto",
         assignLampUnits(options.import.lampUnits),
         false,
         {"auto", "radiometric", "photometric"}},
        {"--up",
         "y|z",
         "which axis of a model that is not glTF points up",
         "as the file says, z for .stl",
         assignUpAxis(options.import.up),
         false,
         {"y", "z"}},
        {"--animation-time", "SECONDS", "show an animated glTF at this time of its first animation", "at rest",
         assignReal(options.import.animationTime, -1)},
        {"--frames", "FIRST-LAST", "render these frames of an animation; #### in names of files is their number", "",
         assignFrames(options.frames)},
        {"--fps", "RATE", "frames a second", shown(options.framesPerSecond), assignReal(options.framesPerSecond, 0)},
        {"--overwrite", "", "render frames again that are there as they are asked for", "",
         assignFlag(options.overwrite, true)},
        {"-o,--output", "FILE.exr", "image to write, linear RGB; a tone-mapped PNG goes beside it",
         "SCENE's name in this folder", assignText(options.exrPath)},
        {"--width", "PIXELS", "image width", "the scene's", assignWhole(options.size.width, 1, SettingsLimits::side)},
        {"--height", "PIXELS", "image height", "the scene's",
         assignWhole(options.size.height, 1, SettingsLimits::side)},
        {"--crop", "X0,Y0,X1,Y1", "render these pixels of the image alone, as they are in the whole", "all of them",
         assignCrop(settings.crop)},
        {"--technique", "NAME",
         "how light is transported: " + joined(techniqueNames()) +
             "; auto: what a pilot finds the fastest of pt, bpt and vcm",
         settings.technique, assignText(settings.technique), false, techniqueNamesAndAuto()},
        {"--without", "LIST", "what of the technique to leave out, parted by commas", name(settings.without),
         assignWithout(settings.without), false, transportNames()},
        {"--allow-missing", "", "leave out even what alone renders light that the scene can have", "",
         assignFlag(options.allowMissing, true)},
        {"--precision",
         "NAME",
         "arithmetic of the kernels: float, or double to measure what float costs",
         name(settings.precision),
         assignPrecision(settings.precision),
         false,
         {name(Precision::Float), name(Precision::Double)}},
        {"--sampler",
         "NAME",
         "numbers that paths are drawn by: sobol (scrambled nets), or independent to compare with",
         name(settings.sampler),
         assignSampler(settings.sampler),
         false,
         {name(Sampler::Sobol), name(Sampler::Independent)}},
        {"--iterations", "COUNT", "iterations to render",
         shown(defaultIterations) + ", unlimited with --time or --target-error",
         assignWhole(options.iterations, 1, largest64)},
        {"--time", "SECONDS", "start no iteration after this time, counted from when the first device is ready",
         "unlimited", assignReal(options.seconds, 0)},
        {"--seed", "NUMBER", "seed of the random numbers", shown(settings.seed),
         assignWhole(settings.seed, 0, largest64)},
        {"--device", "DEVICE", "device by index, UUID or PCI id, as 'antipode devices' lists them", "the best one",
         assignText(options.device)},
        {"--max-path-length", "EDGES", "longest light path", "unlimited",
         assignNumber(settings, &RenderSettings::maxPathLength)},
        {"--radius-factor", "FACTOR", "initial merge radius in widths of a pixel where the camera looks",
         shown(settings.radiusFactor), assignNumber(settings, &RenderSettings::radiusFactor)},
        {"--alpha", "ALPHA", "radius reduction: iteration i merges within r1·i^((ALPHA-1)/2)", shown(settings.alpha),
         assignNumber(settings, &RenderSettings::alpha)},
        {"--no-russian-roulette", "",
         "follow every path to its longest length (needs a bound: the scene's or --max-path-length)", "",
         assignFlag(settings.russianRoulette, false)},
        {"--flat-triangles", "", "leave coarse smooth triangles flat, not curved as their normals tell", "",
         assignFlag(settings.curvedTriangles, false)},
        {"--light-paths", "COUNT", "light paths per iteration; 0 leaves out all that needs them", "one per pixel",
         assignLightPaths(settings, noLightPaths)},
        {"--connections", "COUNT", "light vertices that each camera vertex connects to",
         shown(settings.connectionsPerVertex), assignNumber(settings, &RenderSettings::connectionsPerVertex)},
        {"--layers", "LIST", "layers to write beside the image, parted by commas", name(settings.layers),
         assignLayers(options), false, layerNames()},
        {"--guides",
         "NAME",
         "surface that guides tell of: first-hit, or first-diffuse, seen in mirrors and through glass",
         std::string(name(settings.guides)) + "; first-hit with --denoise",
         assignGuides(options.guides),
         false,
         {name(Guides::FirstDiffuse), name(Guides::FirstHit)}},
        {"--residue-classes", "COUNT", "layers that the image is parted into, by iteration modulo COUNT", "1",
         assignNumber(settings, &RenderSettings::residueClasses)},
        {"--denoise", "",
         "take noise out where that makes the image more accurate; the EXR's layer 'noisy' is as rendered", "",
         assignFlag(options.denoise, true)},
        {"--target-error", "PERCENT", "end when the image's error is no larger", "none",
         assignReal(options.targetError, 0)},
        {"--error-map", "FILE.png", "map of the image's relative error to write: black 0.1 % to pale yellow 100 %",
         "none", assignText(options.errorMapPath)},
        {"--no-error", "", "do not estimate the image's error", "", assignFlag(options.estimatesError, false)},
        {"--stats", "FILE.json", "statistics to write", "none", assignText(options.statsPath)},
        {"--preview", "SECONDS", "rewrite the PNG this often while rendering", "only at the end",
         assignReal(options.previewSeconds, 0)},
        {"--checkpoint", "FILE", "keep what is rendered in FILE; where it exists, go on from it", "none",
         assignText(options.checkpointPath)},
        {"--checkpoint-every", "SECONDS", "how often", shown(options.checkpointSeconds),
         assignReal(options.checkpointSeconds, 0)},
        {"--resume", "FILE", "go on from this checkpoint, which must exist, and keep it up to date", "none",
         assignText(options.resumePath)},
        {"--server", "HOST:PORT", "render on this antipode-server; may be given several times", "this machine alone",
         assignText(servers), true},
        {"--servers-file", "FILE", "servers, one HOST:PORT a line; read again while rendering", "none",
         assignText(options.serversFile)},
        {"--wait", "SECONDS", "give up when no server has been at work for so long", "wait for ever",
         assignReal(options.waitSeconds, 0)},
        {"--local", "", "use this machine's device beside the servers", "", assignFlag(options.local, true)},
        {"--psk-file", "FILE", "secret that is shared with the servers", "none", assignText(options.security.pskFile)},
        {"--tls-cert", "FILE", "this client's certificate (PEM)", "none", assignText(options.security.certFile)},
        {"--tls-key", "FILE", "its private key (PEM)", "none", assignText(options.security.keyFile)},
        {"--tls-ca", "FILE", "certificates of those who sign servers' certificates (PEM)", "none",
         assignText(options.security.caFile)},
        {"--verify", "FRACTION", "share of the blocks that a second server renders, too", "none",
         assignReal(options.verifyFraction, 0, 1)},
        {"--metrics", "[HOST:]PORT", "where Prometheus finds /metrics; loopback without HOST", "nowhere",
         assignText(options.metrics)},
        {"--view", "[HOST:]PORT", "where a browser sees the render live; loopback without HOST", "nowhere",
         assignEndpoint(options.view)},
        {"--view-token", "FILE", "token that the page needs, as others than this machine can reach it", "none",
         assignText(options.viewTokenPath)},
        {"--progress",
         "NAME",
         "how far it is, as text on stderr, or as json: an object a line on stdout",
         "text",
         assignProgress(options.progressJson),
         false,
         {"text", "json"}},
        {"--quiet", "", "print nothing but warnings and errors", "", assignFlag(options.quiet, true)},
    };
}

}  // namespace

std::vector<std::string> techniqueNames() {
    std::vector<std::string> names;
    for (const TechniqueInfo& technique : techniqueTable()) names.push_back(technique.name);
    return names;
}

AssignValue assignExposure(std::optional<double>& target) {
    return [&target](const std::string& option, const std::string& value) {
        target.reset();
        if (value == "auto") return;
        const char* begin = value.data() + value.starts_with('+');
        double stops = 0;
        const auto [end, error] = std::from_chars(begin, value.data() + value.size(), stops);
        constexpr double most = 64;
        if (error != std::errc() || end != value.data() + value.size() || !(std::abs(stops) <= most))
            throw Error(ErrorCode::Usage,
                        option + " takes a number of stops from -64 to 64, or auto, not '" + value + "'.");
        target = stops;
    };
}

namespace {

void resolveOutputPaths(RenderOptions& options) {
    if (options.exrPath.empty()) {
        const fs::path stem = fs::path(options.scenePath).stem();
        if (options.scenePath == "-")
            throw Error(ErrorCode::Usage, "A scene on standard input has no name: say with --output where to write.");
        if (stem.empty()) throw Error(ErrorCode::Usage, "SCENE '" + options.scenePath + "' does not name a file.");
        options.exrPath = stem.string() + ".exr";
    }
    const fs::path exr = options.exrPath;
    if (exr.extension() != ".exr")
        throw Error(ErrorCode::Usage, "--output takes a name that ends in .exr, not '" + options.exrPath + "'.");
    options.pngPath = fs::path(exr).replace_extension(".png").string();
    if (options.statsPath == options.exrPath || options.statsPath == options.pngPath)
        throw Error(ErrorCode::Usage, "--stats would overwrite the image '" + *options.statsPath + "'.");
    for (const std::string& path : {options.exrPath, options.pngPath, options.statsPath.value_or("")})
        if (!path.empty() && options.errorMapPath == path)
            throw Error(ErrorCode::Usage, "--error-map would overwrite '" + path + "'.");
}

/// Images need names of their own; of all else that is written, too.
void resolveFrames(RenderOptions& options) {
    if (!options.frames) {
        if (options.overwrite) throw Error(ErrorCode::Usage, "--overwrite goes with --frames.");
        return;
    }
    if (options.import.animationTime)
        throw Error(ErrorCode::Usage, "--frames and --animation-time exclude each other.");
    if (options.scenePath == "-")
        throw Error(ErrorCode::Usage, "--frames needs a scene that can be read again, not -.");
    if (options.exrPath.find('#') == std::string::npos)
        options.exrPath.insert(options.exrPath.size() - std::string(".exr").size(), "_####");
    options.pngPath = fs::path(options.exrPath).replace_extension(".png").string();
    for (const auto& [option, path] :
         {std::pair("--stats", options.statsPath.value_or("")), std::pair("--checkpoint", options.checkpointPath)})
        if (!path.empty() && path.find('#') == std::string::npos)
            throw Error(ErrorCode::Usage, std::string(option) + " needs #### in its name for the number of the frame.");
}

void resolveFarm(RenderOptions& options, const std::vector<std::string>& servers) {
    for (const std::string& server : servers) {
        options.servers.push_back(wire::parseEndpoint("--server", server));
        wire::requireSecured(options.security, options.servers.back(), "--server");
    }
    if (!options.usesServers()) {
        if (options.local || options.security.any() || options.verifyFraction || options.waitSeconds)
            throw Error(ErrorCode::Usage, std::string(options.local            ? "--local"
                                                      : options.verifyFraction ? "--verify"
                                                      : options.waitSeconds    ? "--wait"
                                                                               : "A secret or certificate") +
                                              " goes with --server or --servers-file.");
        options.local = true;
    } else if (!options.device.empty() && !options.local) {
        throw Error(ErrorCode::Usage, "--device names a device of this machine: give --local, too, to use it.");
    }
    if (options.metrics) options.metrics = wire::parseEndpoint("--metrics", *options.metrics, "127.0.0.1").text();
    if (!options.resumePath.empty() && options.checkpointPath.empty()) options.checkpointPath = options.resumePath;
    for (const std::string& path :
         {options.exrPath, options.pngPath, options.statsPath.value_or(""), options.errorMapPath.value_or("")})
        if (!path.empty() && path == options.checkpointPath)
            throw Error(ErrorCode::Usage, "--checkpoint would overwrite '" + path + "'.");
}

void resolveView(const RenderOptions& options) {
    const bool token = !options.viewTokenPath.empty();
    if (token && !options.view) throw Error(ErrorCode::Usage, "--view-token goes with --view.");
    if (options.view && !token && !wire::isLoopback(*options.view, "--view"))
        throw Error(ErrorCode::Usage,
                    "--view " + options.view->text() +
                        " can be reached by others: add --view-token FILE; only loopback goes without.");
}

void makeConsistent(RenderOptions& options, const std::vector<std::string>& servers, bool noLightPaths) {
    if (noLightPaths) leaveOutLightPaths(options.settings);
    if (options.frames && options.settings.technique == automaticTechnique)
        throw Error(ErrorCode::Usage, "--technique auto chooses for one image: name a technique for --frames.");
    if (options.targetError && !options.estimatesError)
        throw Error(ErrorCode::Usage, "--target-error needs the estimate that --no-error does without.");
    if ((options.noiseLayer || options.biasLayer || options.errorMapPath || options.denoise) && !options.estimatesError)
        throw Error(ErrorCode::Usage, std::string(options.noiseLayer     ? "--layers noise"
                                                  : options.biasLayer    ? "--layers bias"
                                                  : options.errorMapPath ? "--error-map"
                                                                         : "--denoise") +
                                          " needs the estimate that --no-error does without.");
    if (options.biasLayer && !options.errorClasses())
        throw Error(ErrorCode::Usage,
                    "--layers bias needs classes of the client's own: it does not go with --residue-classes.");
    if (options.denoise) options.settings.layers.add(denoiserLayers);
    // Behind glass guides are as noisy as the image, and a filter that follows them keeps the noise.
    options.settings.guides = options.guides.value_or(options.denoise ? Guides::FirstHit : options.settings.guides);
    if (!options.iterations && !options.seconds && !options.targetError) options.iterations = defaultIterations;
    resolveOutputPaths(options);
    resolveFarm(options, servers);
    resolveView(options);
    resolveFrames(options);
}

}  // namespace

std::optional<RenderOptions> parseRenderOptions(const std::vector<std::string>& arguments) {
    RenderOptions options;
    options.import.studio = Studio::Soft;
    std::vector<std::string> servers;
    bool noLightPaths = false;
    if (!parseCommandLine("antipode render", "Renders a scene to an OpenEXR image and a PNG.",
                          bindingTable(options, servers, noLightPaths), arguments,
                          techniqueDescriptions() + transportDescriptions() + layerDescriptions(),
                          [&] { makeConsistent(options, servers, noLightPaths); }))
        return std::nullopt;
    return options;
}

}  // namespace antipode
