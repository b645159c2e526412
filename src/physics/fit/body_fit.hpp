#pragma once

#include <optional>
#include <vector>

#include "physics/fit/box_search.hpp"
#include "physics/fit/capsule_search.hpp"
#include "physics/fit/fit_shapes.hpp"

namespace lutka::physics {

/// The axes of a capsule's search: y along `direction`, a unit vector.
[[nodiscard]] quat axesAlong(const vec3& direction);

/// The shapes that one body may have, by its skin. See fitShapes().
class BodyFit {
  public:
    /// Of the plan's body with that index. The plan is kept by reference.
    BodyFit(const BodyPlan& plan, const Anatomy& anatomy, int body);
    /// Its capsule.
    [[nodiscard]] Capsule fit() const;
    /// Several in place of `single`, the body's capsule, where they cover its skin clearly better; `most` at most.
    [[nodiscard]] std::optional<std::vector<Capsule>> fitSeveral(const Capsule& single, int most) const;
    /// A box in place of `capsule` where the body's skin is one.
    [[nodiscard]] std::optional<PlacedBox> fitBox(const Capsule& capsule) const;

  private:
    [[nodiscard]] static quat inMirrorPlane(const quat& rotation);
    [[nodiscard]] bool isFoot() const;
    [[nodiscard]] bool isWhatStands() const;
    [[nodiscard]] bool isLastOfLeg(int index) const;
    [[nodiscard]] float largestRadius() const;
    [[nodiscard]] float cutoff() const;
    void addMirrored();
    [[nodiscard]] CapsuleSearch searchAlong(const vec3& origin, const quat& axes) const;
    [[nodiscard]] Capsule fitLimb() const;
    [[nodiscard]] Capsule fitEnd() const;
    [[nodiscard]] Capsule fitSegment() const;
    [[nodiscard]] static vec3 inMirrorPlane(const vec3& direction);
    [[nodiscard]] Capsule fitStandingOrLying() const;
    [[nodiscard]] Capsule fitFree(const CapsuleSearch& search) const;
    [[nodiscard]] float heelInset(float radius) const;
    [[nodiscard]] Capsule fitFoot() const;
    void keepCentral(CapsuleTrial& trial, const CapsuleSearch& search) const;
    [[nodiscard]] Capsule byProportions() const;
    [[nodiscard]] Capsule trunkByProportions(float radius) const;

    const BodyPlan& plan_;
    const PlannedBody& body_;
    quat rotation_;
    std::vector<SkinPoint> points_;
    bool central_ = false;
    bool standsOn_ = false;
    float spread_ = 0.0F;  // of the points, the second largest
};

}  // namespace lutka::physics
