#include "scene/ragdoll_asset.hpp"

#include <fmt/format.h>

#include "physics/profile_io.hpp"

namespace lutka::scene {
namespace {

Error notHumanoid(const animation::Character& character, const animation::HumanoidMap& map) {
    const std::string reason = map.warnings.empty() ? "not a humanoid" : map.warnings.front();
    return {ErrorCode::input, reason, character.file.string(),
            "`lutka inspect` shows the joint tree; a humanoid has a trunk, two arms and two legs"};
}

Result<physics::RagdollProfile> profileFor(const RagdollAsset& asset, const LoadOptions& options) {
    if (options.profile) return physics::loadProfile(*options.profile);
    return physics::fitRagdoll(asset.character, asset.map, options.fit);
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
    auto profile = profileFor(*asset, options);
    if (!profile) return profile.error();
    asset->profile = std::move(profile).value();
    auto rig = physics::bindRig(asset->profile, asset->character.skeleton);
    if (!rig) return rig.error();
    asset->rig = std::move(rig).value();
    return asset;
}

}  // namespace lutka::scene
