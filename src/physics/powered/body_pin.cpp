#include "physics/powered/body_pin.hpp"

#include <cmath>

namespace lutka::physics {
namespace {

// Around the centre, as wide as half a pelvis: three points that are not in a line hold an orientation.
constexpr float kReachM = 0.15F;
vec3 pointOf(std::size_t index) {
    const float angle = 2.0F * kPi / 3.0F * static_cast<float>(index);
    return {kReachM * std::cos(angle), 0.0F, kReachM * std::sin(angle)};
}

}  // namespace

BodyPin::BodyPin(World& world, DollId doll, int body) : world_(world) {
    drag_.doll = doll;
    drag_.body = body;
    drag_.maxForceN = 0.0F;
    for (std::size_t i = 0; i < ids_.size(); ++i) {
        drag_.bodyPoint = pointOf(i);
        ids_[i] = world.addDrag(drag_);
    }
}

BodyPin::~BodyPin() {
    for (const DragId id : ids_)
        if (world_.has(id)) world_.removeDrag(id);
}

void BodyPin::follow(const RigidTransform& from, const RigidTransform& to, float dt, float maxForceN) {
    drag_.maxForceN = maxForceN / static_cast<float>(ids_.size());
    for (std::size_t i = 0; i < ids_.size(); ++i) {
        drag_.bodyPoint = pointOf(i);
        drag_.worldTarget = to * drag_.bodyPoint;
        drag_.worldVelocity = (drag_.worldTarget - from * drag_.bodyPoint) / dt;
        if (world_.has(ids_[i])) world_.setDrag(ids_[i], drag_);
    }
}

}  // namespace lutka::physics
