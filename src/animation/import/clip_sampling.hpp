#pragma once

#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "animation/clip.hpp"
#include "animation/import/rigid_pose.hpp"

namespace lutka::animation::rig_import {

/// What sampling a clip needs of the file it came from. Clips that were not played yet share it and keep it alive.
class ClipFile {
  public:
    ClipFile(const NodeTree& nodes, std::span<const dmat4> bindSceneFromJoint, const dmat4& modelFromScene,
             const Skeleton& of);
    ClipFile(const ClipFile&) = delete;
    ClipFile& operator=(const ClipFile&) = delete;
    ~ClipFile() = default;

    /// Takes over the scene that the clips were made from, without its meshes and textures: last thing of an import.
    void keep(std::unique_ptr<Assimp::Importer> importer);

    const NodeTree tree;
    const RigidPoser poser;
    Skeleton skeleton;  ///< Only the parents.
    /// Marks the joints whose scale shows in a skin.
    [[nodiscard]] std::span<const bool> matters() const { return {matters_.get(), skeleton.parents.size()}; }

  private:
    std::unique_ptr<bool[]> matters_;
    std::unique_ptr<aiScene> scene_;
};

/// All animations as rigid poses at a fixed rate: that of their keys, times the smallest whole number that reaches 30
/// frames a second (at most 120), so that the frames fall on the keys. A clip starts at the file's time 0, or at its
/// first key when that lies further off than the clip is long. Clips that would be absurdly long are cut, with a
/// warning. Poses are made at their first use; until then `scene` must live: ClipFile::keep(). Scale that is dropped
/// is looked for in some frames only, at the extremes of its keys among them.
[[nodiscard]] std::vector<Clip> sampleAnimations(const aiScene& scene, const std::shared_ptr<const ClipFile>& file,
                                                 std::vector<std::string>& warnings);

}  // namespace lutka::animation::rig_import
