#include "render/camera.hpp"

#include <algorithm>
#include <array>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <vector>

#include "core/assert.hpp"

namespace lutka::render {
namespace {

constexpr float kPitchLimit = radians(89.5F);
constexpr float kNearestDistance = 0.01F;
constexpr float kFarthestDistance = 1000.0F;

// Half the height of what is seen in the target's plane, metres.
float halfHeightAtTarget(const Camera& camera) {
    return camera.distance * std::tan(0.5F * camera.fieldOfView);
}

// From the camera's axes to the world; the inverse of the view's rotation.
mat3 worldFromViewAxes(const Camera& camera) {
    const quat turn = glm::angleAxis(camera.yaw, vec3(0, 1, 0)) * glm::angleAxis(-camera.pitch, vec3(1, 0, 0));
    return glm::mat3_cast(turn);
}

// Pixel coordinates to [-1, 1] with y up.
vec2 deviceFromPixel(const vec2& pixel, Extent size) {
    return {2.0F * pixel.x / static_cast<float>(size.width) - 1.0F,
            1.0F - 2.0F * pixel.y / static_cast<float>(size.height)};
}

}  // namespace

vec3 rightOf(const Camera& camera) {
    return worldFromViewAxes(camera)[0];
}
vec3 upOf(const Camera& camera) {
    return worldFromViewAxes(camera)[1];
}
vec3 forwardOf(const Camera& camera) {
    return -worldFromViewAxes(camera)[2];
}
vec3 eyeOf(const Camera& camera) {
    return camera.target - camera.distance * forwardOf(camera);
}

mat4 viewFromWorld(const Camera& camera) {
    const mat3 viewFromWorldAxes = glm::transpose(worldFromViewAxes(camera));
    mat4 view(viewFromWorldAxes);
    view[3] = vec4(-(viewFromWorldAxes * eyeOf(camera)), 1.0F);
    return view;
}

mat4 clipFromView(const Camera& camera, float aspect) {
    LUTKA_ASSERT(camera.distance > 0.0F && aspect > 0.0F);
    // Far enough for the floor's fade from any distance, near enough for depth to tell 1 mm apart at the target.
    const float near = std::clamp(0.05F * camera.distance, 0.002F, 1.0F);
    const float far = 60.0F + 12.0F * camera.distance;
    if (camera.orthographic) {
        const float y = halfHeightAtTarget(camera);
        return glm::ortho(-y * aspect, y * aspect, -y, y, -far, far);
    }
    return glm::perspective(camera.fieldOfView, aspect, near, far);
}

mat4 clipFromWorld(const Camera& camera, float aspect) {
    return clipFromView(camera, aspect) * viewFromWorld(camera);
}

Ray worldRay(const Camera& camera, const vec2& pixel, Extent size) {
    const vec2 device = deviceFromPixel(pixel, size);
    const mat3 axes = worldFromViewAxes(camera);
    if (camera.orthographic) {
        const float y = halfHeightAtTarget(camera);
        const vec3 across = axes[0] * (device.x * y * size.aspect()) + axes[1] * (device.y * y);
        return {eyeOf(camera) + across, -axes[2]};
    }
    const float y = std::tan(0.5F * camera.fieldOfView);
    return {eyeOf(camera), glm::normalize(axes * vec3(device.x * y * size.aspect(), device.y * y, -1.0F))};
}

std::optional<vec3> project(const Camera& camera, const vec3& world, Extent size) {
    const vec4 clip = clipFromWorld(camera, size.aspect()) * vec4(world, 1.0F);
    if (clip.w <= 0.0F) return std::nullopt;
    const vec3 device = vec3(clip) / clip.w;
    return vec3((device.x + 1.0F) * 0.5F * static_cast<float>(size.width),
                (1.0F - device.y) * 0.5F * static_cast<float>(size.height), (device.z + 1.0F) * 0.5F);
}

void orbit(Camera& camera, float yawDelta, float pitchDelta) {
    camera.yaw = std::remainder(camera.yaw + yawDelta, 2.0F * kPi);
    camera.pitch = std::clamp(camera.pitch + pitchDelta, -kPitchLimit, kPitchLimit);
}

void pan(Camera& camera, const vec2& pixels, Extent size) {
    const float metresPerPixel = 2.0F * halfHeightAtTarget(camera) / static_cast<float>(size.height);
    const mat3 axes = worldFromViewAxes(camera);
    camera.target += (axes[1] * pixels.y - axes[0] * pixels.x) * metresPerPixel;
}

void dolly(Camera& camera, float factor) {
    camera.distance = std::clamp(camera.distance * factor, kNearestDistance, kFarthestDistance);
}

void frameSphere(Camera& camera, const vec3& center, float radius, float aspect, float margin) {
    // The sphere touches the cone of the narrower half angle where sin(angle) = radius / distance.
    const float vertical = 0.5F * camera.fieldOfView;
    const float horizontal = std::atan(std::tan(vertical) * aspect);
    const float narrow = std::min(vertical, horizontal);
    const float reach = std::max(radius, 1e-3F) * margin;
    // In parallel projection the picture's half height itself must hold the radius.
    const float fit =
        camera.orthographic ? reach / (std::tan(vertical) * std::min(1.0F, aspect)) : reach / std::sin(narrow);
    camera.target = center;
    camera.distance = std::clamp(fit, kNearestDistance, kFarthestDistance);
}

// Along one axis of the picture an eye at `e`, `d` before the middle, sees a point (x across, f farther away) between
// the slopes `low` and `high` when low * (f + d) <= x - e <= high * (f + d). Both ends are linear in e and d: the
// nearest eye is the one for which the highest point touches one edge of the picture and the lowest the other.
namespace {

struct AxisReach {
    float lowSlope = 0.0F;
    float highSlope = 0.0F;
    float high = -1e30F;  // max of x - high slope * f
    float low = 1e30F;    // min of x - low slope * f

