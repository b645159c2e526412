#pragma once

#include <cstdint>
#include <glm/geometric.hpp>
#include <span>
#include <vector>

#include "physics/crowd/batch_view.hpp"
#include "physics/crowd/topology.hpp"
#include "physics/rig/rig.hpp"

namespace lutka::physics::crowd {

/// What a static contact has pushed with so far in a step, for reports.
struct StaticPush {
    std::uint64_t key = 0;
    int lane = 0;
    int body = 0;
    vec3 position{0, 0, 0};
    vec3 normal{0, 1, 0};
    float impulse = 0.0F;  ///< N s
};

/// How a body that is near static geometry other than planes moved when its contacts were looked for.
struct NearMotion {
    int body = 0;
    int lane = 0;
    vec3 velocity{0, 0, 0};
    vec3 angular{0, 0, 0};
};

/// Up to kLanes awake dolls of one topology, one a lane. Lanes [0, used) hold dolls; the rest repeat lane 0, so that
/// the kernels find sound numbers everywhere.
struct Batch {
    explicit Batch(const Topology& topology);

    std::vector<BodyLanes> bodies;  ///< One a body.
    std::vector<JointLanes> joints;
    std::vector<StaticContactLanes> contacts;  ///< Of this step, body by body.
    std::vector<int> firstContact;             ///< See BatchView.
    std::vector<Wide> impulseSums;             ///< One a contact, of the substeps since they were found; for reports.
    std::vector<StaticPush> pushes;        ///< Of contacts that were found anew since, and at last of all; for reports.
    std::vector<int> nearPlanes;           ///< Statics that some lane is near, while contacts are found,
    std::vector<int> nearStatics[kLanes];  ///< and the others, lane by lane.
    std::vector<unsigned char> planeLanes;  ///< In which lanes: one a plane and point of the topology, plane by plane.
    std::vector<unsigned char> planeLanesBefore;     ///< Of the search before.
    std::vector<std::uint64_t> carriedKeys[kLanes];  ///< Of the contacts that its dolls keep, in their order, likewise.
    std::vector<unsigned char> selfMasks;            ///< One a pair of the topology, likewise.
    std::vector<NearMotion> nearMotions;
    bool nearShapes = false;           ///< Whether some of its dolls are near static geometry other than planes.
    std::vector<DragLanes> drags;      ///< Of this step, one a pull.
    std::vector<MotorLanes> motors;    ///< Of this step, one a joint, or none at all.
    std::vector<TargetLanes> targets;  ///< Of this step, one a body, or none at all.
    RestLanes rest{};
    int doll[kLanes]{};  ///< Which doll is in which lane.
    int used = 0;
    bool isStill = false;      ///< Whether nothing of it moves by more than some millimetres in this step.
    int substeps = 0;          ///< What a step of it needs by its dolls' motion,
    int substepsOf[kLanes]{};  ///< and of each of them.
    int job = 0;               ///< Which job of this step solves it.
    std::vector<int> paired;   ///< The bodies that pair contacts push in this step, in some lane.
    int firstBody[kLanes]{};
    PairBodies pairBodies{};
    Wide answered{};  ///< See BatchView.
    Wide energy{};    ///< See BatchView.
    FlightLanes flight{};
    Wide struck{};  ///< See BatchView.

    [[nodiscard]] BatchView view(const Topology& topology);
};

/// A body's state in and out of a lane. The rotation's columns and the inertia follow at the next refresh.
void writeLane(Batch& batch, int lane, std::span<const BodyState> bodies);
void readLane(const Batch& batch, int lane, std::span<BodyState> bodies);
[[nodiscard]] inline vec3 readVector(const Wide3& v, int lane) {
    return {v.x.lane[lane], v.y.lane[lane], v.z.lane[lane]};
}
inline void writeVector(Wide3& to, int lane, const vec3& v) {
    to.x.lane[lane] = v.x;
    to.y.lane[lane] = v.y;
    to.z.lane[lane] = v.z;
}
/// The friction of a prepared contact on its body A, N s, world axes.
[[nodiscard]] inline vec3 frictionOf(const PairContactLanes& pair, int lane) {
    const vec3 tangent = readVector(pair.tangent, lane);
    return tangent * pair.tangentImpulse[0].lane[lane] +
           glm::cross(readVector(pair.normal, lane), tangent) * pair.tangentImpulse[1].lane[lane];
}
[[nodiscard]] inline BodyState readBody(const BodyLanes& body, int lane) {
    const Wide4& q = body.rotation;
    return {{quat(q.w.lane[lane], q.x.lane[lane], q.y.lane[lane], q.z.lane[lane]), readVector(body.position, lane)},
            readVector(body.velocity, lane),
            readVector(body.angular, lane)};
}

/// Lets go of a doll that was coming to rest.
void awaken(RestLanes& rest, int lane);
void copyRest(const RestLanes& from, int fromLane, RestLanes& to, int toLane);
/// Forgets what the joints of a lane carry from step to step.
void clearImpulses(Batch& batch, int lane);
/// Bodies and joints of one lane into another, of the same topology.
void copyLane(const Batch& from, int fromLane, Batch& to, int toLane);

}  // namespace lutka::physics::crowd
