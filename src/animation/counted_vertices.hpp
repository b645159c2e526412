#pragma once

#include <cstddef>
#include <vector>

#include "animation/character.hpp"

namespace lutka::animation {

/// How many of each mesh's vertices count where shares of the skin are told, a mesh an entry. On a figure with a skin a
/// rigid mesh counts for no more than a quarter of the skin's vertices: a sword of many is no half of it. Figures of
/// rigid parts alone count whole.
[[nodiscard]] std::vector<std::size_t> countedVertices(const Character& character);

}  // namespace lutka::animation
