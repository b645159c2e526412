#include "physics/doctor/doctor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <initializer_list>

#include "animation/humanoid/role_hierarchy.hpp"
#include "physics/collision/shape.hpp"
#include "physics/doctor/broken_figure.hpp"
#include "physics/doctor/shape_faults.hpp"
#include "physics/fit/anatomy.hpp"
#include "physics/fit/fit_shapes.hpp"
#include "physics/fit/profile_plan.hpp"
#include "physics/fit/rebind.hpp"
#include "physics/profile/constraint_state.hpp"
#include "physics/profile/joint_range.hpp"

namespace lutka::physics {
namespace {

constexpr float kHighRatio = 10.0F;
constexpr float kExtremeRatio = 20.0F;
constexpr float kPoint = 5e-3F;         // of the height: joints nearer to each other stand in one place
constexpr float kMostWithAir = 90.0F;   // points of a figure one of whose bodies is where nothing is
constexpr float kMostOfBroken = 40.0F;  // points that a figure whose skin or limbs are elsewhere can have

std::string nameOf(Role role) {
    return std::string(roleName(role));
}

const char* wordsOf(animation::Hanging hanging) {
    if (hanging == animation::Hanging::reversed) return "is above";
    return hanging == animation::Hanging::astray ? "hangs on another limb than" : "is not below";
}

// One look at a profile on its character; each check adds its findings.
class Examination {
  public:
    Examination(const RagdollProfile& profile, const animation::Character& character, const animation::HumanoidMap& map)
        : profile_(profile),
          map_(map),
          plan_(planOfProfile(profile, character, map)),
          places_(placesInPlan(profile, plan_)),
          anatomy_(findAnatomy(plan_)),
          shapes_(shapesInBindPose(profile, character.skeleton)),
          newShapes_(plan_, anatomy_, mostShapesOf(profile), profile.heightM) {}

    void checkMap(Diagnosis& diagnosis) {
        if (!hasRoles(profile_)) {
            diagnosis.findings.push_back(
                {Severity::info,
                 "not-humanoid",
                 "",
                 "no body has a role: role-unmapped, roles-few, joint-not-below, limb-uneven, hinge-reversed and "
                 "hinge-askew do not apply",
                 "",
                 false,
                 {}});
            return;
        }
        constexpr std::size_t kMostMissing = 7;  // of the 15 required roles
        if (map_.missing.size() > kMostMissing && !isWholeOfBlocks()) {
            broken_ = true;
            diagnosis.findings.push_back({Severity::error,
                                          "roles-few",
                                          "/bodies",
                                          fmt::format("{} of the 15 required parts have no joint", map_.missing.size()),
                                          "bind them by hand if the rig has such joints",
                                          false,
                                          {}});
        }
        for (const Role role : map_.missing) {
            diagnosis.findings.push_back({Severity::warning,
                                          "role-unmapped",
                                          nameOf(role),
                                          "a required role without a joint",
                                          "bind it by hand if the rig has such a joint",
                                          false,
                                          {nameOf(role)}});
        }
    }

    // Every joint but the root's should hang below the joint that its body hangs on: else the file's hierarchy does not
    // move the limb as the ragdoll does, or the role is on a wrong joint.
    void checkHierarchy(Diagnosis& diagnosis, const animation::Skeleton& skeleton) {
        const bool flat = animation::hangsFlat(map_, skeleton.parents);
        const bool anyPair = std::any_of(
            profile_.constraints.begin(), profile_.constraints.end(),
            [&](const ConstraintProfile& c) { return sidesHangBeside(skeleton, roleOf(c.child), roleOf(c.parent)); });
        for (const ConstraintProfile& c : profile_.constraints) {
            const std::optional<Role> role = roleOf(c.child);
            const std::optional<Role> above = roleOf(c.parent);
            const animation::Hanging hanging = hangingOf(skeleton, role, above);
            if (hanging == animation::Hanging::below) continue;
            // Flat trees, a spine beside the pelvis, and pairs of limbs that hang beside their bodies on both sides
            // (feet driven by inverse kinematics; then maybe the head as well) are built so, and fall well. Where the
            // other limb is missing nothing speaks against it.
            const bool center = animation::sideOf(*role) == animation::Side::center;
            const bool siblings =
                skeleton.parents[map_.jointOf(*role)] == skeleton.parents[map_.jointOf(*above)] || isSpine(*role);
            const bool built = (hanging == animation::Hanging::beside &&
                                (flat || (center ? anyPair || siblings : sidesHangBeside(skeleton, role, above)))) ||
                               (hanging == animation::Hanging::reversed && carriesLegsAlone(skeleton) &&
                                (*role == Role::head || (isSpine(*role) && *above == Role::hips)));
            astray_ += built ? 0 : 1;
            diagnosis.findings.push_back({built ? Severity::warning : Severity::error, "joint-not-below", link(c),
                                          fmt::format("the joint \"{}\" {} \"{}\"", skeleton.names[map_.jointOf(*role)],
                                                      wordsOf(hanging), skeleton.names[map_.jointOf(*above)]),
                                          "map a joint below it, unless the rig drives this limb by an IK root", false,
                                          childOf(c)});
        }
    }

