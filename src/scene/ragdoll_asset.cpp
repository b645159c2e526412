#include "scene/ragdoll_asset.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "physics/profile_io.hpp"
#include "physics/rebind.hpp"

namespace lutka::scene {
namespace {

Error notHumanoid(const animation::Character& character, const animation::HumanoidMap& map) {
    const std::string reason = map.warnings.empty() ? "not a humanoid" : map.warnings.front();
    return {ErrorCode::input, reason, character.file.string(),
            "`lutka inspect` shows the joint tree; a humanoid has a trunk, two arms and two legs"};
}

// Whether the two anchors of every constraint meet in the rig's bind pose: a rig of the same joint names but other
// proportions is another rig.
bool anchorsMeet(const physics::RagdollProfile& profile, const physics::Rig& rig) {
    constexpr float kShareOfHeight = 0.01F;
    for (const physics::ConstraintProfile& constraint : profile.constraints) {
        const vec3 onParent = rig.bindModelFromBody[constraint.parent] * constraint.parentFromFrame.translation;
        const vec3 onChild = rig.bindModelFromBody[constraint.child] * constraint.childFromFrame.translation;
        if (glm::distance(onParent, onChild) > kShareOfHeight * profile.heightM) return false;
    }
    return true;
}

bool sharesMostJoints(const physics::RagdollProfile& profile, const animation::Skeleton& skeleton) {
    const auto there =
        std::count_if(profile.bodies.begin(), profile.bodies.end(), [&](const physics::BodyProfile& body) {
            return animation::findJoint(skeleton, body.jointPath) != animation::kNoJoint ||
                   animation::findJoint(skeleton, body.joint) != animation::kNoJoint;
        });
    return 2 * there > static_cast<std::ptrdiff_t>(profile.bodies.size());
}

Result<void> readProfile(RagdollAsset& asset, const LoadOptions& options) {
    auto read = physics::loadProfile(*options.profile);
    if (!read) return read.error();
    auto rig = physics::bindRig(read.value(), asset.character.skeleton);
    // A few joints that are not there are typos to be mended, not another rig.
    if (!rig && sharesMostJoints(read.value(), asset.character.skeleton)) {
        Error error = rig.error();
        error.location = options.profile->string();
        return error;
    }
    if (!rig || !anchorsMeet(read.value(), rig.value())) {
        read = physics::rebindProfile(read.value(), asset.character, asset.map, options.keepShapes);
        if (!read) return read.error();
        asset.rebound = true;
    }
    asset.profile = std::move(read).value();
    return {};
}

Result<void> fitProfile(RagdollAsset& asset, const LoadOptions& options) {
    auto fitted = physics::fitRagdoll(asset.character, asset.map, options.fit);
    if (!fitted) return fitted.error();
    asset.profile = std::move(fitted).value();
    return {};
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
    auto rig = physics::bindRig(asset->profile, asset->character.skeleton);
    if (!rig) return rig.error();
    asset->rig = std::move(rig).value();
    return asset;
}

}  // namespace lutka::scene
