#include "editor/document/body_shape.hpp"

#include <algorithm>
#include <cmath>

namespace lutka::editor {

using physics::BodyShape;

BodyShape shapeOfKind(const BodyShape& shape, BodyShape::Kind kind) {
    if (kind == shape.kind) return shape;
    vec3 half = shape.halfExtents;
    if (shape.kind == BodyShape::Kind::sphere) half = vec3(shape.radius);
    if (shape.kind == BodyShape::Kind::capsule) half = {shape.radius, shape.radius + shape.halfLength, shape.radius};
    BodyShape made = shape;
    made.kind = kind;
    switch (kind) {
        case BodyShape::Kind::box:
            made.halfExtents = half;
            break;
        case BodyShape::Kind::sphere:
            made.radius = std::cbrt(half.x * half.y * half.z);
            break;
        case BodyShape::Kind::capsule:
            made.radius = std::min(std::sqrt(half.x * half.z), half.y);
            made.halfLength = half.y - made.radius;
            break;
    }
    return made;
}

void setRadius(BodyShape& shape, float radius) {
    const float half = shape.halfLength + shape.radius;
    shape.radius = radius;
    if (shape.kind == BodyShape::Kind::capsule) shape.halfLength = std::max(half - radius, 0.0F);
}

}  // namespace lutka::editor
