#pragma once

#include <optional>
#include <span>
#include <string>

#include "animation/clip.hpp"

namespace lutka::editor {

/// A list of clips that is as wide as the next widget: what it shows while it is closed is cut in its middle, since
/// many exporters begin every name with the armature's. As ImGui::BeginCombo(): EndCombo() when it is open.
[[nodiscard]] bool beginClipCombo(const char* id, const std::string& preview);
/// A line a clip, in an open list; the one that `present` means is marked. What animation::clipReference() says of the
/// one that was chosen just now; nothing: none was.
[[nodiscard]] std::optional<std::string> chooseListedClip(std::span<const animation::Clip> clips,
                                                          const std::string& present, const char* before = "");
/// What the closed list shows: the label of the clip that is meant, or, where there is none, the text itself.
[[nodiscard]] std::string shownClip(std::span<const animation::Clip> clips, const std::string& present);

}  // namespace lutka::editor
