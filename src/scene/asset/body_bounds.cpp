#include "scene/asset/body_bounds.hpp"

#include "physics/collision/shape.hpp"

namespace lutka::scene {

vec3 halfAabbOf(const physics::BodyShape& shape, const quat& rotation) {
    const quat back = glm::conjugate(rotation);
    return {physics::halfWidth(shape, back * vec3(1, 0, 0)), physics::halfWidth(shape, back * vec3(0, 1, 0)),
            physics::halfWidth(shape, back * vec3(0, 0, 1))};
}

}  // namespace lutka::scene
