#pragma once

#include <vector>

#include "animation/humanoid/limb_candidates.hpp"

namespace lutka::animation {

/// What the joints in the middle are to given legs and arms: where they lie, what hangs on them, what skin they move.
/// Trunks are scored by it.
class TrunkMeasures {
  public:
    TrunkMeasures(const FramedRig& framed, const LimbCandidate& legs, const LimbCandidate& arms);

  protected:
    // A name's score from which it says chest, hips, or which part of the trunk this is.
    static constexpr float kNamedChest = 2.0F;
    static constexpr float kNamedHips = 4.0F;
    static constexpr float kNamedTrunk = 3.0F;

    [[nodiscard]] const vec3& position(int joint) const { return framed_.positions[joint]; }
    [[nodiscard]] float name(int joint, Part part) const { return rig_.names[joint].parts[part]; }
    [[nodiscard]] bool isCentral(int joint) const { return isCentral_[static_cast<std::size_t>(joint)]; }
    [[nodiscard]] int armRoot() const { return framed_.pairs[arms_.first].joints[0]; }
    [[nodiscard]] int legRoot() const { return framed_.pairs[legs_.first].joints[0]; }

    /// Share of the skin that a joint moves itself, or by leaves in the middle (rigid parts, collision volumes).
    [[nodiscard]] float ownSkin(int joint) const;
    /// Skin at and below a joint, without what goes on upwards along the middle: much for a head, little for a neck.
    [[nodiscard]] float retainedSkin(int joint) const { return rig_.subtreeWeight[joint] - skinOnwards(joint); }

    [[nodiscard]] bool isNamedTrunk(int joint) const;
    /// A head that is thrust forward is still one by its name.
    [[nodiscard]] bool isNamedHead(int joint) const;
    [[nodiscard]] bool isInPlaceOf(int joint, int other) const;
    /// Of a figure of rigid parts: the one part that its name tells as the trunk, between the thighs and the arms.
    [[nodiscard]] bool isTrunkBlock(int joint) const;
    /// A node without a mesh where its tree starts, named as no part: the file's, or a group in its place.
    [[nodiscard]] bool isFileRoot(int joint) const;
    /// Moves no skin, and a joint on it does, that starts the spine at the thighs' height: the armature's own node.
    [[nodiscard]] bool standsForSpine(int joint) const;
    /// "spine.005" goes on as "spine.006": where the spine is numbered up to the head, the last one is the head.
    [[nodiscard]] bool goesOnAlike(int joint) const;
    /// Named as the spine, and a joint without such a name hangs on it, as heavy: a head whose name says nothing.
    [[nodiscard]] bool isSpineBelowHead(int joint) const;
    /// Hangs on such a joint, where names tell the limbs: what the spine ends in is the head, however high it lies.
    [[nodiscard]] bool endsSpine(int joint) const;
    /// A leaf that moves next to nothing of what the joint above it does: a jaw, an eye.
    [[nodiscard]] bool isPartOfFace(int joint) const;
    /// Two joints of a face hang on it: eyes, ears. A face in its place is part of it.
    [[nodiscard]] bool carriesFace(int joint) const { return !rig_.names[joint].face && facesOn(joint) >= 2; }

    /// What carries limbs whose joints are all told is hips or chest by its name, in whatever frame a capture begins.
    [[nodiscard]] bool areToldHips(int joint) const;
    [[nodiscard]] bool isToldChest(int joint) const;
    [[nodiscard]] bool isTold() const { return framed_.stance.byNames && legs_.named && arms_.named; }

    /// What carries told legs and hangs, beside the spine, on a control of the whole body.
    [[nodiscard]] bool carriesLegsBelowControl(int joint) const;
    /// `below` hangs on another joint in this one's place: one of the two is a control rig's. A skin tells better
    /// which.
    [[nodiscard]] bool isCopyOfWhatCarries(int joint, int below) const;
    /// A trunk that carries its hips: robots whose body is the root. The hips are named so and carry the legs alone, or
    /// hang clearly below the chest with both thighs on them.
    [[nodiscard]] bool isTurnedOver(int chest, int hips) const;
    /// A head that everything hangs on: what carries the arms hangs below it.
    [[nodiscard]] bool carriesTrunk(int head) const { return armParent_ != kNoJoint && hangsBelow(armParent_, head); }

    const FramedRig& framed_;
    const RigFeatures& rig_;
    const LimbCandidate& legs_;
    const LimbCandidate& arms_;
    float length_;  // from the thighs up to the upper arms
    float slack_;   // limbs of one joint need not start at the shoulder and the hip
    int legParent_ = kNoJoint;
    int thighParent_ = kNoJoint;  // of both, where it is one
    int armParent_ = kNoJoint;
    int trunkRoot_ = kNoJoint;
    std::vector<int> central_;

  private:
    [[nodiscard]] bool standsInTheMiddle(int joint) const;
    [[nodiscard]] int facesOn(int joint) const;
    [[nodiscard]] float skinOnwards(int joint) const;
    [[nodiscard]] bool hangsBelow(int lower, int upper) const;

    std::vector<bool> isCentral_;
    std::vector<int> strayFaces_;  // per joint
};

}  // namespace lutka::animation
