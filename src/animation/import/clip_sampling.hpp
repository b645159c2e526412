#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "animation/clip.hpp"
#include "animation/import/rigid_pose.hpp"
#include "animation/import/source_scene.hpp"

namespace lutka::animation::rig_import {

/// What sampling a clip needs of the file it came from. Clips that were not played yet share it and keep it alive.
class ClipFile {
  public:
    /// Takes nodes and clips over from the scene; `nodes` is its tree.
    ClipFile(const NodeTree& nodes, std::span<const dmat4> bindSceneFromJoint, const dmat4& modelFromScene,
             const Skeleton& of, SourceScene& scene);
    ClipFile(const ClipFile&) = delete;
    ClipFile& operator=(const ClipFile&) = delete;
    ~ClipFile() = default;

    const NodeTree tree;
    const RigidPoser poser;
    const std::vector<SourceTrs> own;  ///< The nodes' own poses in parts, one a node.
    const std::vector<SourceClip> clips;
    Skeleton skeleton;  ///< Only the parents.
    /// Marks the joints whose scale shows in a skin.
    [[nodiscard]] std::span<const bool> matters() const { return {matters_.get(), skeleton.parents.size()}; }

  private:
    std::unique_ptr<bool[]> matters_;
};

/// First and last key of a clip, in seconds; both 0 without keys.
[[nodiscard]] std::pair<double, double> spanOf(const SourceClip& clip);

/// The nodes' own poses with what the clip makes of them at a time in seconds, one element a node.
[[nodiscard]] std::vector<dmat4> parentFromNodes(const SourceScene& scene, const SourceClip& clip, double time);

/// Frames of all nodes in the scene; parents come before children, those of roots are below 0.
[[nodiscard]] std::vector<dmat4> sceneFromNodes(std::span<const int> parents, std::span<const dmat4> parentFromNode);

/// All clips as rigid poses at a fixed rate: that of their keys, times the smallest whole number that reaches 30 frames
/// a second (60 for splines, at most 120), so that the frames fall on the keys. A clip starts at the file's time 0, or
/// at its first key when that lies further off than the clip is long. Clips that would be absurdly long are cut, with a
/// warning. Poses are made at their first use. Scale that is dropped is looked for in some frames only, at the extremes
/// of its keys among them.
[[nodiscard]] std::vector<Clip> sampleAnimations(const std::shared_ptr<const ClipFile>& file,
                                                 std::vector<std::string>& warnings);

}  // namespace lutka::animation::rig_import
