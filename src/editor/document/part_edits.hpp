#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "animation/humanoid/roles.hpp"
#include "physics/profile/constraint_frames.hpp"
#include "physics/profile/profile.hpp"

namespace lutka::editor {

/// What the user changed of one body and of the constraint that hangs it on its parent, whatever a new fit says.
struct PartEdits {
    std::optional<physics::BodyShape> shape;
    std::optional<RigidTransform> jointFromBody;
    std::optional<float> massKg;
    std::optional<physics::ConstraintProfile::Kind> kind;
    std::optional<physics::HingeLimits> hinge;
    std::optional<physics::ConeTwistLimits> cone;
    std::optional<physics::FrameEdit> frames;  ///< Against the frames of the fit, told from the body as edited.
    std::optional<float> frictionNm;

    [[nodiscard]] bool any() const {
        return shape || jointFromBody || massKg || kind || hinge || cone || frames || frictionNm;
    }
};
/// By the body's role.
using AllPartEdits = std::array<PartEdits, animation::kRoleCount>;

/// Whether two parts collide, against what the fit says; `first` before `second` in the order of roles.
struct PairEdit {
    animation::Role first = animation::Role::hips;
    animation::Role second = animation::Role::hips;
    bool collide = true;
};

/// The values of a body (and, unless it is the root, of its constraint) that differ from `plain`'s.
[[nodiscard]] PartEdits partEditsBetween(const physics::RagdollProfile& plain, int plainBody,
                                         const physics::RagdollProfile& given, int body);
/// The same for all bodies, by role; roles that only one of the profiles has are left out.
[[nodiscard]] AllPartEdits editsBetween(const physics::RagdollProfile& fitted, const physics::RagdollProfile& given);
[[nodiscard]] std::vector<PairEdit> pairEditsBetween(const physics::RagdollProfile& fitted,
                                                     const physics::RagdollProfile& given);

/// `edits` with what is unset in them taken from `others`.
void fillUnset(AllPartEdits& edits, const AllPartEdits& others);
void fillUnset(std::vector<PairEdit>& edits, std::span<const PairEdit> others);
/// Puts one in place of the edit of the same pair.
void setPair(std::vector<PairEdit>& edits, PairEdit edit);

/// `base` with the edits on it: the total mass is the new sum, inertias follow shape and mass.
[[nodiscard]] physics::RagdollProfile applyEdits(const physics::RagdollProfile& base, const AllPartEdits& edits,
                                                 std::span<const PairEdit> pairs = {});

}  // namespace lutka::editor
