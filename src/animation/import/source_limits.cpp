#include "animation/import/source_limits.hpp"

#include <fmt/format.h>

namespace lutka::animation::rig_import {
namespace {

constexpr const char* kMend = "export the character without the rest of the scene";

}  // namespace

Error tooLargeFile(const std::string& location) {
    return {ErrorCode::input, fmt::format("is larger than {} MiB", kMaxFileBytes >> 20U), location, kMend};
}

Error tooManyNodes(const std::string& location) {
    return {ErrorCode::input, fmt::format("more than {} nodes (each place of a shared node counts)", kMaxNodes),
            location, kMend};
}

Error nestedTooDeep(const std::string& location) {
    return {ErrorCode::input, fmt::format("nodes are nested deeper than {}", kMaxDepth), location, kMend};
}

}  // namespace lutka::animation::rig_import
