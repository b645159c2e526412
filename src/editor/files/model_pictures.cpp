#include "editor/files/model_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>

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

render::Image smallPicture(const render::Image& view, const render::PictureInsets& covered, render::Extent size) {
    const auto width = static_cast<float>(view.width);
    const auto height = static_cast<float>(view.height);
    float left = width * covered.left;
    float top = height * covered.top;
    float across = std::max(width * (1.0F - covered.right) - left, 1.0F);
    float down = std::max(height * (1.0F - covered.bottom) - top, 1.0F);
    const float wanted = size.aspect();
    if (across > down * wanted) {
        left += 0.5F * (across - down * wanted);
        across = down * wanted;
    } else {
        top += 0.5F * (down - across / wanted);
        down = across / wanted;
    }
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
