#pragma once

#include <cstddef>
#include <string>

#include "core/result.hpp"

namespace lutka::animation::rig_import {

/// What a character may have at most; a file with more is refused by name of the limit.
inline constexpr std::size_t kMaxNodes = 65535;  ///< Node instances; a vertex names its joints with 16 bits.
inline constexpr int kMaxDepth = 4096;           ///< Nodes below one another.
inline constexpr std::size_t kMaxMeshes = 20'000;
inline constexpr std::size_t kMaxVertices = 10'000'000;  ///< Of all meshes together.
inline constexpr std::size_t kMaxCorners =
    50'000'000;  ///< Of the polygons of a file, before equal ones become one vertex.
// Of what the scene places, where a mesh counts as often as it is placed: a small file can place it thousands of times,
// and a character has each of its own. kMaxVertices counts so, too. All of it together stays below 2 GiB.
inline constexpr std::size_t kMaxPlacedMeshes = 65'535;
inline constexpr std::size_t kMaxPlacedIndices = 60'000'000;
inline constexpr std::size_t kMaxPlacedSlots = 4'000'000;  ///< Joints of the skins of placed meshes.

inline constexpr std::size_t kMaxFileBytes = std::size_t{1} << 30U;  ///< Of a model, and of each file that it names.
inline constexpr std::size_t kMaxJsonBytes = std::size_t{256} << 20U;
inline constexpr int kMaxJsonDepth = 256;  ///< Arrays and objects within one another.

[[nodiscard]] Error tooLargeFile(const std::string& location);
[[nodiscard]] Error tooManyNodes(const std::string& location);
[[nodiscard]] Error nestedTooDeep(const std::string& location);

}  // namespace lutka::animation::rig_import
