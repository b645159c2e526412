#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "animation/humanoid/map_humanoid.hpp"
#include "editor/part_edits.hpp"
#include "physics/fit_ragdoll.hpp"
#include "physics/profile.hpp"
#include "physics/world.hpp"
#include "scene/simulation.hpp"

namespace lutka::editor {

/// A thing that the user put into the scene beside the dolls.
struct SceneObject {
    enum class Kind {
        box,    ///< Static geometry.
        ball,   ///< A free rigid body.
        light,  ///< A point light; it has no body.
    };
    Kind kind = Kind::box;
    RigidTransform worldFromObject{{1, 0, 0, 0}, {0, 0.25F, 0}};
    vec3 halfExtents{0.25F, 0.25F, 0.25F};  ///< Box, metres, > 0.
    float radius = 0.15F;                   ///< Ball, metres, > 0.
    float massKg = 5.0F;                    ///< Ball, > 0.
    vec3 lightColor{1.0F, 0.9F, 0.75F};     ///< Light, linear.
    float lightIntensity = 4.0F;            ///< Light: irradiance at one metre.
};

[[nodiscard]] std::string_view objectKindName(SceneObject::Kind kind);
/// Half the size of the object's box in its own frame; what the slab test picks.
[[nodiscard]] vec3 halfSizeOf(const SceneObject& object);

/// What is simulated, where and how.
struct SceneSettings {
    std::string scenario = "drop";  ///< A name of scene::scenarioRegistry().
    int count = 1;                  ///< Dolls, [1, 10000].
    std::uint64_t seed = 0;
    physics::WorldSettings world;
    scene::StartPose pose = scene::StartPose::bind;
    std::vector<SceneObject> objects;
};

/// Everything that editing changes; undo keeps whole ones.
struct DocumentState {
    /// Bindings that the user chose. kNoJoint: the role shall have no joint.
    std::array<std::optional<int>, animation::kRoleCount> fixed{};
    physics::FitOptions fit;
    AllPartEdits edits{};
    std::vector<PairEdit> pairs;  ///< Of the collision filter.
    SceneSettings scene;
    std::filesystem::path openedProfile;  ///< The profile's file that `base` was read from; empty: fitted.

    // What follows from the above.
    animation::HumanoidMap map;
    physics::RagdollProfile base;     ///< As fitted, or as read from a file.
    physics::RagdollProfile profile;  ///< `base` with `edits`.
    /// What `base` changes of a plain fit (a profile that was opened, mends): taken into `edits` when a new fit takes
    /// its place, so that nobody's work is lost by mapping another joint.
    AllPartEdits baseEdits{};
    std::vector<PairEdit> basePairs;  ///< Likewise.
};

/// The map with what the user fixed. Fails with ErrorCode::input, in the mapper's words, when that is no humanoid.
[[nodiscard]] Result<animation::HumanoidMap> mapWithFixed(
    const animation::Character& character, const std::array<std::optional<int>, animation::kRoleCount>& fixed);

}  // namespace lutka::editor
