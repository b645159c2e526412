#pragma once

#include <vector>

#include "physics/crowd/state.hpp"

namespace lutka::physics::crowd {

/// A body of a doll, or one of its shapes.
struct BodyRef {
    int doll;
    int body;
    int shape = 0;
};

/// A body with its main shape as the kernels look at it, where it is now.
[[nodiscard]] StepBody stepBody(const CrowdState& state, const Doll& doll, int body);

/// How near bodies must be in a step of `dt` s to have a contact. `sideways`: see TouchRange.
[[nodiscard]] TouchRange touchRange(const CrowdState& state, float dt, float sideways = 1.0F);
/// The same for two bodies with the motion that they have, metres.
[[nodiscard]] float distanceIn(const TouchRange& range, const StepBody& a, const StepBody& b);

/// The contacts nearer than `distance` of each shape of one body with each of the other, their points in the bodies'
/// spaces: visit(shapeA, shapeB, indexOfTheirContact, touch).
template <class Visit>
void touchAllShapes(const CrowdState& state, const BodyRef& a, const BodyRef& b, float distance, Visit visit) {
    const Topology& topologyA = state.groupOf(state.dolls[a.doll]).topology;
    const Topology& topologyB = state.groupOf(state.dolls[b.doll]).topology;
    for (int shapeA = 0; shapeA < topologyA.shapeCount(a.body); ++shapeA) {
        const PlacedShape placedA = placedShape(state, state.dolls[a.doll], a.body, shapeA);
        for (int shapeB = 0; shapeB < topologyB.shapeCount(b.body); ++shapeB) {
            Touches<BodyTouch> found =
                touchBodies(placedA, placedShape(state, state.dolls[b.doll], b.body, shapeB), distance);
            for (int i = 0; i < found.count; ++i) {
                BodyTouch& touch = found.points[i];
                touch.localA = topologyA.inBody(a.body, shapeA, touch.localA);
                touch.localB = topologyB.inBody(b.body, shapeB, touch.localB);
                visit(BodyRef{a.doll, a.body, shapeA}, BodyRef{b.doll, b.body, shapeB}, i, touch);
            }
        }
    }
}

/// Adds a contact with the impulses that it had in the last step. `index`: which one of the two shapes' it is.
void addTouch(const CrowdState& state, const BodyRef& a, const BodyRef& b, int index, const BodyTouch& at,
              std::vector<PairTouch>& out);

/// The contact of two cores that a kernel has found.
[[nodiscard]] BodyTouch touchOf(const CoreTouchLanes& found, int lane);

/// Adds the contacts of two bodies of which one is a box or has several shapes.
void collideShapes(const CrowdState& state, const BodyRef& a, const StepBody& stepA, const BodyRef& b,
                   const StepBody& stepB, const TouchRange& range, std::vector<PairTouch>& out);

/// Contacts of pairs of bodies, eight pairs at a time, in the order in which the pairs come.
class TouchSearch {
  public:
    TouchSearch(const CrowdState& state, float dt, std::vector<PairTouch>& out)
        : state_(state), range_(touchRange(state, dt, state.tuning.sideways)), out_(out) {}

    /// `stepA` and `stepB` must stay until flush().
    void add(const BodyRef& a, const StepBody& stepA, const BodyRef& b, const StepBody& stepB) {
        a_[count_] = a;
        b_[count_] = b;
        stepA_[count_] = &stepA;
        stepB_[count_] = &stepB;
        if (++count_ == kLanes) flush();
    }

    /// Looks at those that wait for others.
    void flush();

  private:
    const CrowdState& state_;
    TouchRange range_;
    std::vector<PairTouch>& out_;
    int count_ = 0;
    BodyRef a_[kLanes]{};
    BodyRef b_[kLanes]{};
    const StepBody* stepA_[kLanes]{};
    const StepBody* stepB_[kLanes]{};
};

}  // namespace lutka::physics::crowd
