#include "editor/files/model_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <glm/common.hpp>
#include <utility>

namespace lutka::editor {

namespace fs = std::filesystem;

fs::path modelPictureFolder() {
    const char* cache = std::getenv("XDG_CACHE_HOME");
    if (cache != nullptr && *cache != '\0') return fs::path(cache) / "lutka" / "models";
    const char* home = std::getenv("HOME");
    if (home != nullptr && *home != '\0') return fs::path(home) / ".cache" / "lutka" / "models";
    return {};
}

fs::path modelPictureFile(const fs::path& folder, const fs::path& model) {
    std::error_code failed;
    // FNV-1a, 64 bits: the same in every run.
    std::uint64_t hash = 14695981039346656037ULL;
    for (const char c : fs::absolute(model, failed).lexically_normal().string())
        hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
    return folder / fmt::format("{:016x}.png", hash);
}

render::PictureInsets insetsAround(std::span<const vec3> points, const render::Camera& camera, render::Extent window) {
    vec2 low(1e9F);
    vec2 high(-1e9F);
    for (const vec3& point : points) {
        const auto seen = render::project(camera, point, window);
        if (!seen) continue;
        low = glm::min(low, vec2(*seen));
        high = glm::max(high, vec2(*seen));
    }
    if (high.x <= low.x || high.y <= low.y) return {};
    constexpr float kRoom = 0.08F;  // on each side, of the part's size
    const vec2 size(static_cast<float>(window.width), static_cast<float>(window.height));
    const vec2 room = kRoom * (high - low);
    low = glm::clamp((low - room) / size, vec2(0), vec2(1));
    high = glm::clamp((high + room) / size, vec2(0), vec2(1));
    return {low.x, 1.0F - high.x, low.y, 1.0F - high.y};
}

render::Image smallPicture(const render::Image& view, const render::PictureInsets& around, render::Extent size) {
    const vec2 whole(static_cast<float>(view.width), static_cast<float>(view.height));
    const vec2 inside(1.0F - around.left - around.right, 1.0F - around.top - around.bottom);
    const vec2 middle = whole * (vec2(around.left, around.top) + 0.5F * inside);
    const float wanted = size.aspect();
    vec2 part = glm::max(whole * inside, vec2(1));
    part = {std::max(part.x, part.y * wanted), std::max(part.y, part.x / wanted)};
    part *= std::min(1.0F, std::min(whole.x / part.x, whole.y / part.y));
    const vec2 corner = glm::clamp(middle - 0.5F * part, vec2(0), whole - part);
    const auto [left, top] = std::pair(corner.x, corner.y);
    const auto [across, down] = std::pair(part.x, part.y);
    render::Image picture(size, {});
    const auto clamped = [](float at, int count) { return std::clamp(static_cast<int>(at), 0, count - 1); };
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            // The mean of what the pixel covers.
            const int x0 = clamped(left + across * static_cast<float>(x) / static_cast<float>(size.width), view.width);
            const int x1 =
                clamped(left + across * static_cast<float>(x + 1) / static_cast<float>(size.width), view.width);
            const int y0 = clamped(top + down * static_cast<float>(y) / static_cast<float>(size.height), view.height);
            const int y1 =
                clamped(top + down * static_cast<float>(y + 1) / static_cast<float>(size.height), view.height);
            std::array<int, 3> sum{};
            int count = 0;
            for (int row = y0; row <= std::max(y0, y1 - 1); ++row) {
                for (int column = x0; column <= std::max(x0, x1 - 1); ++column, ++count) {
                    const render::Color color = view.at(column, row);
                    sum[0] += color.r;
                    sum[1] += color.g;
                    sum[2] += color.b;
                }
            }
            const auto mean = [&](int channel) {
                return static_cast<std::uint8_t>(sum[static_cast<std::size_t>(channel)] / count);
            };
            picture.set(x, y, {mean(0), mean(1), mean(2), 255});
        }
    }
    return picture;
}

}  // namespace lutka::editor
