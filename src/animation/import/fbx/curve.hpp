#pragma once

#include <optional>
#include <vector>

#include "animation/import/fbx/document.hpp"

namespace lutka::animation::rig_import::fbx {

/// One number over time: an AnimationCurve (FBX 7) or a channel of a take (FBX 6).
class Curve {
  public:
    enum class Interpolation { constant, constantNext, linear, cubic };
    struct Key {
        double seconds = 0.0;
        double value = 0.0;
        Interpolation interpolation = Interpolation::linear;  ///< To the next key.
        double slopeRight = 0.0;                              ///< Units a second, on leaving this key.
        double slopeLeft = 0.0;                               ///< On arriving at this key.
        double weightRight = 1.0 / 3.0;  ///< How far the tangent reaches, as a share of the way to the next key.
        double weightLeft = 1.0 / 3.0;   ///< The same towards the key before.
    };

    /// Keys out of order or not finite are dropped.
    explicit Curve(std::vector<Key> keys);

    [[nodiscard]] const std::vector<Key>& keys() const { return keys_; }
    /// Held before the first and after the last key.
    [[nodiscard]] double at(double seconds) const;
    /// Whether it changes at all.
    [[nodiscard]] bool moves() const;

  private:
    std::vector<Key> keys_;
};

/// Ticks of FBX time a second.
inline constexpr double kTicksPerSecond = 46'186'158'000.0;

/// The curve of an FBX 7 AnimationCurve record; nothing without keys.
[[nodiscard]] std::optional<Curve> readCurve(const Record& record);

/// The curve of an FBX 6 channel record (Default, KeyVer, KeyCount, Key); nothing without keys.
[[nodiscard]] std::optional<Curve> readChannel(const Record& record);

}  // namespace lutka::animation::rig_import::fbx
