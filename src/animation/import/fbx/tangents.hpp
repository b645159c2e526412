#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "animation/import/fbx/curve.hpp"

namespace lutka::animation::rig_import::fbx {

/// Bits of a key's flags (FBX SDK, FbxAnimCurveDef).
inline constexpr std::uint32_t kConstant = 0x2;
inline constexpr std::uint32_t kCubic = 0x8;
inline constexpr std::uint32_t kConstantNext = 0x100;  ///< With kConstant: the next key's value.
inline constexpr std::uint32_t kTcb = 0x200;
inline constexpr std::uint32_t kUser = 0x400;  ///< The slopes are given; else they follow from the neighbours.
inline constexpr std::uint32_t kBreak = 0x800;
inline constexpr std::uint32_t kClamp = 0x1000;
inline constexpr std::uint32_t kTimeIndependent = 0x2000;
inline constexpr std::uint32_t kClampProgressive = 0x4000;
inline constexpr std::uint32_t kWeightedRight = 0x1000000;
inline constexpr std::uint32_t kWeightedNextLeft = 0x2000000;

/// A key's flags and its four numbers: slope on leaving, slope on arriving at the next key, both weights, both
/// velocities.
struct KeyData {
    std::uint32_t flags = 0;
    std::array<float, 4> numbers{};
};

/// Two weights as the file packs them into one number: shares in units of 1/10,000, 16 bits each.
[[nodiscard]] float packedWeights(double right, double nextLeft);

/// Brings keys and their data (one element a key) into the order of time; those of one time stay as they were.
void sortKeys(std::vector<Curve::Key>& keys, std::vector<KeyData>& data);

/// Works out interpolation, slopes and weights of all keys from their data (one element a key).
void setTangents(std::vector<Curve::Key>& keys, const std::vector<KeyData>& data);

}  // namespace lutka::animation::rig_import::fbx
