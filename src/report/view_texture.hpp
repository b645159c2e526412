#pragma once

#include <string>

#include "animation/character.hpp"

namespace lutka::reporting {

/// The texture as a data URI of a PNG whose longer side is `side` pixels at most: halved as often as that takes, each
/// time by the mean of four pixels. Empty for a texture without pixels.
[[nodiscard]] std::string textureUri(const animation::Texture& texture, int side);

}  // namespace lutka::reporting
