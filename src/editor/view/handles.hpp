#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "physics/profile/joint_range.hpp"
#include "render/camera.hpp"
#include "render/line_batch.hpp"

namespace lutka::editor {

/// What can be taken hold of in the view to edit the active body: the ends of its limits and of its shape.
struct Handle {
    enum class Kind {
        flexionLow,
        flexionHigh,
        sideLow,
        sideHigh,
        twistLow,
        twistHigh,
        radius,
        capsuleTop,     ///< The end of the capsule in the body's +Y.
        capsuleBottom,  ///< The end in -Y.
        boxX,
        boxY,
        boxZ,
    };
    Kind kind = Kind::radius;
    vec3 position{0, 0, 0};  ///< World.

    [[nodiscard]] bool ofLimit() const { return kind <= Kind::twistHigh; }
};

/// A part as the handles see it.
struct HandleScene {
    const physics::RagdollProfile& profile;
    int body = 0;
    RigidTransform worldFromBody;
    RigidTransform worldFromParent;  ///< Of the parent body; unused for the root.
    physics::BindFrames bind;        ///< Of the constraint; unused for the root.

    [[nodiscard]] const physics::ConstraintProfile* constraint() const {
        return body > 0 ? &profile.constraints[body - 1] : nullptr;
    }
    /// Radius of arcs and cones, metres.
    [[nodiscard]] float size() const { return profile.heightM * 0.1F; }
};

/// All handles of a part. `camera` turns the one of the radius to where it is seen.
[[nodiscard]] std::vector<Handle> handlesOf(const HandleScene& scene, const render::Camera& camera);

/// The handle that is seen nearest to the mouse, within `pixels` of it.
[[nodiscard]] std::optional<Handle> handleUnder(std::span<const Handle> handles, const render::Camera& camera,
                                                const vec2& mouse, render::Extent window, float pixels);

/// Draws the limits and shape guides of the part and its handles; `hot` (hovered or held) stands out.
void drawHandles(const HandleScene& scene, std::span<const Handle> handles, const std::optional<Handle::Kind>& hot,
                 const render::Camera& camera, render::LineBatch& lines);

/// "flexion", "twist: inward rotation", "radius" …: what the handle changes, in words.
[[nodiscard]] std::string handleName(Handle::Kind kind, std::optional<physics::Role> role);

/// The drag of one handle, from the part as it was when it began.
class HandleDrag {
  public:
    HandleDrag(const HandleScene& scene, Handle::Kind kind, const render::Camera& camera, const vec2& mouse,
               render::Extent window);

    /// What the mouse makes of the part now. `bothEnds`: a limit's other end goes the opposite way.
    void follow(const HandleScene& scene, const render::Camera& camera, const vec2& mouse, render::Extent window,
                bool bothEnds);

    [[nodiscard]] Handle::Kind kind() const { return kind_; }
    [[nodiscard]] const physics::BodyShape& shape() const { return shape_; }
    [[nodiscard]] const RigidTransform& jointFromBody() const { return jointFromBody_; }
    [[nodiscard]] const physics::JointRange& range() const { return range_; }
    /// The value under the mouse: degrees for limits, centimetres else.
    [[nodiscard]] std::string text() const;

  private:
    void followLimit(const HandleScene& scene, const render::Camera& camera, const vec2& mouse, render::Extent window,
                     bool bothEnds);
    void followShape(const HandleScene& scene, const render::Camera& camera, const vec2& mouse, render::Extent window);
    [[nodiscard]] physics::AngleSpan& span();
    [[nodiscard]] bool low() const;

    Handle::Kind kind_;
    physics::ConstraintProfile startConstraint_;
    physics::BodyShape startShape_;
    RigidTransform startPlace_;
    physics::JointRange startRange_;
    physics::BodyShape shape_;
    RigidTransform jointFromBody_;
    physics::JointRange range_;
    float angle_ = 0;       // under the mouse, about the handle's axis
    float startAngle_ = 0;  // of the limit
    float grabbedOff_ = 0;  // between the mouse and the handle where it was taken
};

}  // namespace lutka::editor
