#include "physics/crowd/body_touches.hpp"

#include <glm/geometric.hpp>

#include "physics/crowd/bounds.hpp"

namespace lutka::physics::crowd {
namespace {

vec3 vectorOf(const float (&v)[3]) {
    return {v[0], v[1], v[2]};
}

std::uint64_t pairKey(const CrowdState& state, const BodyRef& a, const BodyRef& b, int index) {
    const auto numberOf = [&](const BodyRef& ref) {
        return static_cast<std::uint64_t>(state.dolls[ref.doll].firstBody) + static_cast<std::uint64_t>(ref.body) + 1;
    };
    return numberOf(a) << 36U | numberOf(b) << 8U | static_cast<std::uint64_t>(a.shape) << 6U |
           static_cast<std::uint64_t>(b.shape) << 4U | static_cast<std::uint64_t>(index);
}

}  // namespace

StepBody stepBody(const CrowdState& state, const Doll& doll, int body) {
    const Topology& topology = state.groupOf(doll).topology;
    const BodyConstants& constants = topology.bodies[body];
    const BodyState moving = bodyState(state, doll, body);
    const PlacedShape placed = placedShape(state, doll, body);
    const vec3 half = placed.axes[1] * constants.extent[1];
    StepBody step{};
    for (int i = 0; i < 3; ++i) {
        step.centre[i] = placed.position[i];
        step.half[i] = half[i];
        step.velocity[i] = moving.linearVelocity[i];
    }
    step.radius = constants.radius;
    step.halfLength = topology.isCore(body) ? constants.extent[1] : kBoxCore;  // of several shapes, too
    step.swing = glm::length(moving.angularVelocity) * constants.reach;
    step.size = constants.size;
    return step;
}

TouchRange touchRange(const CrowdState& state, float dt, float sideways) {
    return {state.tuning.pairMargin, kForesight * dt, sideways};
}

float distanceIn(const TouchRange& range, const StepBody& a, const StepBody& b) {
    return range.margin +
           range.seconds * (glm::length(vectorOf(a.velocity) - vectorOf(b.velocity)) + a.swing + b.swing);
}

void addTouch(const CrowdState& state, const BodyRef& a, const BodyRef& b, int index, const BodyTouch& at,
              std::vector<PairTouch>& out) {
    PairTouch touch{a.doll,
                    b.doll,
                    static_cast<std::uint16_t>(a.body),
                    static_cast<std::uint16_t>(b.body),
                    static_cast<std::uint8_t>(a.shape),
                    static_cast<std::uint8_t>(b.shape),
                    at,
                    {}};
    touch.carried.key = pairKey(state, a, b, index);
    if (const CarriedPush* push = state.carried.find(touch.carried.key))
        static_cast<CarriedPush&>(touch.carried) = *push;
    makeRoom(out, out.size() + 1);
    out.push_back(touch);
}

BodyTouch touchOf(const CoreTouchLanes& found, int lane) {
    return {{0, found.alongA.lane[lane], 0},
            {0, found.alongB.lane[lane], 0},
            found.radius.lane[lane],
            readVector(found.normal, lane),
            found.separation.lane[lane]};
}

void collideShapes(const CrowdState& state, const BodyRef& a, const StepBody& stepA, const BodyRef& b,
                   const StepBody& stepB, const TouchRange& range, std::vector<PairTouch>& out) {
    const float distance = distanceIn(range, stepA, stepB);
    const vec3 apart = vectorOf(stepA.centre) - vectorOf(stepB.centre);
    const float reach = stepA.size + stepB.size + distance;
    if (glm::dot(apart, apart) > reach * reach) return;
    touchAllShapes(state, a, b, distance,
                   [&](const BodyRef& shapeA, const BodyRef& shapeB, int index, const BodyTouch& touch) {
                       addTouch(state, shapeA, shapeB, index, touch, out);
                   });
}

void TouchSearch::flush() {
    if (count_ == 0) return;
    for (int lane = count_; lane < kLanes; ++lane) {
        stepA_[lane] = stepA_[0];
        stepB_[lane] = stepB_[0];
    }
    CoreTouchLanes found;
    const unsigned near = state_.kernels->touchCores(stepA_, stepB_, range_, found);
    for (int lane = 0; lane < count_; ++lane) {
        if (stepA_[lane]->halfLength == kBoxCore || stepB_[lane]->halfLength == kBoxCore)
            collideShapes(state_, a_[lane], *stepA_[lane], b_[lane], *stepB_[lane], range_, out_);
        else if ((near >> static_cast<unsigned>(lane) & 1U) != 0)
            addTouch(state_, a_[lane], b_[lane], 0, touchOf(found, lane), out_);
    }
    count_ = 0;
}

}  // namespace lutka::physics::crowd
