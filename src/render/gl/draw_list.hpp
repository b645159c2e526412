#pragma once

#include <span>
#include <vector>

#include "render/bounds.hpp"
#include "render/frame.hpp"
#include "render/gl/frame_uniforms.hpp"

namespace lutka::render {

/// A frame's items sorted into instanced batches. Reused from frame to frame, so that a steady scene allocates nothing.
class DrawList {
  public:
    /// Instances that one draw call a mesh draws: instances[firstInstance, firstInstance + count).
    struct Batch {
        int what = 0;  ///< Index of the character, or ShapeKind as a number.
        int firstInstance = 0;
        int count = 0;
        float nearest = 0.0F;  ///< The least distance of its instances along the view, metres; may be negative.
    };
    /// The batches of one pass.
    struct Pass {
        std::vector<Batch> characters;
        std::vector<Batch> props;
    };

    /// Sorts, culls and packs; characters whose joints no longer fit into `mostJoints` are dropped. `jointBounds`
    /// gives, for a character's index, what jointBounds() gave for it.
    template <class JointBounds>
    void build(const FrameDescription& frame, const mat4& clipFromWorld, std::size_t mostJoints,
               const JointBounds& jointBounds) {
        begin(frame);
        for (const CharacterItem& item : frame.characters) {
            if (palettes_.size() + item.palette.size() > mostJoints) {
                firstPaletteJoint_.push_back(0);
                ++dropped_;
                continue;
            }
            addCharacter(item, posedBounds(jointBounds(item.character.index), item.palette, item.worldFromModel),
                         clipFromWorld);
        }
        for (const PropItem& item : frame.props)
            addProp(item);
        finish(frame);
    }

    [[nodiscard]] const Pass& shadow() const { return shadow_; }
    [[nodiscard]] const Pass& opaque() const { return opaque_; }
    [[nodiscard]] const Pass& translucent() const { return translucent_; }
    [[nodiscard]] std::span<const animation::SkinMatrix> palettes() const { return palettes_; }
    [[nodiscard]] std::span<const InstanceTexels> instances() const { return instances_; }
    [[nodiscard]] const BoundingSphere& casters() const { return casters_; }
    [[nodiscard]] int culled() const { return culled_; }
    [[nodiscard]] int dropped() const { return dropped_; }

  private:
    /// An item that a pass wants, before sorting.
    struct Entry {
        int what = 0;
        int item = 0;         ///< Index into the frame's list.
        float depth = 0.0F;   ///< Of its centre along the view, from the eye; far ones first where order matters.
        float radius = 0.0F;  ///< Of its bounds.
    };
    struct Entries {
        std::vector<Entry> shadow;
        std::vector<Entry> opaque;
        std::vector<Entry> translucent;

        void clear();
    };

    void begin(const FrameDescription& frame);
    void addCharacter(const CharacterItem& item, const BoundingSphere& bounds, const mat4& clipFromWorld);
    void addProp(const PropItem& item);
    void finish(const FrameDescription& frame);
    template <class Instance>
    void makeBatches(std::vector<Entry>& entries, bool sortByDepth, std::vector<Batch>& batches,
                     const Instance& instance);

    Pass shadow_;
    Pass opaque_;
    Pass translucent_;
    Entries characterEntries_;
    Entries propEntries_;
    std::vector<int> firstPaletteJoint_;  ///< One a character item.
    std::vector<animation::SkinMatrix> palettes_;
    std::vector<InstanceTexels> instances_;
    BoundingSphere casters_;
    vec3 forward_{0, 0, -1};
    vec3 eye_{0, 0, 0};
    int culled_ = 0;
    int dropped_ = 0;
};

}  // namespace lutka::render
