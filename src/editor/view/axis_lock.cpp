#include "editor/view/axis_lock.hpp"

#include <charconv>
#include <glm/geometric.hpp>

namespace lutka::editor {
namespace {

constexpr float kFlattest = 0.03F;  // sine of the angle below which a plane is seen edge-on
constexpr float kReach = 100.0F;    // metres; a target beyond is a glancing ray
constexpr std::size_t kMaxDigits = 12;

std::optional<vec3> onPlane(const render::Ray& ray, const vec3& point, const vec3& normal) {
    const float slope = glm::dot(ray.direction, normal);
    if (std::abs(slope) < kFlattest) return std::nullopt;
    const float along = glm::dot(point - ray.origin, normal) / slope;
    if (along <= 0.0F || along > kReach) return std::nullopt;
    return ray.origin + ray.direction * along;
}

// Where two lines come nearest (Ericson, Real-Time Collision Detection, 5.1.8), the point on the axis.
std::optional<vec3> onAxis(const render::Ray& ray, const vec3& point, const vec3& axis) {
    const float b = glm::dot(ray.direction, axis);
    const float denominator = 1.0F - b * b;
    if (denominator < kFlattest * kFlattest) return std::nullopt;
    const vec3 r = ray.origin - point;
    const float along = (glm::dot(axis, r) - b * glm::dot(ray.direction, r)) / denominator;
    if (std::abs(along) > kReach) return std::nullopt;
    return point + axis * along;
}

}  // namespace

AxisLock pressAxis(const AxisLock& lock, int axis, bool shift) {
    AxisLock pressed{shift ? AxisLock::Kind::plane : AxisLock::Kind::axis, axis, false};
    if (pressed == lock) return {pressed.kind, axis, true};
    pressed.local = true;
    if (pressed == lock) return {};
    pressed.local = false;
    return pressed;
}

vec3 axisVector(int axis) {
    vec3 vector(0);
    vector[axis] = 1.0F;
    return vector;
}

std::string lockText(const AxisLock& lock) {
    constexpr const char* along[] = {"X", "Y", "Z"};
    constexpr const char* across[] = {"YZ", "XZ", "XY"};
    const std::string own = lock.local ? "its own " : "";
    switch (lock.kind) {
        case AxisLock::Kind::free:
            return "";
        case AxisLock::Kind::axis:
            return "along " + own + along[lock.axis];
        case AxisLock::Kind::plane:
            break;
    }
    return "in " + (lock.local ? own : "the ") + across[lock.axis] + " plane";
}

std::optional<vec3> dragTarget(const render::Ray& ray, const vec3& start, const vec3& cameraForward,
                               const AxisLock& lock, float depth, const quat& axes) {
    switch (lock.kind) {
        case AxisLock::Kind::free:
            return onPlane(ray, start + cameraForward * depth, cameraForward);
        case AxisLock::Kind::axis:
            return onAxis(ray, start, axes * axisVector(lock.axis));
        case AxisLock::Kind::plane:
            break;
    }
    return onPlane(ray, start, axes * axisVector(lock.axis));
}

void NumberEntry::type(int symbol) {
    if (text_.size() >= kMaxDigits) return;
    if (symbol == kMinus) {
        // Minus turns the sign wherever it is typed.
        if (!text_.empty() && text_.front() == '-') {
            text_.erase(0, 1);
        } else {
            text_.insert(0, "-");
        }
    } else if (symbol == kPoint) {
        if (text_.find('.') == std::string::npos) text_ += '.';
    } else {
        text_ += static_cast<char>('0' + symbol);
    }
}

std::optional<float> NumberEntry::value() const {
    float number = 0;
    const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), number);
    if (error != std::errc() || end == text_.data()) return std::nullopt;
    return number;
}

}  // namespace lutka::editor
