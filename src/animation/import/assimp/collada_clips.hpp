#pragma once

#include <string>

#include "animation/import/assimp/collada_tags.hpp"
#include "animation/import/source_scene.hpp"

namespace lutka::animation::rig_import {

/// Gathers the animations of each clip of a tidied Collada document (tidyCollada(), withOwnIds()) in one: Assimp 5.2.5
/// makes a clip of each joint of them and forgets their names. Where clips share animations, being parts of one time
/// line, they are taken away: then that time line is the clip.
[[nodiscard]] std::string gatheredCollada(std::string text);

/// Gives the clips that Assimp made of a gathered document (gatheredCollada()) their names, to which it adds that of
/// the first, or that very name once more, and the beginnings and ends that the file states: of a time line that clips
/// share each becomes its part. `document` is the file's own text, in which the clips still stand.
void settleColladaClips(const ColladaDocument& document, SourceScene& scene);

}  // namespace lutka::animation::rig_import
