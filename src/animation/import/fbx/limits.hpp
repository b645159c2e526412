#pragma once

#include <cstddef>

namespace lutka::animation::rig_import::fbx {

/// What a document may hold at most: far above what exporters write, and small enough to stay within memory.
inline constexpr int kMaxRecordDepth = 64;
inline constexpr std::size_t kMaxRecords = 4'000'000;
inline constexpr std::size_t kMaxValues = 8'000'000;         ///< Scalars and texts.
inline constexpr std::size_t kMaxArrayNumbers = 64'000'000;  ///< In all arrays together.
/// zlib never packs more than 1032 : 1.
inline constexpr std::size_t kMostDeflation = 1040;

}  // namespace lutka::animation::rig_import::fbx
