#include "physics/crowd/batch.hpp"

namespace lutka::physics::crowd {
namespace {

// Copies one lane of every Wide in `from`, which is made of nothing else.
template <class Lanes>
void copyWides(const Lanes& from, int fromLane, Lanes& to, int toLane) {
    // NOLINTBEGIN(bugprone-sizeof-expression): a struct of nothing but wides is copied wide by wide
    static_assert(sizeof(Lanes) % sizeof(Wide) == 0);
    const auto* source = reinterpret_cast<const Wide*>(&from);
    auto* target = reinterpret_cast<Wide*>(&to);
    for (std::size_t i = 0; i < sizeof(Lanes) / sizeof(Wide); ++i)
        target[i].lane[toLane] = source[i].lane[fromLane];
    // NOLINTEND(bugprone-sizeof-expression)
}

void clear(Wide& wide, int lane) {
    wide.lane[lane] = 0.0F;
}

// Metres: farther than anything moves that is followed.
constexpr float kAnywhere = 1e3F;

// What a sweep needs of the tree is not needed after it: all batches of a thread share the room, which so stays in the
// nearest caches.
TreeLanes* treeRoom(std::size_t bodies) {
    thread_local std::vector<TreeLanes> room;
    if (room.size() < bodies) room.resize(bodies);
    return room.data();
}

}  // namespace

Batch::Batch(const Topology& topology)
    : bodies(topology.bodies.size()), joints(topology.joints.size()), firstContact(topology.bodies.size() + 1, 0) {}

BatchView Batch::view(const Topology& topology) {
    return {topology.bodyCount(),
            static_cast<int>(joints.size()),
            static_cast<int>(contacts.size()),
            topology.bodies.data(),
            topology.joints.data(),
            firstContact.data(),
            bodies.data(),
            joints.data(),
            treeRoom(bodies.size()),
            contacts.data(),
            static_cast<int>(drags.size()),
            drags.data(),
            motors.empty() ? nullptr : motors.data(),
            targets.empty() ? nullptr : targets.data(),
            &rest,
            paired.data(),
            static_cast<int>(paired.size()),
            firstBody,
            pairBodies,
            &answered,
            &energy,
            &flight,
            &struck};
}

void writeLane(Batch& batch, int lane, std::span<const BodyState> bodies) {
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        BodyLanes& to = batch.bodies[b];
        const quat& q = bodies[b].worldFromBody.rotation;
        writeVector(to.position, lane, bodies[b].worldFromBody.translation);
        writeVector(to.velocity, lane, bodies[b].linearVelocity);
        writeVector(to.angular, lane, bodies[b].angularVelocity);
        writeVector(to.support, lane, vec3(0));
        to.way.lane[lane] = kAnywhere;
        to.rotation.x.lane[lane] = q.x;
        to.rotation.y.lane[lane] = q.y;
        to.rotation.z.lane[lane] = q.z;
        to.rotation.w.lane[lane] = q.w;
    }
}

void readLane(const Batch& batch, int lane, std::span<BodyState> bodies) {
    for (std::size_t b = 0; b < bodies.size(); ++b)
        bodies[b] = readBody(batch.bodies[b], lane);
}

void awaken(RestLanes& rest, int lane) {
    rest.brake.lane[lane] = 0.0F;
    rest.stiction.lane[lane] = 1.0F;
}

void copyRest(const RestLanes& from, int fromLane, RestLanes& to, int toLane) {
    copyWides(from, fromLane, to, toLane);
}

void clearImpulses(Batch& batch, int lane) {
    for (JointLanes& joint : batch.joints) {
        writeVector(joint.frictionImpulse, lane, vec3(0));
        writeVector(joint.hinge.impulse, lane, vec3(0));
        for (int i = 0; i < kLimitRows; ++i) {
            clear(joint.limit[i].impulse, lane);
            clear(joint.side[i], lane);
        }
    }
}

void copyLane(const Batch& from, int fromLane, Batch& to, int toLane) {
    for (std::size_t b = 0; b < from.bodies.size(); ++b)
        copyWides(from.bodies[b], fromLane, to.bodies[b], toLane);
    for (std::size_t j = 0; j < from.joints.size(); ++j) {
        const JointLanes& source = from.joints[j];
        JointLanes& target = to.joints[j];
        copyWides(source.frictionImpulse, fromLane, target.frictionImpulse, toLane);
        copyWides(source.hinge.impulse, fromLane, target.hinge.impulse, toLane);
        for (int i = 0; i < kLimitRows; ++i) {
            copyWides(source.limit[i].impulse, fromLane, target.limit[i].impulse, toLane);
            copyWides(source.side[i], fromLane, target.side[i], toLane);
        }
    }
}

}  // namespace lutka::physics::crowd
