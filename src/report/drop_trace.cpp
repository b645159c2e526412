#include "report/drop_trace.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "physics/collision/static_distance.hpp"
#include "physics/profile/constraint_state.hpp"
#include "physics/world/body_energy.hpp"

namespace lutka::reporting {
namespace {

constexpr float kTouching = 0.002F;  // metres: nearer than this is contact, as the quality figures have it

bool touches(const physics::RagdollProfile& profile, std::span<const physics::BodyState> bodies,
             std::span<const physics::StaticShape> statics) {
    for (std::size_t body = 0; body < bodies.size(); ++body) {
        for (const physics::StaticShape& geometry : statics) {
            if (physics::distanceToStatic(profile.bodies[body].shape, bodies[body].worldFromBody, geometry) < kTouching)
                return true;
        }
    }
    return false;
}

}  // namespace

void DropRecorder::sample(scene::Simulation& simulation) {
    bodies_.resize(simulation.asset().profile.bodies.size());
    simulation.getBodies(0, bodies_);
    trace_.dt = simulation.options().dt;
    sampleFigures(simulation);
    if (simulation.steps() % DropTrace::kStepsAPose == 0) samplePose(simulation);
}

void DropRecorder::sampleFigures(const scene::Simulation& simulation) {
    const physics::RagdollProfile& profile = simulation.asset().profile;
    const vec3& gravity = simulation.options().world.gravity;
    const vec3 up = -gravity / std::max(glm::length(gravity), 1e-6F);
    const float floor = physics::lowestSurface(simulation.scenario().statics, up);
    const physics::DollId doll = simulation.dollId(0);
    double energy = 0;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const float massKg = profile.bodies[i].massKg;
        const float height = glm::dot(bodies_[i].worldFromBody.translation, up) - floor;
        energy += physics::kineticEnergy(bodies_[i], massKg, simulation.world().inertiaOf(doll, static_cast<int>(i))) +
                  static_cast<double>(massKg * glm::length(gravity) * height);
    }
    float separation = 0;
    float violation = 0;
    for (const physics::ConstraintProfile& constraint : profile.constraints) {
        const physics::ConstraintState state = physics::measureConstraint(
            constraint, bodies_[constraint.parent].worldFromBody, bodies_[constraint.child].worldFromBody);
        separation = std::max(separation, state.separationM);
        violation = std::max(violation, degrees(state.violation));
    }
    trace_.energyJ.push_back(static_cast<float>(energy));
    trace_.separationM.push_back(separation);
    trace_.violationDeg.push_back(violation);
    if (!trace_.firstContactS && touches(profile, bodies_, simulation.scenario().statics))
        trace_.firstContactS = static_cast<float>(simulation.seconds());
}

void DropRecorder::samplePose(scene::Simulation& simulation) {
    ++trace_.poses;
    for (const physics::BodyState& body : bodies_)
        trace_.worldFromBody.push_back(body.worldFromBody);
    modelFromJoint_.resize(simulation.asset().character.skeleton.parents.size());
    simulation.pose(0, 1.0F, modelFromJoint_);
    for (const RigidTransform& joint : modelFromJoint_)
        trace_.worldFromJoint.push_back(simulation.worldFromModel(0) * joint);
}

DropTrace standingTrace(const scene::RagdollAsset& asset) {
    const RigidTransform turned{asset.profile.standardFromModel, vec3(0)};
    float lowest = 0;
    bool any = false;
    for (const animation::SkinnedMesh& mesh : asset.character.meshes) {
        for (const vec3& position : mesh.positions) {
            const float height = (turned * position).y;
            lowest = any ? std::min(lowest, height) : height;
            any = true;
        }
    }
    const RigidTransform worldFromModel{turned.rotation, vec3(0, -lowest, 0)};
    DropTrace trace;
    trace.poses = 1;
    for (const RigidTransform& body : asset.rig.bindModelFromBody)
        trace.worldFromBody.push_back(worldFromModel * body);
    for (const RigidTransform& joint : asset.character.skeleton.bindModelFromJoint)
        trace.worldFromJoint.push_back(worldFromModel * joint);
    return trace;
}

}  // namespace lutka::reporting
