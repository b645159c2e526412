#pragma once

#include <span>
#include <vector>

#include "animation/character.hpp"
#include "animation/humanoid/map_humanoid.hpp"
#include "animation/segments/segment.hpp"
#include "physics/fit/fit_options.hpp"
#include "physics/fit/skin_point.hpp"
#include "physics/profile/optional_role.hpp"
#include "physics/profile/profile.hpp"

namespace lutka::physics {

/// A body to be made: whose it is and where its segment runs. Positions in the standard stance's axes.
struct PlannedBody {
    std::string name;                           ///< The role's or the segment's.
    std::optional<Role> role;                   ///< Unset: a segment.
    std::optional<animation::Segment> segment;  ///< Its hinge axis in the standard stance's axes.
    int joint = animation::kNoJoint;
    int parent = -1;  ///< Index of the parent body; -1 for the first.
    /// Index of the counterpart on the other side; its own for a body in the middle; -1: it has none.
    int mirror = -1;
    animation::Side side = animation::Side::center;
    vec3 start{0, 0, 0};          ///< The joint.
    vec3 end{0, 0, 0};            ///< The next joint down the limb, or the tip.
    bool endsAtJoint = false;     ///< False: `end` is a tip, from the skin or from proportions.
    std::vector<SkinPoint> skin;  ///< The vertices that the joint and what follows it own.
    bool posedApart = false;      ///< Its skin lies elsewhere than its counterpart's, though their joints mirror.
    bool holds = false;           ///< Its skin reaches beyond its counterpart's, as with a torch: that one's tells.
    bool asHull = false;          ///< Whether the convex hull of its skin is asked for as its shape.

    [[nodiscard]] vec3 direction() const;  ///< Unit, from start to end.
    [[nodiscard]] float length() const;
};

/// Which bodies a ragdoll will have and which part of the character each stands for.
struct BodyPlan {
    std::vector<PlannedBody> bodies;  ///< Parents first: those with roles, then the segments.
    std::vector<int> bodyOfJoint;     ///< One a joint of the skeleton: the body that its skin belongs to.
    float heightM = 0.0F;             ///< Of the standing figure: crown to sole.
    float middleX = 0.0F;             ///< The plane of symmetry, in the standard stance's axes.
    /// Whether every joint of a left body lies within kSymmetryTolerance · height of its right counterpart's mirror
    /// image, and the joints tell where the middle is at all. Left and right shapes are then made equal.
    bool symmetric = false;
    /// Where the trunk's skin was split by height because the rig leaves a trunk body next to none: the upper bounds of
    /// the trunk bodies from the hips on, but for the topmost; empty where the rig's own weights decide.
    std::vector<float> trunkBounds;
    std::vector<bool> held;  ///< One a joint: it moves what is held, which is no body's skin (jointsOfHeldWeapons()).

    [[nodiscard]] int bodyOf(Role role) const;
    /// -1 where there is none of that name.
    [[nodiscard]] int bodyNamed(std::string_view name) const;
    [[nodiscard]] vec3 mirror(const vec3& point) const { return {2.0F * middleX - point.x, point.y, point.z}; }
    /// Whether it and its counterpart on the other side get one shape.
    [[nodiscard]] bool isPaired(const PlannedBody& body) const {
        return symmetric && body.side != animation::Side::center && body.mirror >= 0 && !body.posedApart;
    }
    /// Whether its shape is made of its left counterpart's, which may come after it.
    [[nodiscard]] bool isMirrored(const PlannedBody& body) const {
        return isPaired(body) && body.side == animation::Side::right;
    }
};
inline constexpr float kSymmetryTolerance = 0.02F;
inline constexpr std::size_t kFewestShapePoints = 24;  ///< Of skin that tells a shape.

/// The direction in which a role's segment runs from its joint when the figure stands with arms hanging and palms to
/// the thighs, in the standard stance's axes; for the left side and the middle (mirror x for the right).
[[nodiscard]] vec3 standingDirection(Role role);

/// Which roles get a body: hips, spine, the topmost trunk role, head and the limbs, as far as they are mapped, and what
/// the options add; with the segments and the skin of each. The map must be a humanoid's with hips.
///
/// A joint's skin belongs to the first of these bodies that there is:
/// 1. the joint's own;
/// 2. that of the nearest joint above it with a role; a role without a body counts for the nearest role above with one;
/// 3. the one whose segment is nearest, as in rigs that hang limbs on control joints.
[[nodiscard]] BodyPlan planBodies(const animation::Character& character, const animation::HumanoidMap& map,
                                  const FitOptions& options, std::span<const animation::Segment> segments = {});

/// The same for a given set of roles, of which those without a joint are left out.
/// Segments get a body each; where there are roles, a segment without a parent hangs on the body that has its joint's
/// parent. Without roles the first segment is the root, and of the map only standardFromModel counts.
[[nodiscard]] BodyPlan planBodies(const animation::Character& character, const animation::HumanoidMap& map,
                                  std::span<const Role> roles, std::span<const animation::Segment> segments = {});

/// The body that carries a role's part: its own, else that of the nearest role above; 0 when there is none.
[[nodiscard]] int bodyCarrying(const BodyPlan& plan, Role role);

}  // namespace lutka::physics