    void add(float across, float farther) {
        high = std::max(high, across - highSlope * farther);
        low = std::min(low, across - lowSlope * farther);
    }
    [[nodiscard]] float distance() const { return (high - low) / (highSlope - lowSlope); }
    /// Of the places that see all from a distance no less than distance(): from the lowest to the highest.
    [[nodiscard]] float lowestEye(float distance) const { return high - highSlope * distance; }
    [[nodiscard]] float highestEye(float distance) const { return low - lowSlope * distance; }
};

// From where both edges are as far from what is nearest to them: seen from afar that is another place than half way
// between the lowest and the highest, since what is near moves faster across the picture. `points`: the picture's x, y
// and how much farther away than the middle.
float evenEye(std::span<const vec3> points, int axis, const AxisReach& reach, float distance) {
    float low = reach.lowestEye(distance);
    float high = reach.highestEye(distance);
    constexpr int halvings = 12;  // to less than a pixel
    for (int i = 0; i < halvings; ++i) {
        const float eye = 0.5F * (low + high);
        float most = -1e30F;
        float least = 1e30F;
        for (const vec3& point : points) {
            const float slope = (point[axis] - eye) / (point.z + distance);
            most = std::max(most, slope);
            least = std::min(least, slope);
        }
        (reach.highSlope - most > least - reach.lowSlope ? high : low) = eye;
    }
    return 0.5F * (low + high);
}

}  // namespace

void framePoints(Camera& camera, std::span<const vec3> points, float aspect, const PictureInsets& insets) {
    LUTKA_ASSERT(aspect > 0.0F && insets.left + insets.right < 1.0F && insets.top + insets.bottom < 1.0F);
    if (points.empty()) return;
    const mat3 axes = worldFromViewAxes(camera);
    const float vertical = std::tan(0.5F * camera.fieldOfView);
    const float horizontal = vertical * aspect;
    std::array<AxisReach, 2> reach{
        AxisReach{horizontal * (2.0F * insets.left - 1.0F), horizontal * (1.0F - 2.0F * insets.right)},
        AxisReach{vertical * (2.0F * insets.bottom - 1.0F), vertical * (1.0F - 2.0F * insets.top)}};
    vec3 middle(0);
    for (const vec3& point : points)
        middle += point / static_cast<float>(points.size());
    std::vector<vec3> placed;  // across, up and farther away than the middle
    placed.reserve(points.size());
    float nearest = 0.0F;  // towards the eye, from the middle
    for (const vec3& point : points) {
        const vec3 seen = glm::transpose(axes) * (point - middle);
        // In parallel projection what is farther away is as large as what is near.
        const float farther = camera.orthographic ? 0.0F : -seen.z;
        nearest = std::max(nearest, seen.z);
        for (int axis = 0; axis < 2; ++axis)
            reach[axis].add(seen[axis], farther);
        placed.emplace_back(seen.x, seen.y, farther);
    }
    float distance = std::max(reach[0].distance(), reach[1].distance());
    constexpr float room = 0.05F;  // metres between the eye and what is nearest
    if (!camera.orthographic) distance = std::max(distance, nearest + room);
    camera.distance = std::clamp(distance, kNearestDistance, kFarthestDistance);
    camera.target = middle;
    for (int axis = 0; axis < 2; ++axis)
        camera.target += axes[axis] * evenEye(placed, axis, reach[axis], camera.distance);
}

}  // namespace lutka::render
