#include <algorithm>
#include <map>

#include "editor/play/player.hpp"

// What moves is kept, and put back where a simulation is made anew.

namespace lutka::editor {
namespace {

// Whether every body is the same part of the same joint, so that its state can go on bit for bit.
bool sameFrames(std::span<const physics::BodyProfile> a, std::span<const physics::BodyProfile> b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const physics::BodyProfile& x, const physics::BodyProfile& y) {
                          return x.name == y.name && x.jointPath == y.jointPath &&
                                 x.jointFromBody.rotation == y.jointFromBody.rotation &&
                                 x.jointFromBody.translation == y.jointFromBody.translation;
                      });
}

}  // namespace

Motion Player::capture() const {
    Motion motion;
    scene::Simulation& simulation = *simulation_;
    for (const scene::RagdollAsset* asset : simulation.assets())
        motion.bodies.push_back(asset->profile.bodies);
    for (int doll = 0; doll < simulation.dollCount(); ++doll) {
        const scene::RagdollAsset& asset = simulation.assetOf(doll);
        Motion::Doll& one = motion.dolls.emplace_back();
        one.entity = entityOfDoll(doll);
        one.asset = simulation.scenario().dolls[doll].asset;
        one.bodies.resize(asset.profile.bodies.size());
        one.modelFromJoint.resize(asset.character.skeleton.parents.size());
        one.worldFromModel = simulation.worldFromModel(doll);
        if (simulation.puppets() != nullptr) one.puppet = simulation.puppets()->memoryOf(doll);
        simulation.getBodies(doll, one.bodies);
        simulation.pose(doll, 1.0F, one.modelFromJoint);
    }
    for (const physics::PropId prop : simulation.world().props())
        motion.props.push_back(simulation.world().propState(prop));
    motion.propEntities = simulation.scenario().propEntities;
    return motion;
}

// Whether an entity starts where and as it did at the last rebuild: then its motion goes on.
bool Player::startsAsBefore(scene::EntityId id) const {
    const scene::EntityScene& now = document_.scene();
    if (scene::findEntity(built_, id) == nullptr) return false;
    const RigidTransform was = scene::worldFromEntity(built_, id);
    const RigidTransform is = scene::worldFromEntity(now, id);
    if (was.translation != is.translation || was.rotation != is.rotation) return false;
    const auto* oldDoll = built_.find<scene::Ragdoll>(id);
    const auto* newDoll = now.find<scene::Ragdoll>(id);
    if ((oldDoll == nullptr) != (newDoll == nullptr)) return false;
    const auto* oldBody = built_.find<scene::RigidBody>(id);
    const auto* newBody = now.find<scene::RigidBody>(id);
    if (oldBody != nullptr && newBody != nullptr &&
        (oldBody->linearVelocity != newBody->linearVelocity || oldBody->angularVelocity != newBody->angularVelocity)) {
        return false;
    }
    return oldDoll == nullptr || *oldDoll == *newDoll;
}

void Player::restore(const Motion& motion, bool all) {
    scene::Simulation& simulation = *simulation_;
    std::map<scene::EntityId, const Motion::Doll*> before;
    for (const Motion::Doll& doll : motion.dolls)
        before[doll.entity] = &doll;
    std::vector<physics::BodyState> bodies;
    for (int doll = 0; doll < simulation.dollCount(); ++doll) {
        const auto was = before.find(entityOfDoll(doll));
        if (was == before.end() || (!all && !startsAsBefore(was->first))) continue;
        const bool begun = seconds() > 0.0 || stage_;
        // Who gets muscles before anything has happened stands where the puppets' scene places it.
        if (!all && !begun && simulation.puppets() != nullptr && !was->second->puppet) continue;
        const scene::RagdollAsset& asset = simulation.assetOf(doll);
        const std::vector<physics::BodyProfile>& oldBodies = motion.bodies[was->second->asset];
        if (asset.character.skeleton.parents.size() != was->second->modelFromJoint.size()) continue;
        const bool same = sameFrames(oldBodies, asset.profile.bodies);
        bodies.resize(asset.profile.bodies.size());
        if (!same) {
            placeByJoints(doll, oldBodies, was->second->bodies, was->second->modelFromJoint,
                          was->second->worldFromModel, bodies);
        }
        simulation.world().setBodies(simulation.dollId(doll), same ? was->second->bodies : bodies);
        if (simulation.puppets() != nullptr) resumePuppet(*simulation.puppets(), doll, *was->second, begun);
    }
    simulation.refresh();
}

// Other bodies than before: the skin stays where it is, and each body goes on with its role's velocity.
void Player::placeByJoints(int doll, std::span<const physics::BodyProfile> oldBodies,
                           std::span<const physics::BodyState> oldStates,
                           std::span<const RigidTransform> modelFromJoint, const RigidTransform& worldFromModel,
                           std::span<physics::BodyState> bodies) const {
    const scene::RagdollAsset& asset = simulation_->assetOf(doll);
    physics::bodiesFromPose(asset.rig, modelFromJoint, worldFromModel, bodies);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const auto old = std::find_if(oldBodies.begin(), oldBodies.end(), [&](const physics::BodyProfile& body) {
            return body.name == asset.profile.bodies[i].name;
        });
        if (old == oldBodies.end()) continue;
        const physics::BodyState& state = oldStates[old - oldBodies.begin()];
        bodies[i].linearVelocity = state.linearVelocity;
        bodies[i].angularVelocity = state.angularVelocity;
    }
}

// Props go on where they are. What the user moved since, or what is new, starts where the document has it.
void Player::keepProps(const Motion& motion, bool all, scene::Scenario& scenario) const {
    for (std::size_t i = 0; i < scenario.propEntities.size(); ++i) {
        const scene::EntityId id = scenario.propEntities[i];
        const auto was = std::find(motion.propEntities.begin(), motion.propEntities.end(), id);
        if (was == motion.propEntities.end() || (!all && !startsAsBefore(id))) continue;
        scenario.props[i].state = motion.props[static_cast<std::size_t>(was - motion.propEntities.begin())];
    }
    const std::size_t firstOld = motion.propEntities.size();
    const std::size_t firstNew = scenario.propEntities.size();
    for (std::size_t i = 0; firstOld + i < motion.props.size() && firstNew + i < scenario.props.size(); ++i)
        scenario.props[firstNew + i].state = motion.props[firstOld + i];
}

// Whether the edited ragdoll's bodies are those of the motion.
bool Player::suits(const Motion& motion) const {
    return motion.bodies.empty() || sameFrames(motion.bodies.front(), document_.profile().bodies);
}

void Player::remember(const Motion& motion) {
    constexpr std::size_t most = 8;
    std::erase_if(memories_, [&](const Memory& memory) { return memory.moment != moment_; });
    const bool known = std::any_of(memories_.begin(), memories_.end(), [&](const Memory& memory) {
        return sameFrames(memory.motion.bodies.front(), motion.bodies.front());
    });
    if (known) return;
    if (memories_.size() >= most) memories_.erase(memories_.begin() + 1);
    memories_.push_back({moment_, motion});
}

const Motion* Player::remembered() const {
    const auto memory = std::find_if(memories_.begin(), memories_.end(),
                                     [&](const Memory& one) { return one.moment == moment_ && suits(one.motion); });
    return memory != memories_.end() ? &memory->motion : nullptr;
}

}  // namespace lutka::editor
