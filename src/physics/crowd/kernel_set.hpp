#pragma once

#include "physics/crowd/batch_view.hpp"
#include "physics/crowd/search_lanes.hpp"
#include "physics/crowd/substep_params.hpp"

namespace lutka::physics::crowd {

/// Passes of a mending.
enum class MendPass { more, last, probe };

/// The kernels of one instruction set. All sets do the same operations in the same order, without
/// approximate instructions; those that fuse multiply and add give the same bits.
struct Kernels {
    /// Rotation columns and world inertia from the rotation.
    void (*refresh)(const BatchView& batch);
    /// Bounds of every body for a step of `dt` s: its motion relative to the doll's first body, plus `margin` metres.
    void (*findBounds)(const BatchView& batch, float dt, float margin);
    /// Writes a bit mask of lanes whose bounds meet for every pair.
    void (*findSelfPairs)(const BatchView& batch, const SelfPair* pairs, int count, unsigned char* masks);
    /// The bodies of two dolls whose boxes meet once those of `a` are grown by `apart`. Returns how many there are;
    /// `out` has room for every pair.
    int (*findBodyPairs)(const DollBoxes& a, const DollBoxes& b, const float (&apart)[3], BodyPair* out);
    /// Of `count` boxes, sorted by their low ends along x, those after number `from` that meet it. Returns how many;
    /// `out` has room for all. Lanes after the last hold an empty box.
    int (*findBoxesAfter)(const BoxLanes* boxes, int count, int from, int* out);
    /// The nearest points of eight pairs of capsules or spheres. Returns a bit mask of the pairs that are in range.
    unsigned (*touchCores)(const StepBody* const (&a)[kLanes], const StepBody* const (&b)[kLanes],
                           const TouchRange& range, CoreTouchLanes& out);
    /// The same of two bodies of one doll, in all lanes.
    unsigned (*touchOwnCores)(const BatchView& batch, const SelfPair& pair, const TouchRange& range,
                              CoreTouchLanes& out);
    /// For each of some points, which come body by body, a bit mask of the lanes in which it is nearer to a plane
    /// (normal · p = offset) than `margin` and the way that the body's motion can take it in `seconds`.
    void (*findNearPlane)(const BatchView& batch, const PlanePoint* points, int count, const float (&normal)[3],
                          float offset, float margin, float seconds, unsigned char* lanes);
    /// Lowers the room of each body (BodyLanes::room) to what a search for contacts with a plane has covered: `margin`
    /// and the way that its motion can take it in `seconds`, or all that lies between it and the plane.
    void (*limitRoom)(const BatchView& batch, const float (&normal)[3], float offset, float margin, float seconds);
    /// Bounds of each doll: those of its bodies.
    void (*joinBounds)(const BatchView& batch, Wide3& low, Wide3& high);
    /// Of each doll, how far the surface of any of its bodies has moved at most since this was last asked, metres, and
    /// how fast any moves now, m/s.
    void (*takeWay)(const BatchView& batch, Wide& way, Wide& speed);
    /// Squares of the largest speed and turning rate among a doll's bodies.
    void (*findMotion)(const BatchView& batch, Wide& speed2, Wide& turn2);
    /// Gravity and damping, this substep's Jacobians and masses, then last substep's impulses.
    void (*begin)(const BatchView& batch, const SubstepParams& params);
    /// Solves all joints of each doll at once with the limits, friction and static contacts that hold. `first`: brings
    /// in last substep's impulses; otherwise does nothing where no contact was pressed again.
    void (*solve)(const BatchView& batch, const SubstepParams& params, int first);
    /// Whether a body, as it moves now, could meet static geometry in this substep that it has no contact with, or one
    /// that was left out for being too far off when the substep began.
    int (*outruns)(const BatchView& batch, const SubstepParams& params);
    /// Solves once more, with static contacts that have been found anew.
    void (*solveAgain)(const BatchView& batch, const SubstepParams& params);
    /// Whether any error of position is so large that it is to be mended.
    int (*needsMending)(const BatchView& batch, const SubstepParams& params);
    /// Takes in what pair contacts have made of the velocities, for mendOnce().
    void (*takeMotions)(const BatchView& batch);
    /// Adds to the velocities, not to the steady ones, what mends errors of position, in some lanes (a bit mask) with
    /// firm static contacts (SubstepTuning::wedgeFirmness). Returns a bit mask of the lanes that need another pass.
    /// What this one would run through holds there, and unless it is the last, arms are foreseen anew. A probe changes
    /// nothing but velocities, and returns 0.
    unsigned (*mendOnce)(const BatchView& batch, const SubstepParams& params, unsigned firmly, MendPass kind);
    /// Takes back all mending in some lanes, a bit mask. What lies deep in static geometry is moved out of it as a
    /// whole.
    void (*mendNot)(const BatchView& batch, const SubstepParams& params, unsigned lanes);
    /// Positions and orientations with the velocities, which are the steady ones again afterwards.
    void (*advance)(const BatchView& batch, const SubstepParams& params);
    /// Sets the view's live blocks, which all the others work on.
    void (*beginPairs)(PairsView& view, const SubstepParams& params);
    /// One sweep; returns whether any contact presses, or did before.
    int (*solvePairs)(const PairsView& view, const SubstepParams& params);
    /// Adds to the velocities what mends overlaps, for the time `sweep`, counted from 0; returns whether there was any.
    int (*mendPairs)(const PairsView& view, const SubstepParams& params, int sweep);
    /// Presses contacts anew after the dolls have answered, for the time `sweep`, counted from 0. Sets the view's
    /// changed blocks.
    void (*pressAgain)(PairsView& view, const SubstepParams& params, int sweep);
    /// Gives the supports what that held back from them.
    void (*pressRest)(const PairsView& view);
    /// Pushes the bodies with what the substep before left of the impulses.
    void (*carryPairs)(const PairsView& view);
    /// After answers: no doll that answered only itself keeps more energy than it had at the substep's start.
    void (*limitEnergy)(const BatchView& batch);
};

}  // namespace lutka::physics::crowd
