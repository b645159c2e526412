#pragma once

#include "physics/crowd/contact_lanes.hpp"
#include "physics/crowd/drive_lanes.hpp"
#include "physics/crowd/joint_lanes.hpp"

namespace lutka::physics::crowd {

/// A batch as the kernels see it.
struct BatchView {
    int bodyCount;
    int jointCount;
    int contactCount;
    const BodyConstants* bodyConstants;
    const JointConstants* jointConstants;
    const int* firstContact;  ///< One a body and one more: where its contacts begin; they lie body by body.
    BodyLanes* bodies;
    JointLanes* joints;
    TreeLanes* tree;
    StaticContactLanes* contacts;
    int dragCount;
    DragLanes* drags;
    MotorLanes* motors;    ///< One a joint, or null where no doll of the batch has any.
    TargetLanes* targets;  ///< One a body, likewise.
    const RestLanes* rest;
    const int* paired;  ///< Its bodies that pair contacts push, in some lane.
    int pairedCount;
    const int* firstBody;  ///< One a lane: where its doll's bodies begin in `pairBodies`.
    PairBodies pairBodies;
    Wide* answered;  ///< 1 where the lane's doll has answered to contacts that were pressed again, else 0.
    Wide* energy;    ///< J, kinetic, of each doll at the substep's start.
    FlightLanes* flight;
    Wide* struck;  ///< What else presses the lane's doll in this substep: see Struck.
};

}  // namespace lutka::physics::crowd
