#include "options.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <utility>

#include "animation/humanoid/roles.hpp"
#include "console.hpp"
#include "core/files.hpp"
#include "core/letter_case.hpp"
#include "interrupt.hpp"
#include "scene/asset/load_words.hpp"
#include "scene/description/scene_file.hpp"

namespace lutka::cli {
namespace {

std::vector<std::string> solverNames() {
    std::vector<std::string> names;
    names.reserve(physics::kSolvers.size());
    for (const physics::SolverEntry& entry : physics::kSolvers)
        names.emplace_back(entry.name);
    return names;
}

std::vector<std::string> presetNames() {
    std::vector<std::string> names;
    for (const physics::PresetInfo& info : physics::presetInfos())
        names.emplace_back(info.name);
    return names;
}

void addExtraBodyList(const std::string& list, physics::FitOptions& fit) {
    for (const std::string& word : splitList(list))
        orLeave(scene::addExtraBodies(word, fit));
}

// NAME or NAME@SECONDS; a name may hold '@' when what follows the last one isn't a number.
scene::ClipStart parseClipStart(const std::string& text) {
    const std::size_t at = text.rfind('@');
    if (at != std::string::npos) {
        char* end = nullptr;
        const float seconds = std::strtof(text.c_str() + at + 1, &end);
        if (end != text.c_str() + at + 1 && *end == '\0' && std::isfinite(seconds)) {
            return {text.substr(0, at), seconds};
        }
    }
    return {text, 0.0F};
}

// The numbers of a comma-separated list; empty where something else stands there.
std::vector<float> numbersOf(const std::string& text) {
    std::vector<float> numbers;
    const char* at = text.c_str();
    while (true) {
        char* end = nullptr;
        numbers.push_back(std::strtof(at, &end));
        if (end == at || !std::isfinite(numbers.back())) return {};
        if (*end == '\0') return numbers;
        if (*end != ',') return {};
        at = end + 1;
    }
}

// Which way a hit goes, as the figure faces, by a word or as X,Y,Z of any length.
std::optional<vec3> directionOf(const std::string& text) {
    constexpr std::pair<std::string_view, vec3> words[] = {{"ahead", {0, 0, 1}}, {"back", {0, 0, -1}},
                                                           {"left", {1, 0, 0}},  {"right", {-1, 0, 0}},
                                                           {"up", {0, 1, 0}},    {"down", {0, -1, 0}}};
    for (const auto& [word, direction] : words)
        if (text == word) return direction;
    const std::vector<float> numbers = numbersOf(text);
    if (numbers.size() != 3) return std::nullopt;
    const vec3 given(numbers[0], numbers[1], numbers[2]);
    if (glm::length(given) < 1e-6F) return std::nullopt;
    return glm::normalize(given);
}

// What stands behind BODY@SECONDS: NS, from ahead, NS:DIRECTION or X,Y,Z.
std::optional<vec3> impulseOf(const std::string& text) {
    const std::size_t colon = text.find(':');
    const std::vector<float> numbers = numbersOf(text.substr(0, colon));
    if (colon == std::string::npos && numbers.size() == 3) return vec3(numbers[0], numbers[1], numbers[2]);
    if (numbers.size() != 1) return std::nullopt;
    const auto direction = colon == std::string::npos ? vec3(0, 0, -1) : directionOf(text.substr(colon + 1));
    return direction ? std::optional(numbers[0] * *direction) : std::nullopt;
}

// BODY@SECONDS:IMPULSE; a body's name may hold both signs.
scene::PuppetHit parseHit(const std::string& text) {
    const std::size_t at = text.rfind('@');
    const std::size_t colon = at == std::string::npos ? at : text.find(':', at);
    if (colon != std::string::npos && at > 0) {
        const std::vector<float> seconds = numbersOf(text.substr(at + 1, colon - at - 1));
        const std::optional<vec3> impulse = impulseOf(text.substr(colon + 1));
        if (seconds.size() == 1 && seconds[0] >= 0.0F && impulse) return {text.substr(0, at), seconds[0], *impulse};
    }
    leave({ErrorCode::usage, fmt::format("'{}' is no hit", text), "--hit",
           "give a body, a moment, an impulse in N s and, if not from ahead, which way it goes (ahead, back, left, "
           "right, up, down or X,Y,Z): head@1.5:5, head@1.5:5:left or leftLowerArm@0.5:10:0,1,1"});
}

// PART or PART:WEIGHT.
scene::LedPart parseLed(const std::string& text) {
    const std::size_t colon = text.rfind(':');
    if (colon == std::string::npos) return {text, 1.0F};
    const std::vector<float> weight = numbersOf(text.substr(colon + 1));
    if (weight.size() == 1 && weight[0] >= 0.0F && weight[0] <= 1.0F) return {text.substr(0, colon), weight[0]};
    leave({ErrorCode::usage, fmt::format("'{}' is no part with a weight", text), "--kinematic",
           "give a weight from 0 to 1, as leg or leg:0.5"});
}

}  // namespace

void leave(const Error& error) {
    leaveIfInterrupted();  // what was cut off by a signal fails because of it
    spdlog::error("{}", error.text());
    throw Exit{static_cast<int>(error.code)};
}

void ModelOptions::addTo(const Command& app, bool required) {
    app.option("MODEL", model, "rigged character in any format that Assimp reads").required(required);
    app.option("--scale", scale, "metres a file unit, instead of what the file or the figure's height says")
        .range(1e-6, 1e6);
    app.option("--up", up, "the file's up axis: x, y, z, -x, -y or -z")
        .oneOf(scene::wordsOf(scene::kUpAxisWords), true);
    app.option("--figure", figure, "which figure of a file with several, counted from 1; default: the largest")
        .range(1, 10000);
    const Option memory = app.option("--import-memory", importMemoryMiB, "MiB that reading the model may take")
                              .range(64, 1 << 20)
                              .showDefault();
    app.flag("--allow-outside", allowOutside,
             "take pictures, buffers and material files from outside of the model's folder, too");
    app.flag("--in-process", inProcess, "read the model in this process, without limits: for files that you trust")
        .excludes(memory);
}

animation::ImportOptions ModelOptions::import() const {
    animation::ImportOptions options;
    options.metresPerFileUnit = scale;
    if (!up.empty()) options.up = scene::meaningOf(scene::kUpAxisWords, lowerCased(up));
    options.figure = figure;
    options.loadTextures = textures;
    options.allowOutside = allowOutside;
    std::error_code failed;
    if (!inProcess) options.worker.program = std::filesystem::read_symlink("/proc/self/exe", failed);
    options.worker.memoryBytes = static_cast<std::size_t>(importMemoryMiB) << 20U;
    options.worker.stop = interrupted;
    options.worker.printed = [](const std::string& line) { spdlog::info("{}", line); };
    options.stdoutAside = true;
    return options;
}

void RagdollOptions::addTo(const Command& app, bool modelRequired) {
    model.addTo(app, modelRequired);
    const Option profileOption =
        app.option("--profile", profile, "ragdoll profile (*.ragdoll.json) instead of a fitted one");
    app.flag("--keep-shapes", keepShapes,
             "with the profile of another rig: keep its shapes instead of fitting them anew")
        .needs(profileOption);
    app.flag("--refit", refit, "fit anew although the model's own file brings a ragdoll along (glTF)")
        .excludes(profileOption);
    addRigOption(app, rig).excludes(profileOption);
    app.option("--max-bodies", maxBodies, "the most bodies of --rig any, and of what --bodies hangs on a humanoid")
        .range(1, physics::RagdollProfile::kMostBodies)
        .excludes(profileOption)
        .showDefault();
    app.option("--shapes", shapes,
               "the most shapes of a body: with 2 or 3 a trunk or head that one covers badly gets several")
        .range(1, 1 + static_cast<int>(physics::BodyShape::kMostAdded))
        .excludes(profileOption)
        .showDefault();
    app.flag("--hulls", hulls, "every body is the convex hull of its skin").excludes(profileOption);
    app.option("--mass", massKg, "total mass in kilograms; default: 75, and for --rig any that of its volume in water")
        .range(1e-3, 1e5)
        .excludes(profileOption);
    app.option("--mass-table", massTable, "shares of the segments")
        .oneOf(scene::wordsOf(scene::kMassTableWords))
        .excludes(profileOption)
        .showDefault();
    app.option("--masses", massPreset, "how the total is split")
        .oneOf(scene::wordsOf(scene::kMassPresetWords))
        .excludes(profileOption)
        .showDefault();
    app.option("--preset", preset, "character of the joints: their limits, friction and masses")
        .oneOf(presetNames())
        .excludes(profileOption)
        .showDefault();
    app.option(
           "--bodies", bodies,
           "bodies beside the 16, comma separated: shoulders,neck,toes,trunk; tail,ears,hair,cape,skirt,wings,weapon,"
           "other, or appendages for all of these")
        .excludes(profileOption);
}

scene::LoadOptions RagdollOptions::load() const {
    scene::LoadOptions options;
    options.import = model.import();
    options.profile = profile;
    options.keepShapes = keepShapes;
    options.refit = refit;
    if (rig == "any") options.fit.rig = physics::RigKind::any;
    options.fit.mostBodies = maxBodies;
    options.fit.mostShapes = shapes;
    options.fit.hulls = hulls;
    options.fit.weighByVolume = !massKg;
    options.fit.totalMassKg = massKg.value_or(options.fit.totalMassKg);
    // oneOf() lets no other words through.
    options.fit.massTable = scene::meaningOf(scene::kMassTableWords, massTable).value_or(options.fit.massTable);
    options.fit.massPreset = scene::meaningOf(scene::kMassPresetWords, massPreset).value_or(options.fit.massPreset);
    options.fit.preset = scene::presetNamed(preset).value_or(options.fit.preset);
    addExtraBodyList(bodies, options.fit);
    return options;
}

void SceneOptions::addTo(const Command& app) {
    std::string scenes;
    for (const scene::ScenarioInfo& info : scene::scenarioRegistry()) {
        scenes += fmt::format("{}{}", scenes.empty() ? "" : ", ", info.name);
    }
    app.option("--scene", scene, "one of " + scenes + ", or a file *.scene.json").showDefault();
    app.option("--count", count, "number of dolls in a named scene; default: 1").range(1, 10000);
    app.option("--seed", seed, "varies the start of a named scene; 0, the default, stands nearly upright")
        .check([](const std::string& text) {
            const bool digits =
                !text.empty() && text.size() < 19 && text.find_first_not_of("0123456789") == std::string::npos;
            return digits ? std::string() : fmt::format("'{}' is no whole number from 0 up", text);
        });
    app.option("--threads", threads, "threads to step with; default: the scene's, or 1").range(1, 256);
    app.option("--solver", solver,
               "stock: plain Bullet; bullet: Bullet tuned for ragdolls; crowd: dolls in SIMD lanes, the default")
        .oneOf(solverNames());
}

bool SceneOptions::takeFile(std::filesystem::path& model) {
    if (scene::isSceneFile(model)) {
        if (scene::isSceneFile(scene)) {
            leave({ErrorCode::usage, "two scene files were given", model.string(), "give one of them"});
        }
        scene = std::exchange(model, {}).string();
    }
    if (!scene::isSceneFile(scene)) return false;
    if (count || seed) {
        leave({ErrorCode::usage, "a scene file has its own characters and start", count ? "--count" : "--seed",
               "leave the option out; it belongs to the named scenes"});
    }
    return true;
}

void SceneOptions::applyTo(physics::WorldSettings& world) const {
    if (threads) world.threads = *threads;
    if (solver) world.solver = solverFromName(*solver);
}

void SimulateOptions::addTo(const Command& app) {
    ragdoll.addTo(app, false);
    app.find("MODEL").describe("rigged character; none when the scene file names its characters");
    scene.addTo(app);
    const Option clipOption = addStart(app);
    const Option getUpFlag = addPuppet(app, clipOption);
    const Option shedOption =
        app.option("--shed", shed,
                   "spare dolls far from the eye, from so many metres on: lod@10,apart@15,slow@20,frozen@40 or some");
    app.option("--eye", eye,
               "X,Y,Z in metres, where --shed measures from; default: the camera of a picture, else the scene's middle")
        .commaSeparated(3)
        .needs(shedOption);
    shedOption.excludes(clipOption).excludes(getUpFlag);
    addOutputs(app, clipOption);
}

Option SimulateOptions::addStart(const Command& app) {
    app.option("--seconds", seconds, "length of the run; default: what the scene needs").range(0.0, 3600.0);
    app.option("--hold", hold,
               "hold bodies where they start, by their names, comma separated: leftHand,head; with --rig any as "
               "`lutka build` lists them")
        .commaSeparated();
    app.option("--pose", pose, "the pose to start in: the bind pose, the default, or the file's node pose")
        .oneOf({"bind", "node"});
    const Option fromClipOption =
        app.option("--from-clip", fromClip, "start from a clip's pose and velocities: NAME or #NUMBER, with @SECONDS");
    const Option clipOption =
        app.option("--clip", clip,
                   "play a clip instead of falling, from its start or a moment: NAME or #NUMBER, with @SECONDS")
            .excludes(fromClipOption);
    app.option("--clip-speed", clipSpeed, "clip seconds a second; negative: backwards")
        .range(-100.0, 100.0)
        .needs(clipOption);
    app.flag("--once", clipOnce, "the clip stays at its end instead of beginning anew").needs(clipOption);
    app.flag("--in-place", clipInPlace, "the clip without its way over the ground").needs(clipOption);
    return clipOption;
}

Option SimulateOptions::addPuppet(const Command& app, const Option& clipOption) {
    const Option puppetOption =
        app.option(
               "--puppet", puppet,
               "follow the clip with muscles instead of playing it: limp, weak, powered or stiff; profile: those of "
               "the ragdoll profile, powered where it has none")
            .oneOf({"limp", "weak", "powered", "stiff", "profile"})
            .needs(clipOption);
    app.option("--strength", strength, "factor on the muscles' strength").range(0.0, 1e6).needs(puppetOption);
    app.flag("--carry-gravity", carriesGravity, "joints carry what hangs on them instead of sagging")
        .needs(puppetOption);
    app.option("--pin", pinForceN, "newtons that hold the hips to the clip at most; 0: it stands or falls")
        .range(0.0, 1e6)
        .needs(puppetOption);
    app.option("--kinematic", kinematic,
               "bodies that follow the clip themselves, whatever acts on them: names, trunk, head, arm, leg or all; "
               "NAME:WEIGHT below 1 draws them there")
        .commaSeparated(0)
        .needs(puppetOption);
    app.option("--hit", hits,
               "push a body: BODY@SECONDS:NS[:DIRECTION], which way it goes as ahead, back (default), left, right, up, "
               "down or "
               "X,Y,Z with +Z ahead; or BODY@SECONDS:X,Y,Z in N s; may be repeated")
        .oneValueEach()
        .needs(puppetOption);
    return app.flag("--getup", getUp, "limp dolls that have come to rest get up; without --puppet they fall first");
}

void SimulateOptions::addOutputs(const Command& app, const Option& clipOption) {
    const Option outOption =
        app.option("--out", bakedOut,
                   "write the first doll's fall: an animation of its skin (.glb), or its joints' motion (.bvh)");
    const Option meshOption = app.option("--mesh-out", meshOut, "write the first doll's skin of the last frame (.obj)");
    const Option eachFlag =
        app.flag("--each", each, "--out and --mesh-out of every doll, as NAME_0001.glb, NAME_0002.glb …");
    app.flag("--together", together, "--out (.glb) holds every doll; their skins share their meshes")
        .needs(outOption)
        .excludes(eachFlag);
    app.flag("--no-reduce", allKeys,
             "--out keeps every key; else those are left out without which no joint is off by 0.1 mm or 0.05 degrees")
        .needs(outOption);
    app.flag("--mesh-sequence", meshSequence, "--mesh-out of every frame, as NAME_0000.obj, NAME_0001.obj …")
        .needs(meshOption);
    const Option reportOption = app.option("--report", report, "write the figures of the run (.json)");
    const Option recordOption =
        app.option("--record", recordTo,
                   "write the bodies of every step; to *.inputs.json: what the run was made of, with hashes");
    const Option jsonFlag = app.flag("--json", json, "print the report as JSON on stdout");
    // A replay measures nothing, so it has no report.
    app.option("--replay", replayFrom, "play a recording; of inputs: simulate again and tell the first difference")
        .excludes(recordOption)
        .excludes(reportOption)
        .excludes(clipOption)
        .excludes(jsonFlag);
}

scene::PuppetPlay SimulateOptions::puppetPlay() const {
    scene::PuppetPlay play;
    if (!clip.empty()) play.start = parseClipStart(clip);
    play.clipOfUser = !clip.empty();
    play.borrows = getUp;
    play.ownMuscles = puppet.empty() || puppet == "profile";
    const std::string_view muscles = play.ownMuscles ? "powered" : std::string_view(puppet);
    const auto preset = std::find(physics::kMusclePresetNames.begin(), physics::kMusclePresetNames.end(), muscles);
    play.puppet.muscles =
        physics::musclesOf(static_cast<physics::MusclePreset>(preset - physics::kMusclePresetNames.begin()));
    play.puppet.muscles.strength = strength;
    play.carriesGravity = carriesGravity;
    play.pinForceN = pinForceN;
    for (const std::string& part : kinematic)
        play.led.push_back(parseLed(part));
    play.getUp = getUp;
    play.limp = puppet.empty();
    for (const std::string& hit : hits)
        play.hits.push_back(parseHit(hit));
    return play;
}

scene::SimulationOptions SimulateOptions::simulation(const scene::EntityScene& entities) const {
    scene::SimulationOptions options = scene::simulationOptionsOf(entities);
    scene.applyTo(options.world);
    if (pose == "node") options.pose = scene::StartPose::node;
    if (!fromClip.empty()) options.fromClip = parseClipStart(fromClip);
    if (!puppet.empty() || getUp)
        options.puppet = puppetPlay();
    else if (!clip.empty())
        options.play = scene::ClipPlay{parseClipStart(clip), clipSpeed, !clipOnce, clipInPlace};
    if (options.play) options.puppet.reset();
    options.shed = orLeave(scene::parseShedSettings(shed));
    if (options.shed.any() && options.puppet) {
        leave({ErrorCode::usage, "dolls with muscles can't be spared", "--shed",
               "leave it out, or take a scene whose characters fall"});
    }
    if (!eye.empty()) options.eye = vec3(eye[0], eye[1], eye[2]);
    return options;
}

bool SimulateOptions::fillsStandardOutput() const {
    return isStandardOutput(bakedOut) || isStandardOutput(meshOut) || isStandardOutput(report) ||
           isStandardOutput(recordTo);
}

Option addRigOption(const Command& app, std::string& rig) {
    return app
        .option("--rig", rig,
                "humanoid: bodies by the parts of a human; any: a ragdoll of any skeleton by its topology")
        .oneOf({"humanoid", "any"})
        .showDefault();
}

void addSolverOption(const Command& app, std::string& solver) {
    app.option("--solver", solver, "stock: plain Bullet; bullet: Bullet tuned for ragdolls; crowd: dolls in SIMD lanes")
        .oneOf(solverNames())
        .showDefault();
}

physics::SolverKind solverFromName(const std::string& name) {
    return physics::solverNamed(name).value_or(physics::WorldSettings{}.solver);  // oneOf() let no other pass
}

render::Extent parseSize(const std::string& text) {
    constexpr int kLeast = 16;
    constexpr int kMost = 16384;
    int width = 0;
    int height = 0;
    char rest = 0;
    const bool whole = std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) == 2;
    if (!whole || std::min(width, height) < kLeast || std::max(width, height) > kMost) {
        leave({ErrorCode::usage, fmt::format("'{}' is not a size", text), "--size",
               fmt::format("give WIDTHxHEIGHT with both from {} to {}", kLeast, kMost)});
    }
    return {width, height};
}

std::unique_ptr<scene::RagdollAsset> loadAsset(const RagdollOptions& options) {
    const Stopwatch stopwatch("reading and fitting " + options.model.model.string());
    auto asset = orLeave(scene::loadRagdoll(options.model.model, options.load()));
    spdlog::debug("{} joints, {} meshes, {} bodies, {:.2f} m tall", asset->character.skeleton.jointCount(),
                  asset->character.meshes.size(), asset->profile.bodies.size(), asset->profile.heightM);
    return asset;
}

}  // namespace lutka::cli
