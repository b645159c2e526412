#include "scene/ragdoll_asset.hpp"

#include "export/read_gltf_physics.hpp"
#include "physics/fit/rebind.hpp"
#include "physics/profile/profile_io.hpp"

namespace lutka::scene {
namespace {

Error notHumanoid(const animation::Character& character, const animation::HumanoidMap& map) {
    const std::string reason = map.warnings.empty() ? "not a humanoid" : map.warnings.front();
    return {ErrorCode::input, reason, character.file.string(),
            "`lutka inspect` shows the joint tree; a humanoid has a trunk, two arms and two legs"};
}

Result<void> readProfile(RagdollAsset& asset, const LoadOptions& options) {
    auto read = physics::loadProfile(*options.profile);
    if (!read) return read.error();
    auto bound = physics::bindOrRebind(std::move(read).value(), asset.character, asset.map, options.keepShapes);
    if (!bound) {
        Error error = bound.error();
        error.location = options.profile->string();
        return error;
    }
    asset.rebound = bound.value().rebound;
    asset.profile = std::move(bound).value().profile;
    return {};
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

}  // namespace

Result<std::unique_ptr<RagdollAsset>> loadRagdoll(const std::filesystem::path& model, const LoadOptions& options) {
    auto character = animation::importCharacter(model, options.import);
    if (!character) return character.error();
    return makeRagdoll(std::move(character).value(), options);
}

Result<std::unique_ptr<RagdollAsset>> makeRagdoll(animation::Character character, const LoadOptions& options) {
    auto asset = std::make_unique<RagdollAsset>();
    asset->character = std::move(character);
    asset->map = animation::mapHumanoid(asset->character, options.map);
    if (!asset->map.humanoid) return notHumanoid(asset->character, asset->map);
    const Result<void> profile = options.profile ? readProfile(*asset, options) : fitProfile(*asset, options);
    if (!profile) return profile.error();
    if (!options.profile && !options.refit && !asset->character.file.empty()) takeRagdollOfFile(*asset);
    auto rig = physics::bindRig(asset->profile, asset->character.skeleton);
    if (!rig) return rig.error();
    asset->rig = std::move(rig).value();
    return asset;
}

}  // namespace lutka::scene