    // A role on a joint farther out or in makes one half of a limb many times as long as the other. Of 110 limbs of
    // real figures the most is 2.5 times.
    void checkLimbs(Diagnosis& diagnosis, const animation::Skeleton& skeleton) {
        constexpr float kMostUneven = 3.0F;
        using Limb = std::array<Role, 3>;
        constexpr std::array<Limb, 4> kLimbs{Limb{Role::leftUpperArm, Role::leftLowerArm, Role::leftHand},
                                             Limb{Role::rightUpperArm, Role::rightLowerArm, Role::rightHand},
                                             Limb{Role::leftUpperLeg, Role::leftLowerLeg, Role::leftFoot},
                                             Limb{Role::rightUpperLeg, Role::rightLowerLeg, Role::rightFoot}};
        for (const auto& [upper, lower, end] : kLimbs) {
            const int middle = bodyOf(profile_, lower);
            const std::array<int, 3> joints{map_.jointOf(upper), map_.jointOf(lower), map_.jointOf(end)};
            if (middle < 0 || *std::min_element(joints.begin(), joints.end()) == animation::kNoJoint) continue;
            const auto lengthTo = [&](int i) {
                return glm::distance(skeleton.bindModelFromJoint[joints[i - 1]].translation,
                                     skeleton.bindModelFromJoint[joints[i]].translation);
            };
            const auto [shorter, longer] = std::minmax({lengthTo(1), lengthTo(2)});
            // Joints in one place are told as such.
            if (shorter < kPoint * profile_.heightM || longer <= kMostUneven * shorter) continue;
            const Role longHalf = lengthTo(1) > lengthTo(2) ? upper : lower;
            diagnosis.findings.push_back({Severity::warning,
                                          "limb-uneven",
                                          nameOf(lower),
                                          fmt::format("{} is {:.1f} times as long as the other half of the limb",
                                                      nameOf(longHalf), longer / shorter),
                                          "map the joints at the elbow or knee and at the wrist or ankle",
                                          false,
                                          {nameOf(lower)}});
        }
    }

    void checkMasses(Diagnosis& diagnosis) {
        for (const ConstraintProfile& c : profile_.constraints) {
            const float parent = profile_.bodies[c.parent].massKg;
            const float child = profile_.bodies[c.child].massKg;
            const float ratio = std::max(parent, child) / std::min(parent, child);
            worstRatio_ = std::max(worstRatio_, ratio);
            if (ratio <= kHighRatio) continue;
            diagnosis.findings.push_back({ratio > kExtremeRatio ? Severity::error : Severity::warning, "mass-ratio",
                                          link(c), fmt::format("{:.1f} : 1, at most 10 : 1", ratio),
                                          "balance the masses", true, childOf(c)});
        }
    }

