#include "scene/free_places.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "physics/collision/shape.hpp"

namespace lutka::scene {

FreePlaces::FreePlaces(const FigureBounds& figure) : figure_(figure) {
    const Placed alone = bodiesAt(vec3(0), quat(1, 0, 0, 0));
    for (std::size_t i = 0; i < figure.bodies.size(); ++i) {
        radius_.push_back(physics::boundingRadius(figure.bodies[i].shape));
        reach_ = std::max(reach_, glm::length(alone.worldFromBody[i].translation) + radius_[i]);
    }
}

FreePlaces::Placed FreePlaces::bodiesAt(const vec3& centre, const quat& turn) const {
    const RigidTransform worldFromStandard{turn, centre - turn * (0.5F * (figure_.low + figure_.high))};
    Placed placed{centre, {}};
    for (const FigureBody& body : figure_.bodies)
        placed.worldFromBody.push_back(worldFromStandard * body.standardFromBody);
    return placed;
}

float FreePlaces::depthIn(const Placed& a, const Placed& b) const {
    float depth = 0.0F;
    for (std::size_t i = 0; i < figure_.bodies.size(); ++i) {
        const RigidTransform& placeA = a.worldFromBody[i];
        if (glm::distance(placeA.translation, b.centre) > radius_[i] + reach_) continue;
        for (std::size_t k = 0; k < figure_.bodies.size(); ++k) {
            const RigidTransform& placeB = b.worldFromBody[k];
            if (glm::distance(placeA.translation, placeB.translation) > radius_[i] + radius_[k]) continue;
            depth = std::max(
                depth, -physics::distanceBetween(figure_.bodies[i].shape, placeA, figure_.bodies[k].shape, placeB));
        }
    }
    return depth;
}

float FreePlaces::depthAt(const vec3& centre, const quat& turn) const {
    const Placed placed = bodiesAt(centre, turn);
    float depth = 0.0F;
    for (const Placed& other : taken_)
        if (glm::distance(centre, other.centre) < 2.0F * reach_) depth = std::max(depth, depthIn(placed, other));
    return depth;
}

}  // namespace lutka::scene
