#pragma once

#include <fmt/format.h>

#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include "core/math.hpp"
#include "physics/profile/convex_hull.hpp"

namespace lutka::exporting {

/// Lines of text with an indent of so many steps of two blanks.
class TextBuilder {
  public:
    template <class... Args>
    void line(fmt::format_string<Args...> format, Args&&... args) {
        text_.append(2 * static_cast<std::size_t>(depth_), ' ');
        fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
        text_ += '\n';
    }
    void blank() { text_ += '\n'; }
    /// Lines as they are.
    void block(std::string_view lines) { text_ += lines; }
    void indent() { ++depth_; }
    void outdent() { --depth_; }
    [[nodiscard]] std::string take() { return std::move(text_); }

  private:
    std::string text_;
    int depth_ = 0;
};

/// The shortest decimal that reads back to the same float; zero without a sign. A point in every locale.
[[nodiscard]] inline std::string numberText(float value) {
    return fmt::format("{}", value == 0.0F ? 0.0F : value);
}
/// Components with `between` between them.
[[nodiscard]] inline std::string vectorText(const vec3& v, std::string_view between = " ") {
    return fmt::format("{1}{0}{2}{0}{3}", between, numberText(v.x), numberText(v.y), numberText(v.z));
}
/// w x y z
[[nodiscard]] inline std::string quaternionTextWxyz(const quat& q, std::string_view between = " ") {
    return fmt::format("{1}{0}{2}{0}{3}{0}{4}", between, numberText(q.w), numberText(q.x), numberText(q.y),
                       numberText(q.z));
}
/// x y z w
[[nodiscard]] inline std::string quaternionTextXyzw(const quat& q, std::string_view between = " ") {
    return fmt::format("{1}{0}{2}{0}{3}{0}{4}", between, numberText(q.x), numberText(q.y), numberText(q.z),
                       numberText(q.w));
}

/// The corners of a hull, with `between` between their components and between them.
[[nodiscard]] inline std::string pointsText(const physics::ConvexHull& hull, std::string_view between = " ") {
    std::string text;
    for (const vec3& point : hull.points())
        text += fmt::format("{}{}", text.empty() ? "" : between, vectorText(point, between));
    return text;
}

/// Between double quotes in C, C#, Python, JavaScript, JSON and Godot's scenes: backslash, quote and control characters
/// are escaped.
[[nodiscard]] std::string quotedText(std::string_view text);

}  // namespace lutka::exporting
