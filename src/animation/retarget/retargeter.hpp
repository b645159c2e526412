#pragma once

#include <array>
#include <span>
#include <vector>

#include "animation/retarget/anatomical_rig.hpp"

namespace lutka::animation {

/// Where the source's figure is put on the target's floor.
struct RetargetPlacement {
    float sourceFloor = 0.0F;  ///< Standard height of the floor that the source walks on, metres.
};

/// How the target's hips and legs are moved after all else, in standard space.
struct FootShift {
    vec3 hips{0, 0, 0};          ///< Added to the hips' place.
    vec3 hipsTurn{0, 0, 0};      ///< Rotation vector: the hips are turned by it on top of all else, about the middle of
                                 ///< the hip joints; the trunk above takes it back from joint to joint.
    std::array<vec3, 2> feet{};  ///< Added to the ankles' places, left and right; the knees give way.
};

/// Takes poses of one humanoid to another: the anatomical axes (AnatomicalRig) of each role turn in the target as they
/// do in the source, so that limbs point the same ways in standard space, whatever the rigs' joint axes and bind poses.
/// Each joint of the target's trunk takes the turn that the source's trunk has at its height; joints within a limb
/// share the twist of the bone; fingers go by name and order. The middle of the hip joints moves as the source's, in
/// proportion to leg length. A limb of a single joint points to where the source's ends.
///
/// Immutable after make(); pose() works in buffers of its own and allocates nothing, so that one retargeter serves one
/// thread. Both characters must outlive it.
class Retargeter {
  public:
    /// Fails with ErrorCode::input when one is no humanoid with a head and legs (makeAnatomicalRig).
    [[nodiscard]] static Result<Retargeter> make(const Character& source, const HumanoidMap& sourceMap,
                                                 const Character& target, const HumanoidMap& targetMap);

    [[nodiscard]] const AnatomicalRig& source() const { return source_; }
    [[nodiscard]] const AnatomicalRig& target() const { return target_; }
    /// Target metres a source metre.
    [[nodiscard]] float scale() const { return target_.legLength / source_.legLength; }

    /// `sourceParentFromJoint` is a pose of the source, parent-relative, `targetParentFromJoint` becomes the target's.
    /// Joints that follow nothing keep their bind pose, but for those that move skin: what lies above the hips in the
    /// file goes along with them, what lies beside the figure (a hat with a skeleton of its own) with the nearest
    /// joint.
    void pose(std::span<const RigidTransform> sourceParentFromJoint, const RetargetPlacement& placement,
              std::span<RigidTransform> targetParentFromJoint);
    /// The same with the legs moved.
    void pose(std::span<const RigidTransform> sourceParentFromJoint, const RetargetPlacement& placement,
              const FootShift& shift, std::span<RigidTransform> targetParentFromJoint);

    /// Of the last pose(), standard space: every joint of the source, and of the target before it became
    /// parent-relative.
    [[nodiscard]] std::span<const RigidTransform> sourcePose() const { return sourceStandard_; }
    [[nodiscard]] std::span<const RigidTransform> targetPose() const { return targetStandard_; }

  private:
    /// A joint of the target that the source moves, or that lies between such.
    struct Driven {
        enum class By { hips, role, trunk, twist, finger, carried };
        By by = By::carried;
        int joint = kNoJoint;
        int base = kNoJoint;           // the joint whose frame `baseFromJoint` is relative to, driven before
        RigidTransform baseFromJoint;  // bind pose
        quat jointFromAnatomy{1, 0, 0, 0};
        Role role = Role::hips;      // role, and of twist: the bone's
        std::size_t trunk = 0;       // lower neighbour in the source's trunk
        float share = 0.0F;          // trunk: between neighbours; twist: of the bone's whole
        float hipsTurn = 0.0F;       // hips and trunk: its part of a turn of the hips
        int sourceJoint = kNoJoint;  // finger
        quat sourceFromAnatomy{1, 0, 0, 0};
    };
    Retargeter(AnatomicalRig source, AnatomicalRig target, const Character& character);
    void planTrunk();
    void planLimbs();
    void planFingers();
    void planCarried(const Character& character);
    [[nodiscard]] int drivenAbove(int joint) const;
    [[nodiscard]] int carrierOf(int joint) const;
    Driven& plan(int joint, int otherwiseBelow);
    void planBone(Role from, Role to);
    [[nodiscard]] quat sourceAxes(Role role) const;
    [[nodiscard]] quat twistOf(const Driven& driven) const;
    [[nodiscard]] quat rotationOf(const Driven& driven) const;
    void turnJoints(const vec3& hipsTurn);
    void placeJoints(const RetargetPlacement& placement, const vec3& hipsShift);
    void leanTrunk();
    void bendLeg(int side, const vec3& shift);
    void straightenLimbs(const RetargetPlacement& placement);
    void writeLocals(std::span<RigidTransform> targetParentFromJoint) const;

    AnatomicalRig source_;
    AnatomicalRig target_;
    std::vector<Driven> driven_;
    std::vector<bool> isDriven_;
    vec3 hipsFromMiddle_{0, 0, 0};  // of the target's bind pose, standard: from between the legs to the hips' joint
    std::vector<RigidTransform> sourceLocal_;  // with the ends of limbs that were added
    std::vector<RigidTransform> sourceStandard_;
    std::vector<RigidTransform> targetStandard_;
    std::vector<RigidTransform> targetBindLocal_;
};

}  // namespace lutka::animation
