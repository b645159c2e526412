#pragma once

#include <tiny_gltf.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "animation/character.hpp"
#include "animation/export/glb_buffer.hpp"

namespace lutka::animation::glb {

/// The text with what isn't UTF-8 replaced by '?': JSON takes nothing else, and names come from all sorts of files.
[[nodiscard]] std::string utf8(std::string_view text);

/// Appends one node a joint, in the bind pose (`parentFromJoint`), the roots below `wrapper`; joint j is node
/// `firstJoint + j`. Returns the skin over all joints.
int addSkeleton(const Skeleton& skeleton, std::span<const RigidTransform> parentFromJoint, int wrapper,
                BufferBuilder& buffer, tinygltf::Model& model);

/// Appends a mesh with one primitive and returns its index.
int addMesh(const SkinnedMesh& mesh, int jointCount, BufferBuilder& buffer, tinygltf::Model& model);

/// Appends all materials and, as PNG files in the buffer, all textures. Indices stay the character's.
void addMaterials(const Character& character, BufferBuilder& buffer, tinygltf::Model& model);

/// Appends the clip as an animation: rotation and translation channels of the joints that leave `parentFromJoint`.
/// A clip that moves nothing is left out.
void addAnimation(const Clip& clip, std::span<const RigidTransform> parentFromJoint, int firstJoint,
                  BufferBuilder& buffer, tinygltf::Model& model);

}  // namespace lutka::animation::glb