    void checkLimits(Diagnosis& diagnosis) {
        for (const ConstraintProfile& c : profile_.constraints) {
            const float outside =
                measureConstraint(c, shapes_[c.parent].standardFromBody, shapes_[c.child].standardFromBody).violation;
            if (outside > radians(0.05F)) {
                ++brokenLimits_;
                diagnosis.findings.push_back({Severity::error, "bind-outside-limits", link(c),
                                              fmt::format("the bind pose is {:.1f} degrees outside", degrees(outside)),
                                              "widen the limit to hold the bind pose", true, childOf(c)});
            }
            const float span = c.kind == ConstraintProfile::Kind::hinge
                                   ? 0.5F * (c.hinge.upper - c.hinge.lower)
                                   : std::min({c.cone.swingY, c.cone.swingZ, c.cone.twist});
            if (span < radians(5.0F)) {
                diagnosis.findings.push_back({Severity::warning, "limit-span-small", link(c),
                                              fmt::format("{:.1f} degrees either way, at least 5", degrees(span)),
                                              "widen the limit; a narrow one jitters", false, childOf(c)});
            }
            checkReach(diagnosis, c);
            checkHinge(diagnosis, c);
        }
    }

    void checkOverlaps(Diagnosis& diagnosis) const {
        for (const BodyOverlap& overlap : findOverlaps(profile_, shapes_)) {
            const std::string& first = profile_.bodies[overlap.first].name;
            const std::string& second = profile_.bodies[overlap.second].name;
            const bool deep = overlap.depthM > 0.01F * profile_.heightM;
            diagnosis.findings.push_back({deep ? Severity::error : Severity::warning,
                                          "overlap",
                                          fmt::format("{} and {}", first, second),
                                          fmt::format("{:.1f} mm deep in the bind pose", 1000.0F * overlap.depthM),
                                          "filter the pair, or shrink one of the shapes",
                                          true,
                                          {first, second}});
        }
    }

    void checkShapes(Diagnosis& diagnosis) {
        for (int body = 0; body < static_cast<int>(profile_.bodies.size()); ++body)
            checkShape(diagnosis, body);
        for (const ConstraintProfile& c : profile_.constraints) {
            const float distance =
                glm::distance(plan_.bodies[indexOf(c.parent)].start, plan_.bodies[indexOf(c.child)].start);
            if (c.parent == 0 || distance >= kPoint * profile_.heightM) continue;
            diagnosis.findings.push_back({Severity::warning, "chain-degenerate", link(c),
                                          fmt::format("joints {:.1f} mm apart", 1000.0F * distance),
                                          "leave one of the two roles without a body", false, childOf(c)});
        }
    }

    void checkSides(Diagnosis& diagnosis) const {
        constexpr float kDifference = 0.1F;
        if (!plan_.symmetric) return;
        for (int index = 0; index < static_cast<int>(profile_.bodies.size()); ++index) {
            const BodyProfile& left = profile_.bodies[index];
            const int other = counterpartOf(profile_, index);
            if (sideOf(profile_, index) != animation::Side::left || other < 0) continue;
            if (plan_.bodies[indexOf(index)].posedApart) continue;
            const BodyProfile& right = profile_.bodies[other];
            const auto differ = [](float a, float b) { return std::abs(a - b) / std::max(a, b); };
            const float size = differ(shapeVolume(left.shape), shapeVolume(right.shape));
            const float mass = differ(left.massKg, right.massKg);
            if (size <= kDifference && mass <= kDifference && left.shape.kind == right.shape.kind) continue;
            diagnosis.findings.push_back(
                {Severity::warning,
                 "sides-differ",
                 left.name + " and " + right.name,
                 fmt::format("volume by {:.0f} %, mass by {:.0f} %, at most 10", 100.0F * size, 100.0F * mass),
                 "give both sides the mean",
                 true,
                 {left.name, right.name}});
        }
    }

    void measure(Diagnosis& diagnosis, const animation::Character& character) const {
        diagnosis.fit = measureSkin(character, plan_, shapesOfPlan(), map_.standardFromModel);
        for (const BodyOverlap& overlap : findOverlaps(profile_, shapes_))
            diagnosis.fit.overlapM = std::max(diagnosis.fit.overlapM, overlap.depthM);
    }

