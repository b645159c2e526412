#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>

namespace lutka::animation::rig_import {

/// Names for a warning, joined by commas: the first eight of them, for nobody reads more.
inline std::string firstOf(std::span<const std::string> names) {
    constexpr std::size_t kMost = 8;
    return fmt::format("{}{}", fmt::join(names.first(std::min(names.size(), kMost)), ", "),
                       names.size() > kMost ? " …" : "");
}

/// "1 mesh is", "2 meshes are".
inline std::string countOf(std::size_t count, const char* one, const char* many) {
    return fmt::format("{} {}", count, count == 1 ? one : many);
}

}  // namespace lutka::animation::rig_import
