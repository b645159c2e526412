#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "physics/profile/constraint_frames.hpp"
#include "physics/profile/profile.hpp"

namespace lutka::editor {

/// What the user changed of one body and of the constraint to its parent. It stays when the ragdoll is fitted anew.
struct PartEdits {
    std::optional<physics::BodyShape> shape;
    std::optional<RigidTransform> jointFromBody;
    std::optional<float> massKg;
    std::optional<physics::MuscleFactors> muscle;
    std::optional<physics::ConstraintProfile::Kind> kind;
    std::optional<physics::HingeLimits> hinge;
    std::optional<physics::ConeTwistLimits> cone;
    std::optional<physics::FrameEdit> frames;  ///< Against the frames of the fit, told from the body as edited.
    std::optional<float> frictionNm;
    std::optional<physics::JointSpring> spring;  ///< Its rest told in the frames as edited.

    [[nodiscard]] bool any() const {
        return shape || jointFromBody || massKg || muscle || kind || hinge || cone || frames || frictionNm || spring;
    }
};
/// By the body's name. No entry: nothing was changed.
using AllPartEdits = std::map<std::string, PartEdits>;

/// Whether two parts collide, against what the fit says; names of bodies, `first` before `second`.
struct PairEdit {
    std::string first;
    std::string second;
    bool collide = true;
};

/// The values of a body (and, unless it is the root, of its constraint) that differ from `plain`'s.
[[nodiscard]] PartEdits partEditsBetween(const physics::RagdollProfile& plain, int plainBody,
                                         const physics::RagdollProfile& given, int body);
/// The same for all bodies; those that only one of the profiles has are left out.
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
