#pragma once

#include <string>

#include "animation/character.hpp"
#include "animation/import/gltf_file.hpp"

namespace lutka::test {

/// Adds a character with its skeleton, meshes and skin below a node of that name, which stands at `place`. Its joints
/// have the character's names, its meshes those of the node.
void addFigure(GltfFile& file, const animation::Character& character, const std::string& name,
               const vec3& place = vec3(0));

/// A file of two bipeds two metres apart, "Anna" at the origin and "Bert", who is 0.8 times as tall and has a second
/// coat of skin, and so the most vertices.
[[nodiscard]] GltfFile makePair();

}  // namespace lutka::test
