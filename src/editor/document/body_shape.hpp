#pragma once

#include "physics/profile/profile.hpp"

namespace lutka::editor {

/// A shape of another kind that is as large: its box is the old one's as near as the kind allows, along the same axes.
[[nodiscard]] physics::BodyShape shapeOfKind(const physics::BodyShape& shape, physics::BodyShape::Kind kind);

/// Another radius; a capsule keeps its length from end to end, as far as that is above twice the radius.
void setRadius(physics::BodyShape& shape, float radius);

}  // namespace lutka::editor
