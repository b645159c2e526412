#include "support/falls.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

#include "physics/profile/constraint_state.hpp"
#include "physics/world/lasting_peak.hpp"
#include "scene/description/scenario.hpp"

namespace lutka::test {
namespace {

using physics::BodyState;
using physics::RagdollProfile;
using physics::Role;

constexpr double kTwoFrames = 1.999 / 60.0;

// A doll of the asset in its bind pose where a scene puts it, moving as the scene says.
std::vector<BodyState> placedBodies(const scene::RagdollAsset& asset, const scene::Placement& placement) {
    std::vector<BodyState> bodies(asset.profile.bodies.size());
    physics::bodiesFromPose(asset.rig, asset.character.skeleton.bindModelFromJoint, placement.worldFromModel, bodies);
    vec3 centre(0);
    for (std::size_t i = 0; i < bodies.size(); ++i)
        centre += bodies[i].worldFromBody.translation * (asset.profile.bodies[i].massKg / asset.profile.totalMassKg);
    for (BodyState& body : bodies) {
        const vec3 arm = body.worldFromBody.translation - centre;
        body.linearVelocity = placement.linearVelocity + glm::cross(placement.angularVelocity, arm);
        body.angularVelocity = placement.angularVelocity;
    }
    return bodies;
}

vec3 jointOf(const RagdollProfile& profile, int body, const RigidTransform& worldFromBody) {
    return (worldFromBody * inverse(profile.bodies[body].jointFromBody)).translation;
}

// Where the trunk ends: the head's joint, or that of the highest trunk body there is.
int topOfTrunk(const RagdollProfile& profile) {
    for (const Role role : {Role::neck, Role::head, Role::upperChest, Role::chest, Role::spine}) {
        const int body = physics::bodyOf(profile, role);
        if (body >= 0) return body;
    }
    return 0;
}

// Follows each joint's violation by itself, to name the worst.
class JointWatch {
  public:
    explicit JointWatch(const RagdollProfile& profile)
        : profile_(profile), held_(profile.constraints.size(), physics::LastingPeak(kTwoFrames)) {}

    void sample(double seconds, std::span<const BodyState> bodies) {
        for (std::size_t i = 0; i < held_.size(); ++i) {
            const physics::ConstraintProfile& constraint = profile_.constraints[i];
            const auto state = physics::measureConstraint(constraint, bodies[constraint.parent].worldFromBody,
                                                          bodies[constraint.child].worldFromBody);
            const float lasting = held_[i].add(seconds, state.violation);
            if (lasting <= worst_) continue;
            worst_ = lasting;
            child_ = constraint.child;
        }
    }
    [[nodiscard]] std::string worst() const { return child_ < 0 ? "" : profile_.bodies[child_].name; }

  private:
    const RagdollProfile& profile_;
    std::vector<physics::LastingPeak> held_;
    float worst_ = 0.0F;
    int child_ = -1;
};

}  // namespace

Result<Fall> fall(const scene::RagdollAsset& asset, std::unique_ptr<physics::World> world,
                  const FallSettings& settings) {
    const auto made = scene::makeScenario({.name = settings.scene, .seed = settings.seed}, asset);
    if (!made) return made.error();
    const scene::Scenario& scenario = made.value();
    const RagdollProfile& profile = asset.profile;
    for (const physics::StaticShape& shape : scenario.statics)
        world->addStatic(shape);
    for (const physics::DynamicProp& prop : scenario.props)
        world->addProp(prop);
    const physics::DollId doll = world->addDoll(profile, placedBodies(asset, scenario.dolls.front()));
    physics::QualityMeter meter(*world, scenario.statics, vec3(0, -9.81F, 0));
    JointWatch watch(profile);
    std::vector<BodyState> bodies(profile.bodies.size());
    double seconds = 0;
    // By the time that is over, not by the meter's: that is of substeps, each rounded.
    double begun = 0;
    for (std::size_t i = 0; begun < static_cast<double>(settings.seconds) - 1e-3; ++i) {
        const float dt = settings.frames[i % settings.frames.size()];
        const double substep = static_cast<double>(dt) / world->substepsPerStep();
        begun += static_cast<double>(dt);
        world->step(dt, [&] {
            seconds += substep;
            meter.sample(seconds);
            world->getBodies(doll, bodies);
            watch.sample(seconds, bodies);
        });
    }
    if (settings.atEnd) settings.atEnd(*world, doll);
    Fall result;
    result.quality = meter.result();
    result.worstJoint = watch.worst();
    const vec3 hips = jointOf(profile, 0, bodies[0].worldFromBody);
    const int top = topOfTrunk(profile);
    const vec3 trunk = jointOf(profile, top, bodies[top].worldFromBody) - hips;
    const scene::FigureBounds bounds = scene::figureBounds(profile, asset.rig);
    const vec3 standing = profile.standardFromModel * jointOf(profile, 0, asset.rig.bindModelFromBody[0]);
    result.hipsHeightShare = hips.y / std::max(standing.y - bounds.low.y, 1e-3F);
    result.trunkLeanDeg = degrees(std::acos(std::clamp(trunk.y / std::max(glm::length(trunk), 1e-6F), -1.0F, 1.0F)));
    return result;
}

Result<std::unique_ptr<scene::RagdollAsset>> loadFigure(const std::string& file) {
    scene::LoadOptions options;
    options.import.loadTextures = false;
    auto loaded = scene::loadRagdoll(file, options);
    if (loaded || !scene::wantsAnyRig(loaded.error())) return loaded;
    options.fit.rig = physics::RigKind::any;
    return scene::loadRagdoll(file, options);
}

}  // namespace lutka::test