    void score(Diagnosis& diagnosis) const {
        const auto part = [&](const char* name, float of, float share) {
            diagnosis.parts.push_back({name, of * std::clamp(share, 0.0F, 1.0F), of});
        };
        constexpr float kRequiredRoles = 15.0F;
        if (hasRoles(profile_)) part("map", 15, 1.0F - static_cast<float>(map_.missing.size()) / kRequiredRoles);
        part("masses", 10, (3.0F * kHighRatio - worstRatio_) / (2.0F * kHighRatio));
        const auto count = static_cast<float>(std::max<std::size_t>(profile_.constraints.size(), 1));
        part("limits", 20, 1.0F - 3.0F * static_cast<float>(brokenLimits_) / count);
        part("overlap", 15, 1.0F - diagnosis.fit.overlapM / (0.05F * profile_.heightM));
        if (diagnosis.fit.vertices > 0) part("skin near", 25, (diagnosis.fit.skinNear - 0.3F) / 0.6F);
        if (diagnosis.fit.volumeCovered) part("volume covered", 15, *diagnosis.fit.volumeCovered / 0.8F);
        float points = 0.0F;
        float of = 0.0F;
        for (const ScorePart& p : diagnosis.parts) {
            points += p.points;
            of += p.of;
        }
        diagnosis.score = 100.0F * points / of;
        if (inTheAir_) diagnosis.score = std::min(diagnosis.score, kMostWithAir);
        if (astray_ > 0 || broken_) diagnosis.score = std::min(diagnosis.score, kMostOfBroken);
    }

    void checkWhole(Diagnosis& diagnosis, const animation::Character& character) {
        const std::vector<Finding> broken = findBrokenFigure(character, plan_, shapesOfPlan(), diagnosis.fit);
        broken_ = broken_ || !broken.empty();
        diagnosis.findings.insert(diagnosis.findings.end(), broken.begin(), broken.end());
        const std::vector<Finding> aside = findBodiesInTheAir(plan_, shapesOfPlan());
        inTheAir_ = !aside.empty();
        diagnosis.findings.insert(diagnosis.findings.end(), aside.begin(), aside.end());
    }

    [[nodiscard]] bool matches() const { return plan_.bodies.size() == profile_.bodies.size(); }

  private:
    // Head, hips and something of every limb: a figure of blocks lacks the further joints by its nature.
    [[nodiscard]] bool isWholeOfBlocks() const {
        const auto any = [&](std::initializer_list<Role> roles) {
            return std::any_of(roles.begin(), roles.end(),
                               [&](Role role) { return map_.jointOf(role) != animation::kNoJoint; });
        };
        return any({Role::head}) && any({Role::hips}) &&
               any({Role::leftUpperArm, Role::leftLowerArm, Role::leftHand}) &&
               any({Role::rightUpperArm, Role::rightLowerArm, Role::rightHand}) &&
               any({Role::leftUpperLeg, Role::leftLowerLeg, Role::leftFoot}) &&
               any({Role::rightUpperLeg, Role::rightLowerLeg, Role::rightFoot});
    }

    [[nodiscard]] std::vector<PlacedShape> shapesOfPlan() const {
        std::vector<PlacedShape> ordered(shapes_.size());
        for (std::size_t body = 0; body < shapes_.size(); ++body)
            ordered[indexOf(static_cast<int>(body))] = shapes_[body];
        return ordered;
    }

    [[nodiscard]] std::optional<Role> roleOf(int body) const { return profile_.bodies[body].role; }

    [[nodiscard]] bool sidesHangBeside(const animation::Skeleton& skeleton, std::optional<Role> role,
                                       std::optional<Role> above) const {
        using animation::Hanging;
        if (!role || !above || animation::sideOf(*role) == animation::Side::center) return false;
        const Role other = animation::mirrored(*role);
        const Role otherAbove = animation::mirrored(*above);
        const bool alone =
            map_.jointOf(other) == animation::kNoJoint || map_.jointOf(otherAbove) == animation::kNoJoint;
        return hangingOf(skeleton, role, above) == Hanging::beside &&
               (alone || hangingOf(skeleton, other, otherAbove) == Hanging::beside);
    }

