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

    /// What the curve does before its first or after its last key.
    struct Beyond {
        enum class Kind { hold, slope, repeat, mirror, repeatOnwards };
        Kind kind = Kind::hold;
        std::int64_t times = -1;  ///< How often it is repeated; negative: for ever.
    };

    /// Keys out of order or not finite are dropped.
    Curve(const std::vector<Key>& keys, const Beyond& before, const Beyond& after);

    [[nodiscard]] const std::vector<Key>& keys() const { return keys_; }
    [[nodiscard]] double at(double seconds) const;
    /// Whether it changes at all.
    [[nodiscard]] bool moves() const;

  private:
    [[nodiscard]] double within(double seconds) const;
    [[nodiscard]] double beyond(double seconds) const;

    std::vector<Key> keys_;
    Beyond before_;
    Beyond after_;
};

/// How a curve goes on before its keys ("Pre-Extrapolation") or after them ("Post-Extrapolation").
[[nodiscard]] Curve::Beyond readBeyond(const Record& curve, std::string_view side);

/// The curve of an FBX 7 AnimationCurve record; nothing without keys.
[[nodiscard]] std::optional<Curve> readCurve(const Record& record, double ticksPerSecond);

/// The curve of an FBX 6 channel record (Default, KeyVer, KeyCount, Key); nothing without keys.
[[nodiscard]] std::optional<Curve> readChannel(const Record& record, double ticksPerSecond);

}  // namespace lutka::animation::rig_import::fbx
