#pragma once

#include <vector>

#include "editor/play/player.hpp"
#include "editor/view/picking.hpp"

namespace lutka::editor {

/// What can be picked by its box in the document's scene, each where it is now.
[[nodiscard]] std::vector<PickTarget> pickTargets(const EditorDocument& document, const Player& player);

}  // namespace lutka::editor
