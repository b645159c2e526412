#pragma once

#include "core/result.hpp"
#include "physics/profile/profile.hpp"

namespace lutka::editor {

/// Makes it a shape of another kind that is as large: its box is the old one's as near as the kind allows, along the
/// same axes. A hull comes out within the old shape, of corners on its surface; the box of one has its moments.
void setKind(physics::PrimitiveShape& shape, physics::PrimitiveShape::Kind kind);

/// Another radius; a capsule keeps its length from end to end, as far as that is above twice the radius.
void setRadius(physics::PrimitiveShape& shape, float radius);

/// Gives a body another shape of that kind, half as thick as its main one and ahead of it (+Z), where it is seen. Fails
/// with ErrorCode::usage when it has as many as a body can have.
[[nodiscard]] Result<void> addShape(physics::BodyShape& shape, physics::PrimitiveShape::Kind kind);
/// Takes the further shape of that index away; of another index nothing.
void removeShape(physics::BodyShape& shape, std::size_t index);

}  // namespace lutka::editor
