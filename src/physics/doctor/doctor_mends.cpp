#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "physics/collision/shape.hpp"
#include "physics/doctor/doctor.hpp"
#include "physics/doctor/shape_faults.hpp"
#include "physics/fit/anatomy.hpp"
#include "physics/fit/fit_shapes.hpp"
#include "physics/fit/masses.hpp"
#include "physics/fit/profile_plan.hpp"
#include "physics/fit/rebind.hpp"
#include "physics/profile/constraint_frames.hpp"

namespace lutka::physics {
namespace {

// Mends a copy of the profile, one finding after the other.
class Mender {
  public:
    Mender(const RagdollProfile& profile, const animation::Character& character, const animation::HumanoidMap& map)
        : profile_(profile),
          character_(character),
          plan_(planOfProfile(profile, character, map)),
          places_(placesInPlan(profile, plan_)),
          anatomy_(findAnatomy(plan_)),
          newShapes_(plan_, anatomy_, mostShapesOf(profile), profile.heightM) {}

    [[nodiscard]] bool matches() const { return plan_.bodies.size() == profile_.bodies.size(); }

    void mend(const Finding& finding) {
        if (finding.code == "overlap" && finding.bodies.size() == 2) filter(finding.bodies[0], finding.bodies[1]);
        if (finding.code == "mass-ratio") balanceMasses();
        if (finding.code == "sides-differ" && finding.bodies.size() == 2)
            makeEqual(finding.bodies[0], finding.bodies[1]);
        const int body = finding.bodies.empty() ? -1 : bodyNamed(profile_, finding.bodies[0]);
        if (body < 0) return;
        if (isShapeFault(finding.code)) refit(body, finding.code);
        if (finding.code == "hinge-reversed" || finding.code == "hinge-askew") rebuildFrames(body);
        if (finding.code == "limit-impossible" && body > 0) {
            setRange(profile_.constraints[body - 1], plan_, places_[body]);
            rebuildFrames(body);
        }
        if (finding.code == "bind-outside-limits") widen(body);
    }

    [[nodiscard]] RagdollProfile take() { return std::move(profile_); }

  private:
    void note(std::string text) { profile_.notes.push_back("mended: " + std::move(text)); }

    void filter(const std::string& first, const std::string& second) {
        const int a = bodyNamed(profile_, first);
        const int b = bodyNamed(profile_, second);
        if (a < 0 || b < 0 || a == b) return;
        const std::pair pair(std::min(a, b), std::max(a, b));
        auto& pairs = profile_.filteredPairs;
        if (std::find(pairs.begin(), pairs.end(), pair) != pairs.end()) return;
        pairs.insert(std::upper_bound(pairs.begin(), pairs.end(), pair), pair);
        note(fmt::format("{} and {} no longer collide", first, second));
    }

    void balanceMasses() {
        if (balanced_) return;
        balanced_ = true;
        FitOptions options;
        options.totalMassKg = profile_.totalMassKg;
        options.massPreset = MassPreset::balanced;
        assignMasses(profile_.bodies, options);
        note("masses balanced");
    }

    void makeEqual(const std::string& first, const std::string& second) {
        const int a = bodyNamed(profile_, first);
        const int b = bodyNamed(profile_, second);
        if (a < 0 || b < 0) return;
        BodyProfile& left = profile_.bodies[a];
        BodyProfile& right = profile_.bodies[b];
        left.massKg = right.massKg = 0.5F * (left.massKg + right.massKg);
        using Kind = PrimitiveShape::Kind;
        if (left.shape.kind == Kind::hull && right.shape.kind == Kind::hull) {
            makeHullsEqual(left, right);
            note(fmt::format("{} and {} made equal", first, second));
            return;
        }
        const bool leftHasMost = left.shape.more.size() >= right.shape.more.size();
        BodyShape mean = leftHasMost ? left.shape : mirrored(right.shape);
        if (left.shape.kind == right.shape.kind) {
            mean.radius = 0.5F * (left.shape.radius + right.shape.radius);
            mean.halfLength = 0.5F * (left.shape.halfLength + right.shape.halfLength);
            mean.halfExtents = 0.5F * (left.shape.halfExtents + right.shape.halfExtents);
        }
        left.shape = mean;
        right.shape = mirrored(mean);
        left.inertia = right.inertia = shapeInertia(mean, left.massKg);
        note(fmt::format("{} and {} made equal", first, second));
    }

