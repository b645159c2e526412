#include "editor/view/gizmo.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace lutka::editor {
namespace {

constexpr render::Color kHot{255, 232, 90, 255};
constexpr float kArmStart = 0.22F;    // of the size: the middle is free for what is selected
constexpr float kPlaneMiddle = 0.5F;  // where the squares of the planes are
constexpr float kPlaneHalf = 0.1F;
constexpr int kRingSides = 64;
constexpr float kBehind = -0.15F;  // of the size: how far behind the middle a ring can be taken

vec3 axisOf(const Gizmo& gizmo, int axis) {
    return gizmo.worldFromGizmo.rotation * axisVector(axis);
}

vec3 onRing(const Gizmo& gizmo, int axis, int side) {
    const float angle = 2.0F * kPi * static_cast<float>(side) / static_cast<float>(kRingSides);
    const vec3 x = axisOf(gizmo, (axis + 1) % 3);
    const vec3 y = axisOf(gizmo, (axis + 2) % 3);
    return gizmo.worldFromGizmo.translation + (x * std::cos(angle) + y * std::sin(angle)) * gizmo.size;
}

std::optional<vec2> seenAt(const render::Camera& camera, const vec3& world, render::Extent window) {
    const auto seen = render::project(camera, world, window);
    return seen ? std::optional(vec2(*seen)) : std::nullopt;
}

float distanceToSegment(const vec2& point, const vec2& from, const vec2& to) {
    const vec2 along = to - from;
    const float length = glm::dot(along, along);
    const float share = length > 0.0F ? std::clamp(glm::dot(point - from, along) / length, 0.0F, 1.0F) : 0.0F;
    return glm::distance(point, from + along * share);
}

/// Finds the nearest part to the mouse.
class Search {
  public:
    Search(const Gizmo& gizmo, const render::Camera& camera, const vec2& mouse, render::Extent window, float pixels)
        : gizmo_(gizmo), camera_(camera), mouse_(mouse), window_(window), nearest_(pixels) {}

    void arm(int axis) {
        const vec3& origin = gizmo_.worldFromGizmo.translation;
        segment(origin + axisOf(gizmo_, axis) * (gizmo_.size * kArmStart), origin + axisOf(gizmo_, axis) * gizmo_.size,
                {AxisLock::Kind::axis, axis, gizmo_.local});
    }

    void plane(int across) {
        const vec3 at =
            gizmo_.worldFromGizmo.translation +
            (axisOf(gizmo_, (across + 1) % 3) + axisOf(gizmo_, (across + 2) % 3)) * (gizmo_.size * kPlaneMiddle);
        segment(at, at, {AxisLock::Kind::plane, across, gizmo_.local});
    }

    void ring(int axis) {
        const vec3 towards = glm::normalize(render::eyeOf(camera_) - gizmo_.worldFromGizmo.translation);
        for (int side = 0; side < kRingSides; ++side) {
            const vec3 from = onRing(gizmo_, axis, side);
            if (glm::dot(from - gizmo_.worldFromGizmo.translation, towards) < kBehind * gizmo_.size) continue;
            segment(from, onRing(gizmo_, axis, side + 1), {AxisLock::Kind::axis, axis, gizmo_.local});
        }
    }

    [[nodiscard]] std::optional<AxisLock> found() const { return found_; }

  private:
    void segment(const vec3& from, const vec3& to, const AxisLock& part) {
        const auto a = seenAt(camera_, from, window_);
        const auto b = seenAt(camera_, to, window_);
        if (!a || !b) return;
        const float distance = distanceToSegment(mouse_, *a, *b);
        if (distance >= nearest_) return;
        nearest_ = distance;
        found_ = part;
    }

