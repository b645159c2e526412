#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "console.hpp"
#include "core/files.hpp"
#include "options.hpp"
#include "scene/description/scene_file.hpp"
#include "scene/run/scene_cast.hpp"

namespace lutka::cli {
namespace {

struct SceneCommandOptions {
    std::string scene;
    std::filesystem::path model;
    int count = 1;
    std::uint64_t seed = 0;
    std::string rig = "humanoid";
    std::filesystem::path out;
    bool json = false;
};

// A figure of common size, where no model says better.
constexpr vec3 kPersonLow{-0.85F, 0.0F, -0.15F};
constexpr vec3 kPersonHigh{0.85F, 1.75F, 0.15F};

scene::EntityScene sceneOf(const SceneCommandOptions& options) {
    scene::EntityScene scene;
    if (scene::isSceneFile(options.scene)) {
        scene = orLeave(scene::loadScene(options.scene));
    } else {
        scene::FigureBounds figure{kPersonLow, kPersonHigh};
        scene::LoadOptions load;
        if (options.rig == "any") load.fit.rig = physics::RigKind::any;
        if (!options.model.empty()) figure = scene::figureOf(*orLeave(scene::loadRagdoll(options.model, load))).bounds;
        scene = orLeave(scene::makeScene(options.scene, options.count, options.seed, figure));
    }
    for (scene::Ragdoll& ragdoll : scene.all<scene::Ragdoll>()) {
        if (ragdoll.model.empty()) ragdoll.model = options.model;
        if (options.rig == "any") ragdoll.rig = physics::RigKind::any;
    }
    return scene;
}

template <class T>
std::string mark(const scene::EntityScene& scene, scene::EntityId id, const char* name) {
    return scene.find<T>(id) != nullptr ? fmt::format(" {}", name) : "";
}

void print(const scene::EntityScene& scene) {
    tell("{}: {} entities, {} characters\n", scene.name, scene.entities.size(), scene.all<scene::Ragdoll>().size());
    constexpr std::size_t most = 60;
    for (std::size_t i = 0; i < std::min(scene.entities.size(), most); ++i) {
        const scene::Entity& entity = scene.entities[i];
        const vec3 at = scene::worldFromEntity(scene, entity.id).translation;
        tell("  {:>5}  {:<24} {:>7.2f} {:>7.2f} {:>7.2f} {}{}{}{}{}{}\n", entity.id, entity.name, at.x, at.y, at.z,
             mark<scene::Collider>(scene, entity.id, "collider"), mark<scene::RigidBody>(scene, entity.id, "rigidBody"),
             mark<scene::Ragdoll>(scene, entity.id, "ragdoll"), mark<scene::Light>(scene, entity.id, "light"),
             mark<scene::Camera>(scene, entity.id, "camera"),
             mark<scene::MeshRenderer>(scene, entity.id, "meshRenderer"));
    }
    if (scene.entities.size() > most) tell("  and {} more\n", scene.entities.size() - most);
}

void runScene(const SceneCommandOptions& options) {
    const scene::EntityScene scene = sceneOf(options);
    // Paths in what goes to stdout are relative to the working folder, as they are with --json.
    if (options.json || isStandardOutput(options.out)) {
        fmt::print("{}", scene::sceneToJson(scene, isStandardOutput(options.out) ? "" : options.out.parent_path()));
    } else {
        print(scene);
    }
    if (options.out.empty() || isStandardOutput(options.out)) return;
    if (!scene::isSceneFile(options.out)) {
        leave({ErrorCode::usage, fmt::format("'{}' doesn't end in .scene.json", options.out.string()), "--output",
               "scene files are known by their name"});
    }
    orLeave(scene::saveScene(options.out, scene));
}

}  // namespace

void addScene(const Command& app) {
    auto options = std::make_shared<SceneCommandOptions>();
    const Command command = app.add("scene", "Check a scene file, or write a named scene as a file");
    command.option("SCENE", options->scene, "a named scene, or a file *.scene.json").required();
    command.option("--model", options->model, "model of the characters that have none");
    addRigOption(command, options->rig);
    command.option("--count", options->count, "number of dolls of a named scene").range(1, 10000).showDefault();
    command.option("--seed", options->seed, "varies the start of a named scene; 0 stands nearly upright").showDefault();
    command.option("-o,--output", options->out, "write the scene to this file (*.scene.json); - for stdout");
    command.flag("--json", options->json, "print the scene as a document on stdout");
    command.onRun([options] { runScene(*options); });
}

}  // namespace lutka::cli
