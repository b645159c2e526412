#pragma once

/// What pulls, motors and frames in motion are to the kernels: springs that are solved with the joints.

#include "physics/crowd/wide.hpp"

namespace lutka::physics::crowd {

/// A pull on a point of a body towards a place, in the lane of one doll: a damped spring whose force is bounded.
struct DragLanes {
    Wide3 localPoint;
    Wide3 target;   ///< World space, at the step's end.
    Wide3 rate;     ///< m/s: how it moves.
    Wide weight;    ///< N s per m/s: what spring and damper answer a speed with in a substep; 0: nothing pulls here.
    Wide pull;      ///< 1/s: speed towards the target over the distance from it.
    Wide bound;     ///< N s a substep.
    Wide3 arm;      ///< As it will be half way through the substep.
    Wide3 bias;     ///< m/s
    Wide3 impulse;  ///< N s, of this substep.
    Wide3 before;   ///< m/s, of its point as the substep began, when Batch::energy was taken.
    Wide gain;      ///< `weight` while the force is within its bound, else 0; kept between substeps.
    int body;
};

/// A motor in a joint: a damped spring towards a turning target, whose torque is bounded. Rotations are those of the
/// child's frame in the parent's; axes are the parent frame's unless said otherwise.
struct MotorLanes {
    Wide4 target;   ///< Where the target is at the end of the step.
    Wide3 rate;     ///< rad/s: how it turns.
    Wide weight;    ///< N m s per rad/s: what spring and damper answer a speed with in a substep; 0: no motor here.
    Wide pull;      ///< 1/s: speed towards the target over the angle from it.
    Wide bound;     ///< N m s a substep.
    Wide3 bias;     ///< rad/s, world: the speed that the spring wants less of.
    Wide3 before;   ///< rad/s, world: how the joint turned at the substep's start.
    Wide3 impulse;  ///< N m s, world, on the child, of this substep.
    Wide work;      ///< J, of this substep.
    Wide gain;      ///< `weight` while the torque is within its bound, else 0; kept between substeps.
    int active;     ///< Whether any lane has one.
};

/// A frame in motion that a body is led to, one a lane; all of zeros where there is none. World axes.
struct TargetLanes {
    Wide3 goal;       ///< m/s: the body's velocity in this substep, were it alone with the spring.
    Wide3 turnGoal;   ///< rad/s
    Wide weight;      ///< N s per m/s: what the row answers a speed with.
    Wide turnWeight;  ///< N m s per rad/s
    Wide kinematic;   ///< 1 where the body follows exactly, else 0.
    Wide3 impulse;    ///< N s, of this substep.
    Wide3 torque;     ///< N m s, likewise.
    Wide3 position;   ///< Of the frame at the step's end.
    Wide4 rotation;
    Wide3 rate;        ///< m/s: how the frame moves.
    Wide3 turnRate;    ///< rad/s
    Wide pull;         ///< 1/s: speed towards the frame over the distance from it.
    Wide3 before;      ///< m/s: of the body at the substep's start.
    Wide3 turnBefore;  ///< rad/s
    Wide work;         ///< J, of this substep.
    int active;        ///< Whether any lane has one.
};

}  // namespace lutka::physics::crowd
