#include <fmt/format.h>

#include <array>
#include <memory>
#include <nlohmann/json.hpp>

#include "animation/segments/appendages.hpp"
#include "animation/segments/segment_rig.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "core/files.hpp"
#include "options.hpp"
#include "outputs.hpp"

namespace lutka::cli {
namespace {

using animation::Character;
using animation::HumanoidMap;
using Json = nlohmann::ordered_json;

struct MapCommandOptions {
    ModelOptions model;
    std::filesystem::path out;
    bool json = false;
    bool ignoreNames = false;
    std::string rig = "humanoid";
};

Json appendagesJson(const Character& character, const HumanoidMap& map) {
    Json all = Json::array();
    for (const animation::Appendage& appendage : animation::findAppendages(character, map)) {
        all.push_back({{"kind", animation::appendageName(appendage.kind)},
                       {"joint", character.skeleton.names[appendage.joint]},
                       {"path", animation::jointPath(character.skeleton, appendage.joint)},
                       {"joints", appendage.joints},
                       {"on", animation::roleName(appendage.role)}});
    }
    return all;
}

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
    json["appendages"] = appendagesJson(character, map);
    return json;
}

std::string_view kindName(animation::Segment::Kind kind) {
    static constexpr std::array<std::string_view, 5> kNames{"trunk", "chain", "limbRoot", "limb", "held"};
    return kNames[static_cast<std::size_t>(kind)];
}

std::string_view sideName(animation::Side side) {
    static constexpr std::array<std::string_view, 3> kNames{"center", "left", "right"};
    return kNames[static_cast<std::size_t>(side)];
}

Json segmentsJson(const Character& character, const animation::SegmentedRig& rig) {
    Json all = Json::array();
    const auto named = [&](int segment) { return segment < 0 ? Json() : Json(rig.segments[segment].name); };
    for (const animation::Segment& segment : rig.segments) {
        Json hinge;
        if (const auto& h = segment.hinge)
            hinge = {{"axis", {h->axis.x, h->axis.y, h->axis.z}}, {"low", h->low}, {"high", h->high}};
        all.push_back({{"name", segment.name},
                       {"joint", character.skeleton.names[segment.joint]},
                       {"path", animation::jointPath(character.skeleton, segment.joint)},
                       {"parent", named(segment.parent)},
                       {"kind", kindName(segment.kind)},
                       {"side", sideName(segment.side)},
                       {"mirror", named(segment.mirror)},
                       {"hinge", std::move(hinge)}});
    }
    return {{"model", character.file.string()}, {"segments", std::move(all)}, {"warnings", rig.warnings}};
}

void printSegments(const animation::SegmentedRig& rig) {
    tell("{:<28} {:<28} {:<9} {:<7} {}\n", "SEGMENT", "ON", "KIND", "SIDE", "HINGE");
    for (const animation::Segment& segment : rig.segments) {
        const std::string hinge =
            segment.hinge ? fmt::format("{:.0f}..{:.0f}", degrees(segment.hinge->low), degrees(segment.hinge->high))
                          : "";
        tell("{:<28} {:<28} {:<9} {:<7} {}\n", segment.name,
             segment.parent < 0 ? "-" : rig.segments[segment.parent].name, kindName(segment.kind),
             sideName(segment.side), hinge);
    }
    tell("{} segments\n", rig.segments.size());
}

// The document of a file that could not even be loaded: the same keys, so that a reader needs one path.
Json refusalJson(const std::filesystem::path& model, const Error& error) {
    return {{"model", model.string()},    {"humanoid", false},        {"confidence", 0.0},
            {"roles", Json::object()},    {"missing", Json::array()}, {"warnings", {error.text()}},
            {"appendages", Json::array()}};
}

// Names in files are bytes of any encoding: what is not UTF-8 is replaced rather than thrown at the user.
std::string dump(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void printTable(const Character& character, const HumanoidMap& map) {
    tell("{:<15} {:<28} {:>5}  {}\n", "ROLE", "JOINT", "SURE", "WHY");
    for (int index = 0; index < animation::kRoleCount; ++index) {
        const animation::Role role = animation::roleAt(index);
        const auto& binding = map.roles[index];
        if (binding) {
            tell("{:<15} {:<28} {:>4.0f}%  {}\n", animation::roleName(role), character.skeleton.names[binding->joint],
                 binding->confidence * 100.0F, binding->reason);
        } else if (animation::isRequired(role)) {
            tell("{:<15} {:<28}        required, not found\n", animation::roleName(role), "-");
        }
    }
    tell("a humanoid, {:.0f}% sure of the whole\n", map.confidence * 100.0F);
    const auto appendages = animation::findAppendages(character, map);
    if (appendages.empty()) return;
    tell("\n{:<15} {:<28} {:>6}  {}\n", "APPENDAGE", "JOINT", "JOINTS", "ON");
    for (const animation::Appendage& appendage : appendages) {
        tell("{:<15} {:<28} {:>6}  {}\n", animation::appendageName(appendage.kind),
             character.skeleton.names[appendage.joint], appendage.joints, animation::roleName(appendage.role));
    }
    tell("bodies for them: --bodies with the words of the first column\n");
}

void runAnyRig(const MapCommandOptions& options, const Character& character) {
    const animation::SegmentedRig rig = animation::segmentRig(character);
    const Json json = segmentsJson(character, rig);
    if (!options.out.empty()) orLeave(writeFileAtomically(options.out, dump(json)));
    if (isStandardOutput(options.out)) return;
    if (options.json) {
        fmt::print("{}", dump(json));
    } else {
        printWarnings(character);
        printSegments(rig);
    }
}

void runMap(const MapCommandOptions& options) {
    keepInputs(options.out, {options.model.model});
    auto character = animation::importCharacter(options.model.model, options.model.import());
    if (!character) {
        if (options.json) fmt::print("{}", dump(refusalJson(options.model.model, character.error())));
        leave(character.error());
    }
    if (options.rig == "any") return runAnyRig(options, character.value());
    animation::MapOptions mapOptions;
    mapOptions.useNames = !options.ignoreNames;
    const HumanoidMap map = animation::mapHumanoid(character.value(), mapOptions);
    const Json json = mapJson(character.value(), map);
    if (!options.out.empty() && map.humanoid) orLeave(writeFileAtomically(options.out, dump(json)));
    const bool printed = isStandardOutput(options.out);
    if (options.json && !(printed && map.humanoid)) fmt::print("{}", dump(json));
    if (!map.humanoid) {
        leave({ErrorCode::input, map.warnings.empty() ? "not a humanoid" : map.warnings.front(),
               options.model.model.string(), "with `--rig any` this and the other commands take any skeleton"});
    }
    if (!options.json && !printed) {
        printWarnings(character.value());
        printWarnings(map);
        printTable(character.value(), map);
    }
}

}  // namespace

void addMap(const Command& app) {
    auto options = std::make_shared<MapCommandOptions>();
    const Command command = app.add("map", "Bind the joints to body parts: role, joint, confidence and reason");
    options->model.addTo(command);
    command.option("-o,--output", options->out, "write the map as JSON; - for stdout");
    command.flag("--json", options->json, "print the map as JSON on stdout");
    command.flag("--ignore-names", options->ignoreNames, "map by topology, geometry and weights alone");
    addRigOption(command, options->rig);
    command.onRun([options] { runMap(*options); });
}

}  // namespace lutka::cli
