#pragma once

#include <cstdint>

namespace lutka::physics {

/// The handle of something in one world: a place and how often that place has been given away. Handles stay what they
/// are when others are added or removed, and the handle of something removed never comes to mean something else. Each
/// kind has a type of its own, so that one cannot be taken for another.
template <class Kind>
struct Id {
    std::int32_t index = -1;       ///< -1: of nothing.
    std::uint32_t generation = 0;  ///< >= 1 where it is of something.

    /// Whether it was ever given by a world; WorldView::has() tells whether it still is of something there.
    [[nodiscard]] constexpr bool isSet() const { return index >= 0; }
    friend constexpr bool operator==(const Id&, const Id&) = default;
};

using DollId = Id<struct DollKind>;
using PropId = Id<struct PropKind>;
using StaticId = Id<struct StaticKind>;
using DragId = Id<struct DragKind>;

}  // namespace lutka::physics
