#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "animation/humanoid/roles.hpp"
#include "core/rigid_transform.hpp"
#include "physics/profile/body_shape.hpp"
#include "physics/profile/muscle_profile.hpp"

namespace lutka::physics {

using animation::Role;

/// A rigid body that stands for the part of the character that one joint moves.
struct BodyProfile {
    std::string name;          ///< Of its own in the profile, not empty; a body with a role bears the role's name.
    std::optional<Role> role;  ///< The part of a humanoid that it is; none: a creature's, a tail, hair, a weapon.
    std::string mirror;        ///< The name of its counterpart on the other side where roles don't tell; or empty.
    std::string joint;         ///< The joint's name in the rig that the profile was made for.
    std::string jointPath;     ///< Its unique path (names from the root joined by '/').
    BodyShape shape;
    RigidTransform jointFromBody;       ///< Body origin = centre of mass and of the main shape; a capsule's axis is Y.
    float massKg = 1.0F;                ///< > 0.
    vec3 inertia{0.01F, 0.01F, 0.01F};  ///< Principal moments about the body's axes, kg m², > 0.
    MuscleFactors muscle;               ///< Of the joint above it, on RagdollProfile::muscles or what else powers it.
    std::optional<float> pinForceN;     ///< A powered doll holds it to its pose with at most so much, N, [0, 1e6];
                                        ///< unset: the root as PuppetSettings says, others not at all.
};

/// The limits of a hinge: rotation of the child about frame z, positive by the right-hand rule, 0 in the neutral pose.
struct HingeLimits {
    float lower = 0.0F;  ///< Radians, in [-pi, 0].
    float upper = 0.0F;  ///< Radians, in [0, pi].
};

/// The limits of a cone-twist joint about its neutral pose, where both frames agree.
///
/// Swing moves frame x (along the child) inside an elliptic cone about the parent frame's x: with the swing's rotation
/// vector s (perpendicular to x), (s.y / swingY)² + (s.z / swingZ)² <= 1. Twist is the remaining rotation about x.
struct ConeTwistLimits {
    float swingY = 0.0F;  ///< Radians, (0, pi): largest rotation about the parent frame's y (moves x towards ∓z).
    float swingZ = 0.0F;  ///< Radians, (0, pi): largest rotation about the parent frame's z (moves x towards ±y).
    float twist = 0.0F;   ///< Radians, (0, pi): twist stays in [-twist, twist].
};

/// A spring with a damper in a joint, which pulls it to where it rests: tails, hair, what stands up by itself. Solved
/// implicitly, so that no stiffness is too much; a motor in the joint takes its place while it is on.
struct JointSpring {
    float stiffness = 0.0F;  ///< N m/rad, >= 0; 0: the damper alone brakes.
    float damping = 0.0F;    ///< N m s/rad, >= 0.
    quat rest{1, 0, 0, 0};   ///< The child's frame in the parent's at rest, of length 1. Hinge: its turn about z.

    [[nodiscard]] bool works() const { return stiffness > 0.0F || damping > 0.0F; }
};

/// What links two bodies. The anchors are the same point in the bind pose; frame orientations are equal in the
/// constraint's neutral pose (the middle of its range), not in the bind pose:
/// R_worldFromParent · parentFromFrame.rotation == R_worldFromChild · childFromFrame.rotation.
struct ConstraintProfile {
    enum class Kind { hinge, coneTwist };
    Kind kind = Kind::coneTwist;
    int parent = 0;                  ///< Index into RagdollProfile::bodies.
    int child = 0;                   ///< Likewise; every body but the first is the child of exactly one constraint.
    RigidTransform parentFromFrame;  ///< Frame x: twist axis, along the child; frame z: hinge axis.
    RigidTransform childFromFrame;
    HingeLimits hinge;        ///< Used when kind is hinge.
    ConeTwistLimits cone;     ///< Used when kind is coneTwist.
    float frictionNm = 0.0F;  ///< Largest torque of dry friction in the joint, N m, >= 0. More: stiffer, calmer.
    JointSpring spring;       ///< Does nothing by default.
};

/// A checked, portable ragdoll: everything the simulation needs, nothing of a running world. Bodies come parents first;
/// bodies[0] is the root (the hips, where any body has a role). Serialisable; shared by any number of instances.
struct RagdollProfile {
    static constexpr int kVersion = 2;
    static constexpr int kOldestVersion = 1;  ///< Read and upgraded.
    static constexpr int kMostBodies = 256;

    std::string name;                    ///< The character's name.
    float heightM = 1.75F;               ///< Of the standing figure, metres, > 0; what tolerances are shares of.
    float totalMassKg = 75.0F;           ///< Sum of the bodies' masses, > 0.
    quat standardFromModel{1, 0, 0, 0};  ///< See HumanoidMap.
    std::vector<BodyProfile> bodies;
    std::vector<ConstraintProfile> constraints;  ///< constraints[i].child == i + 1.
    std::vector<std::pair<int, int>>
        filteredPairs;                     ///< Bodies that never collide, beside the linked ones; first < second.
    std::optional<MuscleProfile> muscles;  ///< Of a powered doll; unset: as it is powered, nothing of its own.
    /// What the fit had to bend, a sentence each with its figures (a limit widened to hold the bind pose). For people.
    std::vector<std::string> notes;
};

/// Index of the body with that role; -1 when there is none.
[[nodiscard]] int bodyOf(const RagdollProfile& profile, Role role);
/// Index of the body of that name; -1 when there is none.
[[nodiscard]] int bodyNamed(const RagdollProfile& profile, std::string_view name);
/// Gives the body a role and with it the role's name.
void setRole(BodyProfile& body, Role role);
/// Whether it is a humanoid's ragdoll: its bodies, or some of them, have roles.
[[nodiscard]] bool hasRoles(const RagdollProfile& profile);

/// The body on the other side: of the mirrored role, or the one that names this one or is named by it; -1 for those in
/// the middle and those without a counterpart.
[[nodiscard]] int counterpartOf(const RagdollProfile& profile, int body);
/// The role's side. Without a role: of two counterparts the earlier is the left one, all others are in the middle.
[[nodiscard]] animation::Side sideOf(const RagdollProfile& profile, int body);

/// The body's inertia, no principal moment of it below that of a radius of gyration of `leastGyration` metres on a
/// figure of 1.75 m (smaller and larger figures in proportion): what solvers condition thin bodies with. 0 changes
/// nothing.
[[nodiscard]] vec3 conditionedInertia(const RagdollProfile& profile, const BodyProfile& body, float leastGyration);

/// All that is wrong with a profile (indices, signs, ranges, non-finite numbers, cycles); empty when valid.
[[nodiscard]] std::vector<std::string> validate(const RagdollProfile& profile);

}  // namespace lutka::physics