    // Hips that hang on the trunk and carry both legs, but no arm: the rig's root is the trunk.
    [[nodiscard]] bool carriesLegsAlone(const animation::Skeleton& skeleton) const {
        const auto carries = [&](Role role) {
            return animation::isAncestorOrSelf(skeleton, map_.jointOf(Role::hips), map_.jointOf(role));
        };
        const auto bound = [&](Role role) { return map_.jointOf(role) != animation::kNoJoint; };
        const auto both = [](Role left, const auto& holds) { return holds(left) && holds(animation::mirrored(left)); };
        return both(Role::leftUpperLeg, bound) && both(Role::leftUpperArm, bound) &&
               both(Role::leftUpperLeg, carries) && !carries(Role::leftUpperArm) && !carries(Role::rightUpperArm);
    }

    [[nodiscard]] animation::Hanging hangingOf(const animation::Skeleton& skeleton, std::optional<Role> role,
                                               std::optional<Role> above) const {
        if (!role || !above || map_.jointOf(*role) == animation::kNoJoint ||
            map_.jointOf(*above) == animation::kNoJoint || map_.jointOf(*role) == map_.jointOf(*above)) {
            return animation::Hanging::below;
        }
        return animation::hangingOf(map_, skeleton.parents, *role, *above);
    }

    // The plan lists bodies in the order of roles, which a profile edited by hand need not keep.
    [[nodiscard]] int indexOf(int body) const { return places_[body]; }

    [[nodiscard]] std::string link(const ConstraintProfile& c) const {
        return profile_.bodies[c.child].name + " on " + profile_.bodies[c.parent].name;
    }
    [[nodiscard]] std::vector<std::string> childOf(const ConstraintProfile& c) const {
        return {profile_.bodies[c.child].name};
    }
    // No joint turns that far from its bind pose. (A cone that was widened on one side to hold the bind pose reaches
    // beyond half a circle on the other.)
    void checkReach(Diagnosis& diagnosis, const ConstraintProfile& c) {
        constexpr float kMost = radians(230.0F);
        const JointRange range = jointRange(c, {shapes_[c.parent].standardFromBody, shapes_[c.child].standardFromBody});
        const JointWords words = jointWords(profile_.bodies[c.child].role);
        const auto furthest = [](const AngleSpan& span) { return std::max(-span.low, span.high); };
        const auto check = [&](const AngleSpan& span, const MotionWords& motion) {
            if (furthest(span) <= kMost) return false;
            ++brokenLimits_;
            const std::string_view word = -span.low > span.high ? motion.low : motion.high;
            diagnosis.findings.push_back({Severity::error, "limit-impossible", link(c),
                                          fmt::format("{} of {:.0f} degrees", word, degrees(furthest(span))),
                                          "make frames and limits anew from the anatomy", true, childOf(c)});
            return true;
        };
        if (check(range.flexion, words.flexion) || c.kind == ConstraintProfile::Kind::hinge) return;
        if (!check(range.side, words.side)) check(range.twist, words.twist);
    }

    void checkHinge(Diagnosis& diagnosis, const ConstraintProfile& c) {
        const vec3& expected = anatomy_.flexionAxis[indexOf(c.child)];
        if (c.kind != ConstraintProfile::Kind::hinge || glm::length(expected) < 0.5F) return;
        const vec3 axis = shapes_[c.child].standardFromBody.rotation * c.childFromFrame.rotation * vec3(0, 0, 1);
        const float angle = degrees(std::acos(std::clamp(glm::dot(axis, expected), -1.0F, 1.0F)));
        if (angle < 45.0F) return;
        const bool reversed = angle > 135.0F;
        brokenLimits_ += reversed ? 1 : 0;
        diagnosis.findings.push_back({reversed ? Severity::error : Severity::warning,
                                      reversed ? "hinge-reversed" : "hinge-askew", link(c),
                                      fmt::format("its axis is {:.0f} degrees off the anatomy's", angle),
                                      "make the frames anew from the anatomy", true, childOf(c)});
    }

