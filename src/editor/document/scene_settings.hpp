#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/run/simulation.hpp"

namespace lutka::editor {

/// What is simulated, where and how.
struct SceneSettings {
    scene::EntityScene entities;
    std::string scenario = "drop";      ///< The named scene that `made` were made as; empty: the scene is from a file.
    int count = 1;                      ///< Its dolls, [1, 10000].
    std::uint64_t seed = 0;             ///< And its seed.
    std::vector<scene::EntityId> made;  ///< Sorted; what another named scene takes the place of.
    scene::EntityScene begun;           ///< The scene before the user changed its entities.
    scene::StartPose pose = scene::StartPose::bind;  ///< Of characters that say nothing themselves.
    std::optional<scene::ClipStart> clip;            ///< Likewise, where they have it; wins over `pose`.
};

/// Makes the entities of the named scene anew; those that the user added stay, and so do the world's settings. Fails as
/// makeScene() does; nothing is done when `scenario` is empty.
[[nodiscard]] Result<void> makeNamedScene(SceneSettings& settings, const scene::FigureBounds& figure);
/// Adds so many of the edited character in the air over the middle, each turned another way; `count` at least 1.
void addCopies(scene::EntityScene& scene, int count);

}  // namespace lutka::editor
