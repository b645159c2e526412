#include "physics/fit/fit_ragdoll.hpp"

#include <algorithm>

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
    if (!map.humanoid || map.jointOf(Role::hips) == animation::kNoJoint) {
        return fail("not a humanoid: no joint plays the hips", "look at `lutka map` and bind the roles by hand");
    }
    if (!(options.totalMassKg > 0.0F) || !std::isfinite(options.totalMassKg)) {
        return Error{ErrorCode::usage, "the total mass must be above 0 kg", {}, {}};
    }
    return {};
}

}  // namespace

Result<RagdollProfile> fitRagdoll(const animation::Character& character, const animation::HumanoidMap& map,
                                  const FitOptions& options) {
    if (const Result<void> checked = checkInput(character, map, options); !checked) return checked.error();
    const BodyPlan plan = planBodies(character, map, options);
    const Anatomy anatomy = findAnatomy(plan);
    const std::vector<PlacedShape> shapes = fitShapes(plan, anatomy);

    RagdollProfile profile;
    profile.name = character.name;
    profile.heightM = plan.heightM;
    profile.totalMassKg = options.totalMassKg;
    profile.standardFromModel = map.standardFromModel;
    profile.bodies.resize(plan.bodies.size());
    placeBodies(profile, character, plan, shapes);
    FitOptions massOptions = options;
    if (infoOf(options.preset).massByVolume && options.massPreset == MassPreset::anatomical) {
        massOptions.massPreset = MassPreset::volume;
    }
    assignMasses(profile.bodies, massOptions);
    profile.constraints = makeConstraints(plan, anatomy, shapes, profile.notes);
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
