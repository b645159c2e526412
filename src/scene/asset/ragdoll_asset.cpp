#include "scene/asset/ragdoll_asset.hpp"

#include <algorithm>
#include <vector>

#include "animation/segments/segment_rig.hpp"
#include "core/aabb.hpp"
#include "core/assert.hpp"
#include "export/read_gltf_physics.hpp"
#include "physics/fit/rebind.hpp"
#include "physics/profile/profile_io.hpp"

namespace lutka::scene {
namespace {

constexpr const char* kNotHumanoidMend =
    "`lutka inspect` shows the joint tree; a humanoid has a trunk, two arms and two legs. `--rig any`, in scenes and "
    "lists \"rig\": \"any\", makes a ragdoll of any skeleton";

Error notHumanoid(const animation::Character& character, const animation::HumanoidMap& map) {
    const std::string reason = map.warnings.empty() ? "not a humanoid" : map.warnings.front();
    return {ErrorCode::input, reason, character.file.string(), kNotHumanoidMend};
}

// Index of the figure whose joints the profile's bodies are bound to; that of `character` where none is plainly so.
int figureOf(const physics::RagdollProfile& profile, const animation::Character& character) {
    std::vector<std::size_t> bodies(character.figures.size(), 0);
    for (const physics::BodyProfile& body : profile.bodies) {
        const int joint = animation::findJoint(character.skeleton, body.jointPath);
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            const std::vector<int>& own = character.figures[i].joints;
            if (std::binary_search(own.begin(), own.end(), joint)) ++bodies[i];
        }
    }
    const auto most = std::max_element(bodies.begin(), bodies.end());
    const bool sure = most != bodies.end() && 2 * *most > profile.bodies.size();
    return sure ? static_cast<int>(most - bodies.begin()) : character.figure;
}

// The joints of a file's other figures are in the skeleton, too: a profile of one of them is another rig's.
Result<physics::BoundProfile> bindToFigure(physics::RagdollProfile profile, const RagdollAsset& asset,
                                           bool keepShapes) {
    if (figureOf(profile, asset.character) == asset.character.figure)
        return physics::bindOrRebind(std::move(profile), asset.character, asset.map, keepShapes);
    auto rebound = physics::rebindProfile(profile, asset.character, asset.map, keepShapes);
    if (!rebound) return rebound.error();
    return physics::BoundProfile{std::move(rebound).value(), true};
}

// What is left of a map where nothing is asked about roles.
animation::HumanoidMap mapOfAny(const animation::Character& character, const physics::FitOptions& fit) {
    animation::SegmentedRig rig = animation::segmentRig(character, {fit.mostBodies});
    animation::HumanoidMap map;
    map.standardFromModel = rig.standardFromModel;
    map.warnings = std::move(rig.warnings);
    return map;
}

// A profile without roles says that its character is taken as any rig.
physics::RigKind rigKindOf(const std::optional<physics::RagdollProfile>& given, const LoadOptions& options) {
    if (!given) return options.fit.rig;
    return physics::hasRoles(*given) ? physics::RigKind::humanoid : physics::RigKind::any;
}

Result<void> bindProfile(RagdollAsset& asset, const physics::RagdollProfile& profile, const LoadOptions& options) {
    auto bound = bindToFigure(profile, asset, options.keepShapes);
    if (!bound) {
        Error error = bound.error();
        error.location = options.profile ? options.profile->string() : profile.name;
        return error;
    }
    asset.rebound = bound.value().rebound;
    asset.profile = std::move(bound).value().profile;
    return {};
}

// The profile that was asked for in place of a fitted one, if any was.
Result<std::optional<physics::RagdollProfile>> givenProfile(const LoadOptions& options) {
    LUTKA_ASSERT(!options.profile || !options.given);
    if (!options.profile) return options.given;
    auto read = physics::loadProfile(*options.profile);
    if (!read) return read.error();
    return std::optional(std::move(read).value());
}

// The figure of the file whose joints the profile names, counted from 1; nothing when it is the one that was taken.
// What is wrong with the profile is told later.
std::optional<int> figureOfProfile(const animation::Character& character, const LoadOptions& options) {
    if (options.import.figure || character.figures.size() < 2) return std::nullopt;
    const auto profile = givenProfile(options);
    if (!profile || !profile.value()) return std::nullopt;
    const int figure = figureOf(*profile.value(), character);
    return figure == character.figure ? std::nullopt : std::optional<int>(figure + 1);
}

Result<void> fitProfile(RagdollAsset& asset, const LoadOptions& options) {
    auto fitted = physics::fitRagdoll(asset.character, asset.map, options.fit);
    if (!fitted) return fitted.error();
    asset.profile = std::move(fitted).value();
    return {};
}

// In place of the fitted one.
void takeRagdollOfFile(RagdollAsset& asset) {
    const auto warn = [&](const std::string& why) {
        asset.character.warnings.push_back("the physics in the file is no ragdoll of this figure (" + why +
                                           "); one was fitted");
    };
    auto found = exporting::readGltfPhysics(asset.character.file, asset.character, asset.map, asset.profile);
    if (!found) return warn(found.error().message);
    if (!found.value()) return;
    const auto rig = physics::bindRig(*found.value(), asset.character.skeleton);
    if (!rig) return warn(rig.error().message);
    asset.profile = *std::move(found).value();
    asset.fromModel = true;
}

float sizeOf(const animation::Character& character) {
    Aabb box;
    for (const RigidTransform& joint : character.skeleton.bindModelFromJoint)
        box.add(joint.translation);
    for (const animation::SkinnedMesh& mesh : character.meshes) {
        for (const vec3& position : mesh.positions)
            box.add(position);
    }
    return box.empty() ? 0.0F : box.diagonal();
}

}  // namespace

