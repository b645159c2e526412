#include "scene/description/free_places.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "physics/collision/shape.hpp"
#include "physics/world/doll_overlap.hpp"

namespace lutka::scene {

FreePlaces::FreePlaces(const FigureBounds& figure) : figure_(figure) {
    const Placed alone = bodiesAt(vec3(0), quat(1, 0, 0, 0));
    for (std::size_t i = 0; i < figure.bodies.size(); ++i)
        reach_ = std::max(
            reach_, glm::length(alone.worldFromBody[i].translation) + physics::boundingRadius(figure.bodies[i].shape));
}

FreePlaces::Placed FreePlaces::bodiesAt(const vec3& centre, const quat& turn) const {
    const RigidTransform worldFromStandard{turn, centre - turn * (0.5F * (figure_.low + figure_.high))};
    Placed placed{centre, {}};
    for (const FigureBody& body : figure_.bodies)
        placed.worldFromBody.push_back(worldFromStandard * body.standardFromBody);
    return placed;
}

float FreePlaces::depthIn(const Placed& a, const Placed& b) const {
    physics::DollOverlap overlap;
    for (std::size_t i = 0; i < figure_.bodies.size(); ++i) {
        overlap.add(0, figure_.bodies[i].shape, a.worldFromBody[i]);
        overlap.add(1, figure_.bodies[i].shape, b.worldFromBody[i]);
    }
    overlap.depths();
    return overlap.deepest();
}

float FreePlaces::depthAt(const vec3& centre, const quat& turn) const {
    const Placed placed = bodiesAt(centre, turn);
    float depth = 0.0F;
    for (const Placed& other : taken_)
        if (glm::distance(centre, other.centre) < 2.0F * reach_) depth = std::max(depth, depthIn(placed, other));
    return depth;
}

}  // namespace lutka::scene
