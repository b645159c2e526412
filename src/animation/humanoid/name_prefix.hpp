#pragma once

#include <span>
#include <string>

namespace lutka::animation {

/// A figure's own name before the names of its joints ("LowMan" of "LowManHips", "Footman" of "Footman_L_Hand"), when
/// it has a word that body parts have, too: it says the same of all joints, and so nothing of any. Empty when there is
/// none. It ends before a separator or a capital letter, and at least four in five of `names` (and eight) go on after
/// it with letters. Namespaces ("LowMan:Hips") are no part of it: `tokenise` drops them.
[[nodiscard]] std::string figureName(std::span<const std::string> names);

}  // namespace lutka::animation