Result<std::unique_ptr<RagdollAsset>> loadRagdoll(const std::filesystem::path& model, const LoadOptions& options) {
    auto character = animation::importCharacter(model, options.import);
    if (!character) return character.error();
    if (const std::optional<int> figure = figureOfProfile(character.value(), options)) {
        animation::ImportOptions again = options.import;
        again.figure = figure;
        character = animation::importCharacter(model, again);
        if (!character) return character.error();
    }
    return makeRagdoll(std::move(character).value(), options);
}

bool wantsAnyRig(const Error& error) {
    return error.code == ErrorCode::input && error.mend == kNotHumanoidMend;
}

Result<std::unique_ptr<RagdollAsset>> makeRagdoll(animation::Character character, const LoadOptions& options) {
    if (const std::vector<std::string> problems = animation::validate(character.skeleton); !problems.empty())
        return Error{ErrorCode::usage, "the skeleton is not sound: " + problems.front(), character.name, ""};
    auto asset = std::make_unique<RagdollAsset>();
    asset->character = std::move(character);
    asset->sizeM = sizeOf(asset->character);
    auto read = givenProfile(options);
    if (!read) return read.error();
    const std::optional<physics::RagdollProfile> given = std::move(read).value();
    LoadOptions chosen = options;
    chosen.fit.rig = rigKindOf(given, options);
    const bool any = chosen.fit.rig == physics::RigKind::any;
    asset->map = any ? mapOfAny(asset->character, chosen.fit) : animation::mapHumanoid(asset->character, options.map);
    if (!any && !asset->map.humanoid) return notHumanoid(asset->character, asset->map);
    const Result<void> profile = given ? bindProfile(*asset, *given, chosen) : fitProfile(*asset, chosen);
    if (!profile) return profile.error();
    if (!given && !options.refit && !asset->character.file.empty()) takeRagdollOfFile(*asset);
    auto rig = physics::bindRig(asset->profile, asset->character.skeleton);
    if (!rig) return rig.error();
    asset->rig = std::move(rig).value();
    return asset;
}

}  // namespace lutka::scene
