#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "editor/play/pulls.hpp"
#include "physics/profile/profile.hpp"
#include "scene/description/entity_scene.hpp"
#include "scene/puppet/puppet_cast.hpp"

namespace lutka::editor {

/// What moves in a scene at a moment, with the joints and the roles that it belongs to, so that it survives a change of
/// the ragdoll.
struct Motion {
    struct Doll {
        scene::EntityId entity = scene::kNoEntity;
        int asset = 0;
        std::vector<physics::BodyState> bodies;
        std::vector<RigidTransform> modelFromJoint;
        RigidTransform worldFromModel;
        std::optional<scene::PuppetMemory> puppet;  ///< Of one that follows a clip.
    };
    std::vector<std::vector<physics::BodyProfile>> bodies;  ///< Of each asset, as they were.
    std::vector<Doll> dolls;
    std::vector<physics::BodyState> props;
    std::vector<scene::EntityId> propEntities;  ///< Of the scene's own, which come first.
};

/// All that a running scene is at a moment beside the document: what undo brings back.
struct PlayState {
    Motion motion;
    std::vector<physics::DynamicProp> thrown;  ///< Balls in play; their motion follows the scene's props'.
    std::vector<Pull> pins;
    double seconds = 0.0;      ///< Simulated, since the scene's start.
    std::uint64_t moment = 0;  ///< Player::moment() then.
};

/// After scene::PuppetCast::begin(), once the doll's bodies are where they were in the motion: its puppet goes on from
/// there. One that had no muscles then may lie anywhere, or hang in a clip: once the scene has `begun` it goes on limp
/// where it can get up, and stays as it is elsewhere.
void resumePuppet(scene::PuppetCast& puppets, int doll, const Motion::Doll& before, bool begun);

}  // namespace lutka::editor
