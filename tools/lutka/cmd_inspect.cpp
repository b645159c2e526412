#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "animation/clip_reference.hpp"
#include "animation/joint_paths.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "options.hpp"

namespace lutka::cli {
namespace {

using animation::Character;
using animation::Skeleton;
using Json = nlohmann::ordered_json;

struct InspectCommandOptions {
    ModelOptions model;
    bool json = false;
};

Json vecJson(const vec3& v) {
    return {v.x, v.y, v.z};
}

Json figuresJson(const Character& character) {
    Json figures = Json::array();
    for (std::size_t i = 0; i < character.figures.size(); ++i) {
        const animation::FigureInfo& figure = character.figures[i];
        figures.push_back({{"name", figure.name},
                           {"joints", figure.joints.size()},
                           {"vertices", figure.vertices},
                           {"taken", static_cast<int>(i) == character.figure}});
    }
    return figures;
}

// A file with one figure has nothing to choose.
void printFigures(const Character& character) {
    if (character.figures.size() < 2) return;
    tell("figures    {}: --figure N takes another\n", character.figures.size());
    for (std::size_t i = 0; i < character.figures.size(); ++i) {
        const animation::FigureInfo& figure = character.figures[i];
        tell("  {:>3} {:<44} {:>7} vertices {:>7} joints{}\n", i + 1, figure.name, figure.vertices,
             figure.joints.size(), static_cast<int>(i) == character.figure ? ", taken" : "");
    }
}

Json inspectJson(const Character& character) {
    const Skeleton& skeleton = character.skeleton;
    Json json;
    json["model"] = character.file.string();
    json["units"] = {{"metresPerFileUnit", character.units.metresPerFileUnit},
                     {"source", character.units.unitSource},
                     {"up", character.units.upAxis},
                     {"upSource", character.units.upSource}};
    json["figures"] = figuresJson(character);
    json["joints"] = Json::array();
    const std::vector<std::string> paths = animation::jointPaths(skeleton);
    for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
        json["joints"].push_back({{"name", skeleton.names[joint]},
                                  {"path", paths[joint]},
                                  {"parent", skeleton.parents[joint]},
                                  {"bindPosition", vecJson(skeleton.bindModelFromJoint[joint].translation)},
                                  {"skinWeight", skeleton.skinWeight[joint]}});
    }
    json["meshes"] = Json::array();
    for (const animation::SkinnedMesh& mesh : character.meshes) {
        json["meshes"].push_back({{"name", mesh.name},
                                  {"vertices", mesh.positions.size()},
                                  {"triangles", mesh.indices.size() / 3},
                                  {"skinned", !mesh.rigid},
                                  {"material", mesh.material}});
    }
    json["clips"] = Json::array();
    for (const animation::Clip& clip : character.clips) {
        json["clips"].push_back({{"name", clip.name}, {"seconds", clip.seconds()}, {"frames", clip.frameCount}});
    }
    json["materials"] = Json::array();
    for (const animation::Material& material : character.materials)
        json["materials"].push_back(material.name);
    json["textures"] = Json::array();
    for (const animation::Texture& texture : character.textures) {
        json["textures"].push_back({{"name", texture.name}, {"width", texture.width}, {"height", texture.height}});
    }
    json["warnings"] = character.warnings;
    return json;
}

void printTree(const Skeleton& skeleton, const std::vector<std::vector<int>>& children, int joint, int depth) {
    const vec3& p = skeleton.bindModelFromJoint[joint].translation;
    tell("  {:{}}{:<{}} {:8.3f} {:8.3f} {:8.3f} {:9.1f}\n", "", depth * 2, skeleton.names[joint],
         std::max(1, 48 - depth * 2), p.x, p.y, p.z, skeleton.skinWeight[joint]);
    for (const int child : children[joint])
        printTree(skeleton, children, child, depth + 1);
}

void printText(const Character& character) {
    const Skeleton& skeleton = character.skeleton;
    tell("{}\n", character.file.string());
    tell("units      1 file unit = {} m ({}), up {} ({})\n", character.units.metresPerFileUnit,
         character.units.unitSource, character.units.upAxis, character.units.upSource);
    printFigures(character);
    tell("joints     {}: bind position in metres, and the skin weight each carries in vertices\n",
         skeleton.jointCount());
    const auto children = animation::childrenOf(skeleton);
    for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
        if (skeleton.parents[joint] == animation::kNoJoint) printTree(skeleton, children, joint, 0);
    }
    tell("meshes     {}\n", character.meshes.size());
    for (const animation::SkinnedMesh& mesh : character.meshes) {
        tell("  {:<48} {:>7} vertices {:>7} triangles{}\n", mesh.name, mesh.positions.size(), mesh.indices.size() / 3,
             mesh.rigid ? ", rigid" : "");
    }
    tell("clips      {}\n", character.clips.size());
    for (std::size_t i = 0; i < character.clips.size(); ++i) {
        const animation::Clip& clip = character.clips[i];
        tell("  #{:<4} {:<42} {:7.2f} s, {} frames\n", i + 1, clip.name, clip.seconds(), clip.frameCount);
    }
    tell("materials  {}, textures {}\n", character.materials.size(), character.textures.size());
    if (!character.warnings.empty()) tell("repaired or noticed\n");
    for (const std::string& warning : character.warnings)
        tell("  {}\n", warning);
}

void runInspect(const InspectCommandOptions& options) {
    const Character character = orLeave(animation::importCharacter(options.model.model, options.model.import()));
    if (options.json) {
        fmt::print("{}\n", inspectJson(character).dump(2, ' ', false, Json::error_handler_t::replace));
    } else {
        printText(character);
    }
}

}  // namespace

void addInspect(const Command& app) {
    auto options = std::make_shared<InspectCommandOptions>();
    const Command command = app.add("inspect", "Show the skeleton, meshes, clips, units and what was repaired");
    options->model.addTo(command);
    options->model.textures = true;
    command.flag("--json", options->json, "print it as JSON on stdout");
    command.onRun([options] { runInspect(*options); });
}

}  // namespace lutka::cli
