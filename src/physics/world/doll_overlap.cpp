#include "physics/world/doll_overlap.hpp"

#include <algorithm>

#include "physics/collision/shape.hpp"

namespace lutka::physics {

void DollOverlap::add(int doll, const BodyShape& shape, const RigidTransform& worldFromBody) {
    const mat3 bodyFromWorld = glm::mat3_cast(glm::conjugate(worldFromBody.rotation));
    const vec3& centre = worldFromBody.translation;
    vec3 half;
    for (int axis = 0; axis < 3; ++axis)
        half[axis] = halfWidth(shape, bodyFromWorld[axis]) + 0.5F * kNear;
    bodies_.push_back({&shape, worldFromBody, centre - half, centre + half, doll});
}

void DollOverlap::add(int doll, const RagdollProfile& profile, std::span<const BodyState> bodies) {
    for (std::size_t i = 0; i < bodies.size(); ++i)
        add(doll, profile.bodies[i].shape, bodies[i].worldFromBody);
}

void DollOverlap::measure(const Body& a, const Body& b) {
    if (a.doll == b.doll || a.low.y > b.high.y || b.low.y > a.high.y || a.low.z > b.high.z || b.low.z > a.high.z)
        return;
    const float distance = distanceBetween(*a.shape, a.worldFromBody, *b.shape, b.worldFromBody);
    if (distance < kNear) depths_.push_back(std::max(-distance, 0.0F));
}

std::span<const float> DollOverlap::depths() {
    depths_.clear();
    std::sort(bodies_.begin(), bodies_.end(), [](const Body& a, const Body& b) { return a.low.x < b.low.x; });
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        for (std::size_t j = i + 1; j < bodies_.size() && bodies_[j].low.x <= bodies_[i].high.x; ++j)
            measure(bodies_[i], bodies_[j]);
    }
    return depths_;
}

float DollOverlap::deepest() const {
    return depths_.empty() ? 0.0F : *std::max_element(depths_.begin(), depths_.end());
}

}  // namespace lutka::physics
