#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>

namespace lutka::animation::rig_import::gltf {

/// The document that a glTF's JSON holds, in UTF-8 or (with its mark) UTF-16. What many writers get wrong and what has
/// one meaning only is mended, and told in `leftOut`: names in another encoding, with half of a surrogate pair or with
/// raw control characters, and numbers that are none (NaN, Infinity), which become texts: a measure that is none is
/// left out, an index that is none refuses the file. Indices as `2.0` are whole numbers. Throws Damage with the place
/// of what can't be read.
[[nodiscard]] nlohmann::json parseGltfText(std::span<const std::uint8_t> text, std::set<std::string>& leftOut);

}  // namespace lutka::animation::rig_import::gltf
