#pragma once

#include <optional>
#include <string>

#include "core/math.hpp"
#include "render/camera.hpp"

namespace lutka::editor {

/// What X, Y, Z (along that axis of the world, pressed again of the item itself) and Shift+X, Y, Z (across it) restrict
/// a movement to.
struct AxisLock {
    enum class Kind { free, axis, plane };
    Kind kind = Kind::free;
    int axis = 0;        ///< 0, 1, 2: x, y, z; the plane is the one across it.
    bool local = false;  ///< Of the item's own axes instead of the world's.

    friend bool operator==(const AxisLock&, const AxisLock&) = default;
};

/// The lock after one of the keys: the same one again takes the item's own axis, and a third time frees it.
[[nodiscard]] AxisLock pressAxis(const AxisLock& lock, int axis, bool shift);
[[nodiscard]] vec3 axisVector(int axis);
/// "", "along X", "along its own X", "in the YZ plane".
[[nodiscard]] std::string lockText(const AxisLock& lock);

/// Where the mouse's ray takes a point that started at `start` (world).
///
/// Free: the plane through `start` that faces the camera, so that the depth stays, moved `depth` metres away from the
/// eye. Axis: the point of the axis line through `start` that is nearest to the ray. Plane: where the ray meets the
/// plane through `start`. Rays that run (nearly) along the plane or the axis give nothing: the target stays.
/// `axes`: the rotation of the axes that the lock means.
[[nodiscard]] std::optional<vec3> dragTarget(const render::Ray& ray, const vec3& start, const vec3& cameraForward,
                                             const AxisLock& lock, float depth = 0.0F, const quat& axes = {1, 0, 0, 0});

/// Digits, minus and point typed during a transform ("1.5"); empty text means no number.
class NumberEntry {
  public:
    /// 0 to 9, kMinus or kPoint.
    void type(int symbol);
    void backspace() {
        if (!text_.empty()) text_.pop_back();
    }
    void clear() { text_.clear(); }
    [[nodiscard]] const std::string& text() const { return text_; }
    /// The number typed so far; nothing while it is none ("", "-", ".").
    [[nodiscard]] std::optional<float> value() const;

    static constexpr int kMinus = 10;
    static constexpr int kPoint = 11;

  private:
    std::string text_;
};

}  // namespace lutka::editor