    // Another fit is no mend where it has the same fault: a cape or a coat is no capsule.
    void checkShape(Diagnosis& diagnosis, int body) {
        const std::string& name = profile_.bodies[body].name;
        for (const ShapeFault& fault : shapeFaults(plan_.bodies[indexOf(body)], shapes_[body], profile_.heightM)) {
            const bool mendable = newShapes_.without(fault.code, indexOf(body)) != nullptr;
            const char* mend = mendable ? "fit the shape anew" : otherMend(fault.code);
            diagnosis.findings.push_back({Severity::warning, fault.code, name, fault.measure, mend, mendable, {name}});
        }
    }

    static const char* otherMend(std::string_view code) {
        if (code == "skin-not-covered")
            return "no other fit covers it: give the body more shapes, or what stands out a body of its own";
        if (code == "capsule-outside-skin") return "no other fit is thinner: give the body another shape, or several";
        return "no other fit is of another size: give the body another shape";
    }

    const RagdollProfile& profile_;
    const animation::HumanoidMap& map_;
    BodyPlan plan_;
    std::vector<int> places_;  // of the profile's bodies in the plan
    Anatomy anatomy_;
    std::vector<PlacedShape> shapes_;
    NewShapes newShapes_;
    float worstRatio_ = 1.0F;
    int brokenLimits_ = 0;
    int astray_ = 0;         // roles whose joints hang on another limb
    bool broken_ = false;    // as a whole
    bool inTheAir_ = false;  // a body is
};

void findMissingJoints(Diagnosis& diagnosis, const RagdollProfile& profile, const animation::Character& character,
                       const animation::HumanoidMap& map) {
    for (const BodyProfile& body : profile.bodies) {
        const bool there = jointOfBody(body, character.skeleton) != animation::kNoJoint;
        if (there && (!body.role || map.jointOf(*body.role) != animation::kNoJoint)) continue;
        diagnosis.findings.push_back(
            {Severity::error,
             "joint-missing",
             body.name,
             there ? "the rig has no joint of that role" : "no joint \"" + body.jointPath + "\" in the rig",
             "re-bind the profile to this rig",
             false,
             {body.name}});
    }
}

}  // namespace

const char* severityName(Severity severity) {
    switch (severity) {
        case Severity::info:
            return "info";
        case Severity::warning:
            return "warning";
        case Severity::error:
            break;
    }
    return "error";
}

bool Diagnosis::hasErrors() const {
    return std::any_of(findings.begin(), findings.end(),
                       [](const Finding& finding) { return finding.severity == Severity::error; });
}

Diagnosis diagnose(const RagdollProfile& profile, const animation::Character& character,
                   const animation::HumanoidMap& map) {
    Diagnosis diagnosis;
    for (const std::string& problem : validate(profile)) {
        const std::size_t colon = problem.find(": ");
        diagnosis.findings.push_back({Severity::error,
                                      "profile-invalid",
                                      problem.substr(0, colon),
                                      problem.substr(colon + 2),
                                      "mend the profile by hand or build it anew",
                                      false,
                                      {}});
    }
    if (diagnosis.findings.empty()) findMissingJoints(diagnosis, profile, character, map);
    if (!diagnosis.findings.empty()) return diagnosis;
    Examination examination(profile, character, map);
    if (!examination.matches()) {
        diagnosis.findings.push_back({Severity::error,
                                      "joint-missing",
                                      "/bodies",
                                      "two roles share a joint of the rig",
                                      "re-bind the profile to this rig",
                                      false,
                                      {}});
        return diagnosis;
    }
    examination.checkMap(diagnosis);
    examination.checkHierarchy(diagnosis, character.skeleton);
    examination.checkLimbs(diagnosis, character.skeleton);
    examination.checkMasses(diagnosis);
    examination.checkLimits(diagnosis);
    examination.checkOverlaps(diagnosis);
    examination.checkShapes(diagnosis);
    examination.checkSides(diagnosis);
    for (const std::string& note : profile.notes)
        diagnosis.findings.push_back({Severity::info, "note", "", note, "", false, {}});
    examination.measure(diagnosis, character);
    examination.checkWhole(diagnosis, character);
    std::stable_sort(diagnosis.findings.begin(), diagnosis.findings.end(),
                     [](const Finding& a, const Finding& b) { return a.severity > b.severity; });
    examination.score(diagnosis);
    return diagnosis;
}

}  // namespace lutka::physics