    // Each keeps its own form, for their axes need not be mirror images.
    static void makeHullsEqual(BodyProfile& left, BodyProfile& right) {
        const float volume = 0.5F * (left.shape.hull->volume() + right.shape.hull->volume());
        for (BodyProfile* body : {&left, &right}) {
            scaleHull(body->shape, vec3(std::cbrt(volume / body->shape.hull->volume())));
            body->inertia = shapeInertia(body->shape, body->massKg);
        }
    }

    // The frames of a body's own constraint and of those that hang on it move with it.
    void refit(int body, std::string_view fault) {
        const PlacedShape* found = newShapes_.without(fault, places_[body]);
        if (found == nullptr) return;
        const PlacedShape& shape = *found;
        const RigidTransform standardFromOld = placed()[body].standardFromBody;
        BodyProfile& target = profile_.bodies[body];
        target.shape = shape.shape;
        target.inertia = shapeInertia(shape.shape, target.massKg);
        const RigidTransform oldFromNew = inverse(standardFromOld) * shape.standardFromBody;
        target.jointFromBody = target.jointFromBody * oldFromNew;
        target.jointFromBody.rotation = glm::normalize(target.jointFromBody.rotation);
        for (ConstraintProfile& c : profile_.constraints) {
            if (c.child == body) c.childFromFrame = inverse(oldFromNew) * c.childFromFrame;
            if (c.parent == body) c.parentFromFrame = inverse(oldFromNew) * c.parentFromFrame;
            c.childFromFrame.rotation = glm::normalize(c.childFromFrame.rotation);
            c.parentFromFrame.rotation = glm::normalize(c.parentFromFrame.rotation);
        }
        note(fmt::format("shape of {} fitted anew", target.name));
    }

    void rebuildFrames(int body) {
        const std::vector<PlacedShape> shapes = placed();
        ConstraintProfile& c = profile_.constraints[body - 1];
        // The spring rests in the pose in which it did.
        const BindFrames bind{shapes[c.parent].standardFromBody, shapes[c.child].standardFromBody};
        const JointSpring spring = springFromBind(c, bind);
        setFrames(c, jointFrames(plan_, anatomy_, places_[body]), shapes[c.parent].standardFromBody,
                  shapes[c.child].standardFromBody);
        setSpringFromBind(c, spring, bind);
        note(fmt::format("frames of {} made anew", profile_.bodies[body].name));
        widen(body);
    }

    void widen(int body) {
        const std::vector<PlacedShape> shapes = placed();
        ConstraintProfile& c = profile_.constraints[body - 1];
        std::string done = widenToHold(c, shapes[c.parent].standardFromBody, shapes[c.child].standardFromBody,
                                       profile_.bodies[body].name);
        if (!done.empty()) note(std::move(done));
    }

    [[nodiscard]] std::vector<PlacedShape> placed() const { return shapesInBindPose(profile_, character_.skeleton); }

    RagdollProfile profile_;
    const animation::Character& character_;
    BodyPlan plan_;
    std::vector<int> places_;  // of the profile's bodies in the plan
    Anatomy anatomy_;
    NewShapes newShapes_;
    bool balanced_ = false;
};

}  // namespace

Result<RagdollProfile> applyMends(const RagdollProfile& profile, const animation::Character& character,
                                  const animation::HumanoidMap& map, std::span<const Finding> findings) {
    for (const Finding& finding : findings) {
        if (finding.code == "profile-invalid" || finding.code == "joint-missing") {
            return Error{ErrorCode::input, finding.measure, finding.place, finding.mend};
        }
    }
    Mender mender(profile, character, map);
    if (!mender.matches()) {
        return Error{ErrorCode::input, "the profile does not belong to the rig", character.name,
                     "re-bind the profile to this rig"};
    }
    // Shapes before what is measured on them: frames, then limits, then pairs.
    const auto order = [](const Finding& finding) {
        return isShapeFault(finding.code) || finding.code == "sides-differ" ? 0
               : finding.code == "bind-outside-limits"                      ? 2
               : finding.code == "overlap"                                  ? 3
                                                                            : 1;
    };
    for (int stage = 0; stage < 4; ++stage) {
        for (const Finding& finding : findings) {
            if (finding.mendable && order(finding) == stage) mender.mend(finding);
        }
    }
    return mender.take();
}

}  // namespace lutka::physics
