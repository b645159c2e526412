#include "physics/powered/body_pin.hpp"

#include <cmath>

namespace lutka::physics {
namespace {

// Three points that are not in a line hold an orientation.
vec3 pointOf(std::size_t index, float reachM) {
    const float angle = 2.0F * kPi / 3.0F * static_cast<float>(index);
    return {reachM * std::cos(angle), 0.0F, reachM * std::sin(angle)};
}

}  // namespace

BodyPin::BodyPin(World& world, DollId doll, int body) : world_(world) {
    drag_.doll = doll;
    drag_.body = body;
    drag_.maxForceN = 0.0F;
    for (DragId& id : ids_)
        id = world.addDrag(drag_);
}

BodyPin::~BodyPin() {
    for (const DragId id : ids_)
        if (world_.has(id)) world_.removeDrag(id);
}

void BodyPin::follow(const RigidTransform& from, const RigidTransform& to, float dt, float maxForceN, float reachM) {
    drag_.maxForceN = maxForceN / static_cast<float>(ids_.size());
    for (std::size_t i = 0; i < ids_.size(); ++i) {
        drag_.bodyPoint = pointOf(i, reachM);
        drag_.worldTarget = to * drag_.bodyPoint;
        drag_.worldVelocity = (drag_.worldTarget - from * drag_.bodyPoint) / dt;
        if (world_.has(ids_[i])) world_.setDrag(ids_[i], drag_);
    }
}

}  // namespace lutka::physics
