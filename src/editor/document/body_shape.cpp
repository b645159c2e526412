#include "editor/document/body_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "physics/collision/shape.hpp"

namespace lutka::editor {

using physics::BodyShape;

namespace {

// The box of a round shape that is as long as a hull and has its moments across; of a box that of its moments.
vec3 halfBoxLike(const physics::ConvexHull& hull, BodyShape::Kind kind) {
    constexpr float kRound = 1.1547F;  // a disc's mean square is r²/4, a square's h²/3
    const vec3 half = physics::halfBoxOfMoments(hull);
    if (kind != BodyShape::Kind::capsule) return half;
    return {kRound * half.x, 0.5F * (hull.high().y - hull.low().y), kRound * half.z};
}

}  // namespace

void setKind(physics::PrimitiveShape& shape, physics::PrimitiveShape::Kind kind) {
    if (kind == shape.kind) return;
    if (kind == BodyShape::Kind::hull) {
        shape.hull = physics::hullWithin(shape);
        shape.kind = kind;
        return;
    }
    vec3 half = physics::halfBox(shape);
    if (shape.kind == BodyShape::Kind::hull) half = halfBoxLike(*shape.hull, kind);
    shape.hull.reset();
    shape.kind = kind;
    switch (kind) {
        case BodyShape::Kind::hull:
            break;
        case BodyShape::Kind::box:
            shape.halfExtents = half;
            break;
        case BodyShape::Kind::sphere:
            shape.radius = std::cbrt(half.x * half.y * half.z);
            break;
        case BodyShape::Kind::capsule:
            shape.radius = std::min(std::sqrt(half.x * half.z), half.y);
            shape.halfLength = half.y - shape.radius;
            break;
    }
}

void setRadius(physics::PrimitiveShape& shape, float radius) {
    const float half = shape.halfLength + shape.radius;
    shape.radius = radius;
    if (shape.kind == BodyShape::Kind::capsule) shape.halfLength = std::max(half - radius, 0.0F);
}

Result<void> addShape(BodyShape& shape, physics::PrimitiveShape::Kind kind) {
    using Kind = physics::PrimitiveShape::Kind;
    if (shape.more.size() >= BodyShape::kMostAdded) {
        return Error{ErrorCode::usage, fmt::format("a body has {} shapes at most", 1 + BodyShape::kMostAdded), "",
                     "remove another one, or split the body"};
    }
    const physics::PrimitiveShape& main = shape;
    const float ahead = physics::supportExtent(main, {0, 0, 1});
    const float half = 0.5F * ahead;
    physics::AddedShape added;
    added.kind = kind;
    added.radius = half;
    added.halfLength = kind == Kind::capsule ? half : 0.0F;
    added.halfExtents = vec3(half);
    added.bodyFromShape.translation = {0, 0, ahead};
    shape.more.push_back(added);
    return {};
}

void removeShape(BodyShape& shape, std::size_t index) {
    if (index < shape.more.size()) shape.more.erase(shape.more.begin() + static_cast<std::ptrdiff_t>(index));
}

}  // namespace lutka::editor
