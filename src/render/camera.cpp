#include "render/camera.hpp"

#include <algorithm>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

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

}  // namespace lutka::render
