#pragma once

/// What the search for contacts works with, eight wide.

#include "physics/crowd/wide.hpp"

namespace lutka::physics::crowd {

/// A pair of bodies of one doll that may collide, and the lanes in which their bounds meet.
struct SelfPair {
    int a;
    int b;
};

/// A point that a body can meet a plane with: a corner of a shape, or an end of its core with a radius around it.
struct PlanePoint {
    int body;
    int shape;       ///< Which of the body's shapes.
    int feature;     ///< Which point of it.
    float local[3];  ///< Body space.
    float radius;
};

/// Boxes around bodies or dolls, one a lane. Lanes without one hold an empty box (low above high).
struct BoxLanes {
    Wide3 low, high;
};

/// Those of a doll's bodies, and what bounds them all.
struct DollBoxes {
    const BoxLanes* boxes;
    int groups;  ///< BoxLanes.
    float low[3];
    float high[3];
};

/// Two bodies whose boxes meet, by their number in each doll.
struct BodyPair {
    int a;
    int b;
};

/// A body as the search for contacts sees it in one step. World space, SI units. Sixteen floats: the kernels read eight
/// of them at a time and transpose.
struct alignas(64) StepBody {
    float centre[3];
    float radius;   ///< Around the core.
    float half[3];  ///< From the centre to the end of a capsule's core.
    float swing;    ///< m/s by which turning can move a point of it.
    float velocity[3];
    float halfLength;  ///< Of the core; kBoxCore for a box, whose `half` means nothing.
    float size;        ///< Radius of a sphere around it.
    float unused[3];
};
inline constexpr float kBoxCore = -1.0F;

/// How near two bodies must be for a contact: `margin` metres and the way that they can make in `seconds`, of which
/// what does not bring them together counts by the share `sideways`.
struct TouchRange {
    float margin;
    float seconds;
    float sideways;
};

/// Where the cores of eight pairs of bodies are nearest.
struct CoreTouchLanes {
    Wide alongA, alongB;  ///< Metres from each body's centre along its core.
    Wide radius;          ///< Of both together.
    Wide3 normal;         ///< From B to A.
    Wide separation;      ///< Of the surfaces, metres.
};

}  // namespace lutka::physics::crowd
