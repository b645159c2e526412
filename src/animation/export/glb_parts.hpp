#pragma once

#include <tiny_gltf.h>

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "animation/character.hpp"
#include "animation/export/glb_buffer.hpp"
#include "animation/export/reduce_keys.hpp"

namespace lutka::animation::glb {

/// The text with what isn't UTF-8 replaced by '?': JSON takes nothing else, and names come from all sorts of files.
[[nodiscard]] std::string utf8(std::string_view text);

/// Appends the inverse bind matrices of all joints and returns their accessor.
int addInverseBinds(const Skeleton& skeleton, BufferBuilder& buffer);

/// Appends one node a joint, in the bind pose (`parentFromJoint`), the roots below `wrapper`; the first one's index is
/// the number of nodes before. Returns the skin over all joints, with those inverse bind matrices.
int addSkeleton(const Skeleton& skeleton, std::span<const RigidTransform> parentFromJoint, int wrapper,
                int inverseBinds, tinygltf::Model& model);

/// Appends a mesh with one primitive and returns its index; its character's materials begin at `firstMaterial`.
int addMesh(const SkinnedMesh& mesh, int firstMaterial, int jointCount, BufferBuilder& buffer, tinygltf::Model& model);

/// Appends all materials and, as PNG files in the buffer, all textures. The first ones' indices are the numbers of
/// those before.
void addMaterials(const Character& character, BufferBuilder& buffer, tinygltf::Model& model);

/// One animation of one or more skeletons.
class AnimationBuilder {
  public:
    AnimationBuilder(const std::string& name, BufferBuilder& buffer, tinygltf::Model& model);
    ~AnimationBuilder();
    AnimationBuilder(const AnimationBuilder&) = delete;
    AnimationBuilder& operator=(const AnimationBuilder&) = delete;

    /// Adds the clip's kept keys: rotation and translation channels of the joints that leave `parentFromJoint`.
    /// Channels with the same times share them.
    void add(const Clip& clip, const KeptKeys& keys, std::span<const RigidTransform> parentFromJoint, int firstJoint);
    /// Appends the animation; one that moves nothing is left out.
    void finish();

  private:
    template <class Value>
    void addChannel(int node, const char* path, const std::vector<Value>& values, int type,
                    const std::vector<int>& frames, float framesPerSecond, bool stepped);
    template <class Value>
    void addValues(int node, const char* path, const std::vector<Value>& values, const Value& rest, int type,
                   const std::vector<int>& frames, float framesPerSecond, bool stepped);
    int timesOf(const std::vector<int>& frames, float framesPerSecond);

    BufferBuilder& buffer_;
    tinygltf::Model& model_;
    tinygltf::Animation animation_;
    std::map<std::pair<std::vector<int>, float>, int> times_;  // accessors
};

}  // namespace lutka::animation::glb
