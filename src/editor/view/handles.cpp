#include "editor/view/handles.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <glm/geometric.hpp>
#include <limits>

#include "physics/profile/constraint_state.hpp"

namespace lutka::editor {
namespace {

using HandleKind = Handle::Kind;
using physics::BodyShape;
using physics::ConstraintProfile;

constexpr vec3 kX{1, 0, 0};
constexpr vec3 kY{0, 1, 0};
constexpr vec3 kZ{0, 0, 1};
constexpr float kTwistSize = 0.35F;  // of the cone's length: radius of the twist's circle
constexpr render::Color kLimitLine{255, 196, 64, 255};
constexpr render::Color kHandle{255, 232, 170, 255};
constexpr render::Color kHotHandle{255, 90, 30, 255};

/// A limit's handle goes round `axis` through `center`; at angle 0 it lies in direction `zero`, `radius` away.
struct Circle {
    vec3 center, axis, zero;
    float radius = 0.0F;

    [[nodiscard]] vec3 at(float angle) const { return center + glm::angleAxis(angle, axis) * (zero * radius); }
};

bool isLow(HandleKind kind) {
    return kind == HandleKind::flexionLow || kind == HandleKind::sideLow || kind == HandleKind::twistLow;
}

bool isTwist(HandleKind kind) {
    return kind == HandleKind::twistLow || kind == HandleKind::twistHigh;
}

Circle circleOf(const HandleScene& scene, const ConstraintProfile& constraint, const RigidTransform& worldFromChild,
                HandleKind kind) {
    const RigidTransform parentFrame = scene.worldFromParent * constraint.parentFromFrame;
    if (kind == HandleKind::flexionLow || kind == HandleKind::flexionHigh) {
        return {parentFrame.translation, parentFrame.rotation * kZ, parentFrame.rotation * kX, scene.size()};
    }
    if (!isTwist(kind)) {
        return {parentFrame.translation, parentFrame.rotation * kY, parentFrame.rotation * kX, scene.size()};
    }
    // The present twist is taken back: what is left is where the child's y is in the middle of the range.
    const RigidTransform childFrame = worldFromChild * constraint.childFromFrame;
    const float twist = physics::measureConstraint(constraint, scene.worldFromParent, worldFromChild).twist;
    const vec3 axis = childFrame.rotation * kX;
    const vec3 zero = glm::angleAxis(-twist, axis) * (childFrame.rotation * kY);
    return {childFrame.translation + axis * scene.size(), axis, zero, scene.size() * kTwistSize};
}

float limitOf(const ConstraintProfile& constraint, HandleKind kind) {
    const bool hinge = constraint.kind == ConstraintProfile::Kind::hinge;
    switch (kind) {
        case HandleKind::flexionLow:
            return hinge ? constraint.hinge.lower : -constraint.cone.swingZ;
        case HandleKind::flexionHigh:
            return hinge ? constraint.hinge.upper : constraint.cone.swingZ;
        case HandleKind::sideLow:
            return -constraint.cone.swingY;
        case HandleKind::sideHigh:
            return constraint.cone.swingY;
        case HandleKind::twistLow:
            return -constraint.cone.twist;
        default:
            return constraint.cone.twist;
    }
}

// The angle of the point of the circle that is seen nearest to the mouse, within a third of a turn of `near`. Works
// however the circle is seen, edge-on too.
float angleUnder(const Circle& circle, float near, const render::Camera& camera, const vec2& mouse,
                 render::Extent window) {
    constexpr float reach = 2.0F * kPi / 3.0F;
    constexpr int coarse = 120;
    constexpr int rounds = 24;
    const auto distance = [&](float angle) {
        const auto seen = render::project(camera, circle.at(angle), window);
        return seen ? glm::distance(vec2(*seen), mouse) : std::numeric_limits<float>::max();
    };
    float best = near;
    for (int i = -coarse; i <= coarse; ++i) {
        const float angle = near + reach * static_cast<float>(i) / coarse;
        if (distance(angle) < distance(best)) best = angle;
    }
    float step = reach / coarse;
    for (int i = 0; i < rounds; ++i) {
        step *= 0.6F;
        for (const float angle : {best - step, best + step}) {
            if (distance(angle) < distance(best)) best = angle;
        }
    }
    return best;
}

// How far along a line the mouse is: where the line passes nearest to its ray.
float alongUnder(const vec3& from, const vec3& direction, const render::Ray& ray, float present) {
    const float across = glm::dot(direction, ray.direction);
    const float determinant = 1.0F - across * across;
    constexpr float parallel = 1e-4F;
    if (determinant < parallel) return present;
    const vec3 apart = ray.origin - from;
    return (glm::dot(apart, direction) - glm::dot(apart, ray.direction) * across) / determinant;
}

// Across the body's axis and the view: where the outline of a capsule is seen.
vec3 outward(const HandleScene& scene, const render::Camera& camera) {
    const vec3 axis = scene.worldFromBody.rotation * kY;
    const vec3 side = glm::cross(axis, render::forwardOf(camera));
    constexpr float endOn = 1e-3F;
    return glm::length(side) > endOn ? glm::normalize(side) : render::rightOf(camera);
}

void addShapeHandles(const HandleScene& scene, const render::Camera& camera, std::vector<Handle>& handles) {
    const BodyShape& shape = scene.profile.bodies[scene.body].shape;
    const RigidTransform& world = scene.worldFromBody;
    if (shape.kind == BodyShape::Kind::box) {
        handles.push_back({HandleKind::boxX, world * (kX * shape.halfExtents.x)});
        handles.push_back({HandleKind::boxY, world * (kY * shape.halfExtents.y)});
        handles.push_back({HandleKind::boxZ, world * (kZ * shape.halfExtents.z)});
        return;
    }
    if (shape.kind == BodyShape::Kind::hull) return;  // it has no measures: it is scaled as a whole
    handles.push_back({HandleKind::radius, world.translation + outward(scene, camera) * shape.radius});
    if (shape.kind == BodyShape::Kind::sphere) return;
    const vec3 end = kY * (shape.halfLength + shape.radius);
    handles.push_back({HandleKind::capsuleTop, world * end});
    handles.push_back({HandleKind::capsuleBottom, world * -end});
}

vec3 boxAxis(HandleKind kind) {
    if (kind == HandleKind::boxX) return kX;
    return kind == HandleKind::boxY ? kY : kZ;
}

void drawLimits(const HandleScene& scene, const ConstraintProfile& constraint, render::LineBatch& lines) {
    const RigidTransform frame = scene.worldFromParent * constraint.parentFromFrame;
    if (constraint.kind == ConstraintProfile::Kind::hinge) {
        render::addArc(lines, frame, constraint.hinge.lower, constraint.hinge.upper, scene.size(), kLimitLine);
        const auto now = physics::measureConstraint(constraint, scene.worldFromParent, scene.worldFromBody);
        const Circle circle = circleOf(scene, constraint, scene.worldFromBody, HandleKind::flexionHigh);
        render::addArrow(lines, circle.center, circle.at(now.hingeAngle), render::colors::white);
        return;
    }
    render::addSwingCone(lines, frame, constraint.cone.swingY, constraint.cone.swingZ, scene.size(), kLimitLine);
    const Circle twist = circleOf(scene, constraint, scene.worldFromBody, HandleKind::twistHigh);
    render::addArrow(lines, frame.translation, twist.center, render::colors::white);
    render::addArc(lines, twist.center, twist.axis, twist.zero, -constraint.cone.twist, constraint.cone.twist,
                   twist.radius, kLimitLine);
    lines.add(twist.center, twist.at(-constraint.cone.twist), kLimitLine);
    lines.add(twist.center, twist.at(constraint.cone.twist), kLimitLine);
}

}  // namespace

std::vector<Handle> handlesOf(const HandleScene& scene, const render::Camera& camera) {
    std::vector<Handle> handles;
    addShapeHandles(scene, camera, handles);
    const ConstraintProfile* constraint = scene.constraint();
    if (constraint == nullptr) return handles;
    constexpr std::array hinge = {HandleKind::flexionLow, HandleKind::flexionHigh};
    constexpr std::array cone = {HandleKind::flexionLow, HandleKind::flexionHigh, HandleKind::sideLow,
                                 HandleKind::sideHigh,   HandleKind::twistLow,    HandleKind::twistHigh};
    const bool isHinge = constraint->kind == ConstraintProfile::Kind::hinge;
    for (const HandleKind kind : isHinge ? std::span<const HandleKind>(hinge) : std::span<const HandleKind>(cone)) {
        handles.push_back(
            {kind, circleOf(scene, *constraint, scene.worldFromBody, kind).at(limitOf(*constraint, kind))});
    }
    return handles;
}

std::optional<Handle> handleUnder(std::span<const Handle> handles, const render::Camera& camera, const vec2& mouse,
                                  render::Extent window, float pixels) {
    std::optional<Handle> nearest;
    for (const Handle& handle : handles) {
        const auto seen = render::project(camera, handle.position, window);
        if (!seen || glm::distance(vec2(*seen), mouse) >= pixels) continue;
        pixels = glm::distance(vec2(*seen), mouse);
        nearest = handle;
    }
    return nearest;
}

void drawHandles(const HandleScene& scene, std::span<const Handle> handles, const std::optional<HandleKind>& hot,
                 const render::Camera& camera, render::LineBatch& lines) {
    if (const ConstraintProfile* constraint = scene.constraint()) drawLimits(scene, *constraint, lines);
    constexpr float seenSize = 0.0055F;  // of the distance to the eye: the same size wherever it is
    for (const Handle& handle : handles) {
        const float distance =
            camera.orthographic ? camera.distance : glm::distance(render::eyeOf(camera), handle.position);
        const float size = distance * seenSize;
        const bool isHot = hot == handle.kind;
        const render::Color color = isHot ? kHotHandle : kHandle;
        const RigidTransform facing{scene.worldFromBody.rotation, handle.position};
        if (handle.ofLimit()) {
            render::addSphere(lines, handle.position, size, color);
            if (isHot) render::addSphere(lines, handle.position, size * 1.5F, color);
        } else {
            render::addBox(lines, facing, vec3(size), color);
            if (isHot) render::addBox(lines, facing, vec3(size * 1.5F), color);
        }
    }
}

std::string handleName(HandleKind kind, std::optional<physics::Role> role) {
    const physics::JointWords words = physics::jointWords(role);
    switch (kind) {
        case HandleKind::flexionLow:
            return std::string(words.flexion.low);
        case HandleKind::flexionHigh:
            return std::string(words.flexion.high);
        case HandleKind::sideLow:
            return std::string(words.side.low);
        case HandleKind::sideHigh:
            return std::string(words.side.high);
        case HandleKind::twistLow:
            return std::string(words.twist.low);
        case HandleKind::twistHigh:
            return std::string(words.twist.high);
        case HandleKind::radius:
            return "radius";
        case HandleKind::capsuleTop:
        case HandleKind::capsuleBottom:
            return "length";
        case HandleKind::boxX:
            return "half width";
        case HandleKind::boxY:
            return "half height";
        case HandleKind::boxZ:
            break;
    }
    return "half depth";
}

HandleDrag::HandleDrag(const HandleScene& scene, HandleKind kind, const render::Camera& camera, const vec2& mouse,
                       render::Extent window)
    : kind_(kind),
      startShape_(scene.profile.bodies[scene.body].shape),
      startPlace_(scene.profile.bodies[scene.body].jointFromBody),
      shape_(startShape_),
      jointFromBody_(startPlace_) {
    const ConstraintProfile* constraint = scene.constraint();
    if (constraint == nullptr) return;
    startConstraint_ = *constraint;
    startRange_ = range_ = physics::jointRange(startConstraint_, scene.bind);
    if (kind > HandleKind::twistHigh) return;
    startAngle_ = limitOf(startConstraint_, kind);
    angle_ = startAngle_;
    const Circle circle = circleOf(scene, startConstraint_, scene.worldFromBody, kind);
    grabbedOff_ = angleUnder(circle, startAngle_, camera, mouse, window) - startAngle_;
}

bool HandleDrag::low() const {
    return isLow(kind_);
}

physics::AngleSpan& HandleDrag::span() {
    if (kind_ == HandleKind::flexionLow || kind_ == HandleKind::flexionHigh) return range_.flexion;
    return isTwist(kind_) ? range_.twist : range_.side;
}

void HandleDrag::follow(const HandleScene& scene, const render::Camera& camera, const vec2& mouse,
                        render::Extent window, bool bothEnds) {
    if (kind_ <= HandleKind::twistHigh) {
        followLimit(scene, camera, mouse, window, bothEnds);
    } else {
        followShape(scene, camera, mouse, window);
    }
}

void HandleDrag::followLimit(const HandleScene& scene, const render::Camera& camera, const vec2& mouse,
                             render::Extent window, bool bothEnds) {
    constexpr float least = radians(2.0F);  // between the ends
    constexpr float most = radians(175.0F);
    // About the frames as they were: the neutral pose that the drag moves must not move the drag.
    const Circle circle = circleOf(scene, startConstraint_, scene.worldFromBody, kind_);
    angle_ = std::clamp(angleUnder(circle, angle_, camera, mouse, window) - grabbedOff_, -most, most);
    range_ = startRange_;
    physics::AngleSpan& ends = span();
    const float moved = angle_ - startAngle_;
    if (bothEnds) {
        const float middle = 0.5F * (ends.low + ends.high);
        const float half = std::clamp(0.5F * (ends.high - ends.low) + (low() ? -moved : moved), least * 0.5F, most);
        ends = {middle - half, middle + half};
    } else if (low()) {
        ends.low = std::min(ends.low + moved, ends.high - least);
    } else {
        ends.high = std::max(ends.high + moved, ends.low + least);
    }
}

void HandleDrag::followShape(const HandleScene& scene, const render::Camera& camera, const vec2& mouse,
                             render::Extent window) {
    constexpr float least = 0.005F;  // metres
    const float most = scene.profile.heightM * 0.75F;
    const render::Ray ray = render::worldRay(camera, mouse, window);
    // The body of the shape as it was: its centre moves with the drag.
    const RigidTransform world =
        scene.worldFromBody * inverse(scene.profile.bodies[scene.body].jointFromBody) * startPlace_;
    shape_ = startShape_;
    jointFromBody_ = startPlace_;
    const auto along = [&](const vec3& direction, float present) {
        return std::clamp(alongUnder(world.translation, direction, ray, present), least, most);
    };
    switch (kind_) {
        case HandleKind::radius: {
            shape_.radius = along(outward(scene, camera), startShape_.radius);
            // A capsule keeps its ends: what the caps gain the cylinder loses.
            const float reach = startShape_.halfLength + startShape_.radius;
            shape_.halfLength = std::max(reach - shape_.radius, 0.0F);
            break;
        }
        case HandleKind::capsuleTop:
        case HandleKind::capsuleBottom: {
            const float reach = startShape_.halfLength + startShape_.radius;
            const vec3 out = kind_ == HandleKind::capsuleTop ? kY : -kY;
            const float end = alongUnder(world.translation, world.rotation * out, ray, reach);
            const float length = std::clamp(end + reach, 2.0F * startShape_.radius, 2.0F * most);
            shape_.halfLength = 0.5F * length - startShape_.radius;
            jointFromBody_.translation += startPlace_.rotation * (out * (0.5F * length - reach));
            break;
        }
        default: {
            const vec3 axis = boxAxis(kind_);
            const float present = glm::dot(startShape_.halfExtents, axis);
            shape_.halfExtents += axis * (along(world.rotation * axis, present) - present);
            break;
        }
    }
}

std::string HandleDrag::text() const {
    const auto rounded = [](float value) {
        std::array<char, 32> buffer{};
        std::snprintf(buffer.data(), buffer.size(), "%.1f", static_cast<double>(value));
        return std::string(buffer.data());
    };
    switch (kind_) {
        case HandleKind::flexionLow:
            return rounded(-degrees(range_.flexion.low)) + " deg";
        case HandleKind::flexionHigh:
            return rounded(degrees(range_.flexion.high)) + " deg";
        case HandleKind::sideLow:
            return rounded(-degrees(range_.side.low)) + " deg";
        case HandleKind::sideHigh:
            return rounded(degrees(range_.side.high)) + " deg";
        case HandleKind::twistLow:
            return rounded(-degrees(range_.twist.low)) + " deg";
        case HandleKind::twistHigh:
            return rounded(degrees(range_.twist.high)) + " deg";
        case HandleKind::radius:
            return rounded(shape_.radius * 100.0F) + " cm";
        case HandleKind::capsuleTop:
        case HandleKind::capsuleBottom:
            return rounded((shape_.halfLength + shape_.radius) * 200.0F) + " cm";
        default:
            break;
    }
    return rounded(glm::dot(shape_.halfExtents, boxAxis(kind_)) * 100.0F) + " cm";
}

}  // namespace lutka::editor
