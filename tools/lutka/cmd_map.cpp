#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "core/files.hpp"
#include "options.hpp"

namespace lutka::cli {
namespace {

using animation::Character;
using animation::HumanoidMap;
using Json = nlohmann::ordered_json;

struct Options {
    ModelOptions model;
    std::filesystem::path out;
    bool json = false;
    bool ignoreNames = false;
};

Json mapJson(const Character& character, const HumanoidMap& map) {
    Json roles = Json::object();
    Json missing = Json::array();
    for (int index = 0; index < animation::kRoleCount; ++index) {
        const auto& binding = map.roles[index];
        if (!binding) continue;
        roles[std::string(animation::roleName(animation::roleAt(index)))] = {
            {"joint", character.skeleton.names[binding->joint]},
            {"path", animation::jointPath(character.skeleton, binding->joint)},
            {"confidence", binding->confidence},
            {"reason", binding->reason}};
    }
    for (const animation::Role role : map.missing)
        missing.push_back(animation::roleName(role));
    Json json;
    json["model"] = character.file.string();
    json["humanoid"] = map.humanoid;
    json["confidence"] = map.confidence;
    json["roles"] = std::move(roles);
    json["missing"] = std::move(missing);
    json["warnings"] = map.warnings;
    return json;
}

// The document of a file that could not even be loaded: the same keys, so that a reader needs one path.
Json refusalJson(const std::filesystem::path& model, const Error& error) {
    return {{"model", model.string()}, {"humanoid", false},        {"confidence", 0.0},
            {"roles", Json::object()}, {"missing", Json::array()}, {"warnings", {error.text()}}};
}

// Names in files are bytes of any encoding: what is not UTF-8 is replaced rather than thrown at the user.
std::string dump(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void printTable(const Character& character, const HumanoidMap& map) {
    fmt::print("{:<15} {:<28} {:>5}  {}\n", "ROLE", "JOINT", "SURE", "WHY");
    for (int index = 0; index < animation::kRoleCount; ++index) {
        const animation::Role role = animation::roleAt(index);
        const auto& binding = map.roles[index];
        if (binding) {
            fmt::print("{:<15} {:<28} {:>4.0f}%  {}\n", animation::roleName(role),
                       character.skeleton.names[binding->joint], binding->confidence * 100.0F, binding->reason);
        } else if (animation::isRequired(role)) {
            fmt::print("{:<15} {:<28}        required, not found\n", animation::roleName(role), "-");
        }
    }
    fmt::print("a humanoid, {:.0f}% sure of the whole\n", map.confidence * 100.0F);
}

void run(const Options& options) {
    auto character = animation::importCharacter(options.model.model, options.model.import());
    if (!character) {
        if (options.json) fmt::print("{}", dump(refusalJson(options.model.model, character.error())));
        leave(character.error());
    }
    animation::MapOptions mapOptions;
    mapOptions.useNames = !options.ignoreNames;
    const HumanoidMap map = animation::mapHumanoid(character.value(), mapOptions);
    const Json json = mapJson(character.value(), map);
    if (!options.out.empty() && map.humanoid) orLeave(writeFileAtomically(options.out, dump(json)));
    const bool printed = isStandardOutput(options.out);
    if (options.json && !(printed && map.humanoid)) fmt::print("{}", dump(json));
    if (!map.humanoid) {
        leave({ErrorCode::input, map.warnings.empty() ? "not a humanoid" : map.warnings.front(),
               options.model.model.string(), ""});
    }
    if (!options.json && !printed) {
        printWarnings(character.value());
        printWarnings(map);
        printTable(character.value(), map);
    }
}

}  // namespace

void addMap(const Command& app) {
    auto options = std::make_shared<Options>();
    const Command command = app.add("map", "Bind the joints to body parts: role, joint, confidence and reason");
    options->model.addTo(command);
    command.option("-o,--output", options->out, "write the map as JSON; - for stdout");
    command.flag("--json", options->json, "print the map as JSON on stdout");
    command.flag("--ignore-names", options->ignoreNames, "map by topology, geometry and weights alone");
    command.onRun([options] { run(*options); });
}

}  // namespace lutka::cli
