#pragma once

#include <cstdint>

namespace lutka {

/// A small seeded generator, the same numbers on every platform (SplitMix64, Steele, Lea and Flood 2014).
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t next() {
        std::uint64_t z = (state_ += 0x9E3779B97F4A7C15ULL);
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
        return z ^ (z >> 31U);
    }

    /// Uniform in [low, high).
    float uniform(float low, float high) {
        const float unit = static_cast<float>(next() >> 40U) * 0x1.0p-24F;
        return low + (high - low) * unit;
    }

  private:
    std::uint64_t state_;
};

/// Folds bytes into a 64-bit FNV-1a hash; start with kHashStart. For state hashes and tests, not for security.
inline constexpr std::uint64_t kHashStart = 0xCBF29CE484222325ULL;
[[nodiscard]] inline std::uint64_t hashBytes(const void* data, std::uint64_t size, std::uint64_t hash = kHashStart) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::uint64_t i = 0; i < size; ++i)
        hash = (hash ^ bytes[i]) * 0x100000001B3ULL;
    return hash;
}

}  // namespace lutka
