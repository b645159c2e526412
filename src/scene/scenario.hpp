#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "physics/world.hpp"

namespace lutka::scene {

/// Where one doll starts: its model frame and the velocity of the whole body.
struct Placement {
    RigidTransform worldFromModel;
    vec3 linearVelocity{0, 0, 0};   ///< m/s
    vec3 angularVelocity{0, 0, 0};  ///< rad/s about the figure's centre.
};

/// A body of a doll held at a world point from the start (the scene `hang`).
struct Pin {
    int doll = 0;
    physics::Role role = physics::Role::leftHand;
};

/// A deterministic set-up shared by tests, benchmarks, CLI and editor: the same name, count and seed give the same one.
struct Scenario {
    std::string name;
    std::uint64_t seed = 0;
    std::vector<physics::StaticShape> statics;
    std::vector<physics::DynamicProp> props;
    std::vector<Placement> dolls;
    std::vector<Pin> pins;
    float seconds = 6.0F;      ///< Long enough for one doll to come to rest.
    vec3 focus{0, 0.9F, 0};    ///< What a camera should look at.
    float focusRadius = 1.6F;  ///< And how far around, metres.
};

struct ScenarioInfo {
    std::string_view name;
    std::string_view summary;
};

/// drop, spread, pile, stairs, ramp, hang, throw, balls.
[[nodiscard]] std::span<const ScenarioInfo> scenarioRegistry();

/// The standing figure's extent in its standard stance (Y up, facing +Z), relative to the rotated model's origin.
struct FigureBounds {
    vec3 low{0, 0, 0};
    vec3 high{0, 0, 0};
};
/// Over the surfaces of all bodies in the bind pose.
[[nodiscard]] FigureBounds figureBounds(const physics::RagdollProfile& profile, const physics::Rig& rig);

/// `count` dolls of one figure, `count` in [1, 10000]. Seed 0 stands exactly upright; other seeds turn, tilt and nudge
/// the figures. Fails with ErrorCode::usage for an unknown name (the known ones are listed) or count.
[[nodiscard]] Result<Scenario> makeScenario(std::string_view name, int count, std::uint64_t seed,
                                            const FigureBounds& figure, const quat& standardFromModel);

}  // namespace lutka::scene
