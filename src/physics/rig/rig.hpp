#pragma once

#include <span>
#include <vector>

#include "animation/skeleton.hpp"
#include "core/result.hpp"
#include "physics/profile/body_state.hpp"
#include "physics/profile/profile.hpp"

namespace lutka::physics {

/// How each joint of a skeleton follows the bodies (docs/architecture.md).
enum class JointDrive {
    mapped,    ///< Owns a body and takes its rotation; its translation comes from the bind pose (locked).
    chain,     ///< Lies between two mapped joints: takes its share of the rotation between them, and of the twist.
    follower,  ///< Keeps its local pose under its parent (fingers, face, hair, tips).
};

/// A profile bound to a skeleton: which joint each body drives and how every other joint follows. Immutable, shared by
/// all instances of one character; made once.
struct Rig {
    struct Joint {
        JointDrive drive = JointDrive::follower;
        int body = -1;            ///< mapped: the body. chain: the body at its lower end.
        int upperBody = -1;       ///< chain: the body at its upper end.
        float share = 0.0F;       ///< chain: the part of the rotation from upper to lower body that it takes, [0, 1].
        vec3 twistAxis{0, 0, 0};  ///< chain: shares only the twist about this axis (unit, model space in the bind pose:
                                  ///< limbs); zero: the whole rotation (the trunk bends as an arc).
        int base = -1;  ///< The joint whose frame `baseFromJoint` is relative to; mapped joints that are not below
                        ///< their parent body's joint in the file (feet under an IK root) name that joint here.
        RigidTransform baseFromJoint;  ///< Bind pose.
    };
    std::vector<Joint> joints;                      ///< One a joint of the skeleton.
    std::vector<int> order;                         ///< Evaluation order: every joint after its base.
    std::vector<int> jointOfBody;                   ///< One a body.
    std::vector<int> parentBody;                    ///< One a body; -1 for the root.
    std::vector<RigidTransform> bindModelFromBody;  ///< One a body.
    std::vector<RigidTransform> bodyFromJoint;      ///< One a body.

    /// The point where a body hangs on its parent body, in either's frame; unused for the root.
    struct Anchor {
        vec3 inParent{0, 0, 0};
        vec3 inChild{0, 0, 0};
    };
    std::vector<Anchor> anchors;  ///< One a body.
};

/// Binds by joint path, then by unique name. Fails with ErrorCode::input, naming every joint that is not there.
[[nodiscard]] Result<Rig> bindRig(const RagdollProfile& profile, const animation::Skeleton& skeleton);

/// Bodies at rest in a pose: `modelFromJoint` holds jointCount() frames, `bodies` one a body. The root body and all
/// rotations are exactly the pose's. The other positions are those that close the constraints: in the bind pose the
/// same, and a pose that stretches a joint or bends the spine does not tear the doll at its first step.
void bodiesFromPose(const Rig& rig, std::span<const RigidTransform> modelFromJoint,
                    const RigidTransform& worldFromModel, std::span<BodyState> bodies);

/// The pose that the bodies show, down the hierarchy, in model space. The root body places the root; every other mapped
/// joint keeps its bind translation, so that constraint stretch never shows in the skin. Followers keep the local pose
/// of `followerParentFromJoint` (parent-relative, jointCount() frames), or the bind pose's where it is empty.
/// Allocates nothing. `modelFromJoint` holds jointCount() frames.
void poseFromBodies(const Rig& rig, const animation::Skeleton& skeleton, std::span<const RigidTransform> worldFromBody,
                    const RigidTransform& worldFromModel, std::span<RigidTransform> modelFromJoint,
                    std::span<const RigidTransform> followerParentFromJoint = {});

}  // namespace lutka::physics
