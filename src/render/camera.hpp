#pragma once

#include <optional>
#include <span>

#include "core/math.hpp"
#include "render/extent.hpp"

namespace lutka::render {

/// A half line in world space; `direction` has unit length.
struct Ray {
    vec3 origin{0, 0, 0};
    vec3 direction{0, 0, -1};
};

/// An orbit camera: it looks at `target` from `distance` away. All of it is plain data; the functions below derive the
/// rest. At yaw 0 and pitch 0 the eye stands on +Z of the target and looks along -Z, with +X to the right.
struct Camera {
    vec3 target{0, 0.9F, 0};             ///< World, metres.
    float distance = 4.0F;               ///< Eye to target, metres, > 0.
    float yaw = radians(30.0F);          ///< About world Y; grows: the eye moves towards +X.
    float pitch = radians(12.0F);        ///< In [-pi/2, pi/2]; grows: the eye rises.
    float fieldOfView = radians(35.0F);  ///< Vertical, in (0, pi).
    bool orthographic = false;           ///< Parallel projection; its height is what the perspective shows at `target`.
};

/// Where the camera stands, in world space.
[[nodiscard]] vec3 eyeOf(const Camera& camera);

/// Unit directions of the picture in world space.
[[nodiscard]] vec3 rightOf(const Camera& camera);
[[nodiscard]] vec3 upOf(const Camera& camera);
[[nodiscard]] vec3 forwardOf(const Camera& camera);

/// View space: right, up, backwards.
[[nodiscard]] mat4 viewFromWorld(const Camera& camera);

/// OpenGL's clip space (z in [-w, w]); the near and far planes follow from the distance. `aspect` is width : height.
[[nodiscard]] mat4 clipFromView(const Camera& camera, float aspect);
[[nodiscard]] mat4 clipFromWorld(const Camera& camera, float aspect);

/// The ray through a point of the picture. `pixel` is continuous: (0, 0) is the upper left corner, (width, height) the
/// lower right one, and the middle of the first pixel is (0.5, 0.5). Window coordinates of the mouse go in as they are
/// when `size` is the window's size in the same unit, which makes it exact at any DPI.
[[nodiscard]] Ray worldRay(const Camera& camera, const vec2& pixel, Extent size);

/// The inverse: where a world point is seen, in the same coordinates; z is the depth in [0, 1] between near and far.
/// Nothing when the point lies behind the eye.
[[nodiscard]] std::optional<vec3> project(const Camera& camera, const vec3& world, Extent size);

/// Turns about the target by angles in radians; the pitch stops short of the poles.
void orbit(Camera& camera, float yawDelta, float pitchDelta);

/// Moves eye and target so that what lies in the target's plane follows the mouse: `pixels` is its movement (x to the
/// right, y down).
void pan(Camera& camera, const vec2& pixels, Extent size);

/// Multiplies the distance to the target: below 1 comes nearer. Stays within [1 cm, 1 km].
void dolly(Camera& camera, float factor);

/// Aims at a sphere and takes the distance at which it just fits the picture times `margin`; the direction stays.
void frameSphere(Camera& camera, const vec3& center, float radius, float aspect, float margin = 1.1F);

/// What lies over a picture's edges, as shares of its width and height; opposite ones together below 1.
struct PictureInsets {
    float left = 0.0F;
    float right = 0.0F;
    float top = 0.0F;
    float bottom = 0.0F;
};

/// Aims so that all points just fit the part of the picture that `insets` leave free, in its middle; the direction
/// stays. Does nothing without a point.
void framePoints(Camera& camera, std::span<const vec3> points, float aspect, const PictureInsets& insets);

}  // namespace lutka::render
