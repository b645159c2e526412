#include "physics/fit/fit_ragdoll.hpp"

#include <algorithm>

#include "animation/segments/segment_rig.hpp"
#include "physics/collision/shape.hpp"
#include "physics/fit/anatomy.hpp"
#include "physics/fit/body_plan.hpp"
#include "physics/fit/fit_shapes.hpp"
#include "physics/fit/limits.hpp"
#include "physics/fit/masses.hpp"
#include "physics/fit/rebind.hpp"
#include "physics/fit/separate_shapes.hpp"

namespace lutka::physics {
namespace {

Result<void> checkInput(const animation::Character& character, const animation::HumanoidMap& map,
                        const FitOptions& options) {
    const auto fail = [&](std::string message, std::string mend) {
        return Error{ErrorCode::input, std::move(message), character.name, std::move(mend)};
    };
    if (options.rig == RigKind::any) {
        if (character.skeleton.jointCount() == 0)
            return fail("there is no joint for a body to hang on", "rig the model");
    } else if (!map.humanoid || map.jointOf(Role::hips) == animation::kNoJoint) {
        return fail("not a humanoid: no joint plays the hips",
                    "look at `lutka map` and bind the roles by hand, or take `--rig any`");
    }
    if (!(options.totalMassKg > 0.0F) || !std::isfinite(options.totalMassKg)) {
        return Error{ErrorCode::usage, "the total mass must be above 0 kg", {}, {}};
    }
    return {};
}

BodyPlan planFor(const animation::Character& character, const animation::HumanoidMap& map, const FitOptions& options) {
    if (options.rig == RigKind::humanoid) {
        const auto segments = animation::appendageSegments(character, map, options.appendages, options.mostBodies);
        return planBodies(character, map, options, segments);
    }
    const animation::SegmentedRig rig = animation::segmentRig(character, {options.mostBodies});
    return planBodies(character, map, std::span<const Role>{}, rig.segments);
}

float waterOf(const std::vector<PlacedShape>& shapes) {
    constexpr float kWater = 1000.0F;  // kg/m³
    constexpr float kLeast = 1e-3F;
    constexpr float kMost = 5e4F;
    float volume = 0.0F;
    for (const PlacedShape& shape : shapes)
        volume += shapeVolume(shape.shape);
    return std::clamp(kWater * volume, kLeast, kMost);
}

void assignAllMasses(RagdollProfile& profile, const FitOptions& options) {
    FitOptions massOptions = options;
    massOptions.totalMassKg = profile.totalMassKg;
    if (infoOf(options.preset).massByVolume && options.massPreset == MassPreset::anatomical) {
        massOptions.massPreset = MassPreset::volume;
    }
    assignMasses(profile.bodies, massOptions);
}

}  // namespace

Result<RagdollProfile> fitRagdoll(const animation::Character& character, const animation::HumanoidMap& map,
                                  const FitOptions& options) {
    if (const Result<void> checked = checkInput(character, map, options); !checked) return checked.error();
    BodyPlan plan = planFor(character, map, options);
    for (PlannedBody& body : plan.bodies)
        body.asHull = options.hulls;
    const Anatomy anatomy = findAnatomy(plan);
    const std::vector<PlacedShape> shapes = fitShapes(plan, anatomy, options.mostShapes);

    RagdollProfile profile;
    profile.name = character.name;
    profile.heightM = plan.heightM;
    profile.totalMassKg = options.rig == RigKind::any && options.weighByVolume ? waterOf(shapes) : options.totalMassKg;
    profile.standardFromModel = map.standardFromModel;
    profile.bodies.resize(plan.bodies.size());
    placeBodies(profile, character, plan, shapes);
    assignAllMasses(profile, options);
    profile.constraints = makeConstraints(plan, anatomy, shapes, profile.notes);
    const bool segments = std::any_of(plan.bodies.begin(), plan.bodies.end(), [](const auto& b) { return b.segment; });
    if (segments) raiseLightSegments(profile);
    setJointFriction(profile);
    std::vector<RigidTransform> placed;
    placed.reserve(shapes.size());
    for (const PlacedShape& shape : shapes)
        placed.push_back(shape.standardFromBody);
    applyPreset(profile, options.preset, placed);
    profile.filteredPairs = pairsToFilter(profile, placed);
    if (const std::vector<std::string> problems = validate(profile); !problems.empty()) {
        return Error{ErrorCode::input, "no valid ragdoll comes out: " + problems.front(), character.name, {}};
    }
    return profile;
}

}  // namespace lutka::physics
