#pragma once

#include <cstdint>

namespace lutka::physics {

/// Who collides with whom: two things do where each one's layers meet the other's mask.
struct CollisionFilter {
    static constexpr std::uint32_t kAll = 0xFFFFFFFFU;
    std::uint32_t layers = 1;   ///< Bit set of the layers that it is in.
    std::uint32_t mask = kAll;  ///< Bit set of the layers that it collides with.

    [[nodiscard]] constexpr bool collidesWith(const CollisionFilter& other) const {
        return (layers & other.mask) != 0 && (other.layers & mask) != 0;
    }
    bool operator==(const CollisionFilter&) const = default;
};

}  // namespace lutka::physics