    const Gizmo& gizmo_;
    const render::Camera& camera_;
    vec2 mouse_;
    render::Extent window_;
    float nearest_;
    std::optional<AxisLock> found_;
};

void drawPlane(const Gizmo& gizmo, int across, render::Color color, render::LineBatch& lines) {
    const vec3 a = axisOf(gizmo, (across + 1) % 3) * gizmo.size;
    const vec3 b = axisOf(gizmo, (across + 2) % 3) * gizmo.size;
    const vec3 middle = gizmo.worldFromGizmo.translation + (a + b) * kPlaneMiddle;
    const std::array corners = {middle + (a + b) * kPlaneHalf, middle + (a - b) * kPlaneHalf,
                                middle - (a + b) * kPlaneHalf, middle + (b - a) * kPlaneHalf};
    for (std::size_t i = 0; i < corners.size(); ++i)
        lines.add(corners[i], corners[(i + 1) % corners.size()], color);
}

void drawArm(const Gizmo& gizmo, int axis, render::Color color, render::LineBatch& lines) {
    const vec3& origin = gizmo.worldFromGizmo.translation;
    const vec3 along = axisOf(gizmo, axis) * gizmo.size;
    if (gizmo.tool != Tool::scale) return addArrow(lines, origin + along * kArmStart, origin + along, color);
    lines.add(origin + along * kArmStart, origin + along, color);
    render::addBox(lines, {gizmo.worldFromGizmo.rotation, origin + along}, vec3(gizmo.size * 0.05F), color);
}

}  // namespace

const char* toolName(Tool tool) {
    constexpr std::array names = {"Select", "Move", "Turn", "Size", "Hit"};
    return names[static_cast<std::size_t>(tool)];
}

render::Color axisColor(int axis) {
    constexpr std::array<render::Color, 3> colors = {render::colors::red, render::colors::green, render::colors::blue};
    return colors[static_cast<std::size_t>(axis)];
}

Gizmo gizmoAt(Tool tool, const RigidTransform& worldFromGizmo, bool local, const render::Camera& camera,
              render::Extent window, float pixels) {
    const float depth = camera.orthographic
                            ? camera.distance
                            : glm::dot(worldFromGizmo.translation - render::eyeOf(camera), render::forwardOf(camera));
    const float height = 2.0F * std::tan(0.5F * camera.fieldOfView) * std::max(depth, 0.01F);
    return {tool, worldFromGizmo, pixels * height / static_cast<float>(std::max(window.height, 1)), local};
}

std::optional<AxisLock> gizmoPartUnder(const Gizmo& gizmo, const render::Camera& camera, const vec2& mouse,
                                       render::Extent window, float pixels) {
    Search search(gizmo, camera, mouse, window, pixels);
    for (int axis = 0; axis < 3; ++axis) {
        if (gizmo.tool == Tool::rotate) {
            search.ring(axis);
        } else {
            search.arm(axis);
        }
        if (gizmo.tool == Tool::move) search.plane(axis);
    }
    return search.found();
}

void drawGizmo(const Gizmo& gizmo, const std::optional<AxisLock>& hot, const render::Camera& camera,
               render::LineBatch& lines) {
    const vec3 towards = glm::normalize(render::eyeOf(camera) - gizmo.worldFromGizmo.translation);
    for (int axis = 0; axis < 3; ++axis) {
        const auto colorOf = [&](AxisLock::Kind kind) {
            return hot && hot->kind == kind && hot->axis == axis ? kHot : axisColor(axis);
        };
        if (gizmo.tool == Tool::move) drawPlane(gizmo, axis, colorOf(AxisLock::Kind::plane), lines);
        if (gizmo.tool != Tool::rotate) {
            drawArm(gizmo, axis, colorOf(AxisLock::Kind::axis), lines);
            continue;
        }
        for (int side = 0; side < kRingSides; ++side) {
            const vec3 from = onRing(gizmo, axis, side);
            if (glm::dot(from - gizmo.worldFromGizmo.translation, towards) < kBehind * gizmo.size) continue;
            lines.add(from, onRing(gizmo, axis, side + 1), colorOf(AxisLock::Kind::axis));
        }
    }
}

}  // namespace lutka::editor
