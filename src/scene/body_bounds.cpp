#include "scene/body_bounds.hpp"

#include <glm/common.hpp>

namespace lutka::scene {

vec3 halfAabbOf(const physics::BodyShape& shape, const quat& rotation) {
    switch (shape.kind) {
        case physics::BodyShape::Kind::sphere:
            return vec3(shape.radius);
        case physics::BodyShape::Kind::capsule:
            return glm::abs(rotation * vec3(0, shape.halfLength, 0)) + vec3(shape.radius);
        case physics::BodyShape::Kind::box:
            break;
    }
    const mat3 r = glm::mat3_cast(rotation);
    return glm::abs(r[0]) * shape.halfExtents.x + glm::abs(r[1]) * shape.halfExtents.y +
           glm::abs(r[2]) * shape.halfExtents.z;
}

}  // namespace lutka::scene
