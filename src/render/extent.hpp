#pragma once

namespace lutka::render {

/// A size in pixels; both above zero.
struct Extent {
    int width = 960;
    int height = 540;

    [[nodiscard]] float aspect() const { return static_cast<float>(width) / static_cast<float>(height); }
    friend bool operator==(const Extent&, const Extent&) = default;
};

}  // namespace lutka::render
