#pragma once

#include <string>

#include "animation/import/assimp/collada_tags.hpp"

namespace lutka::animation::rig_import {

/// Follows links of a tidied Collada document (tidyCollada()) that Assimp 5.2.5 loses. A node of a library that is
/// shown once stands in the scene itself: Assimp moves none of its animations. A skin over a morph controller, and a
/// morph controller over a skin, are the skin over the plain mesh: Assimp drops the first with its mesh.
[[nodiscard]] std::string linkedCollada(std::string text);

/// Whether a document's morph targets are on from the start: a weight is not 0.
[[nodiscard]] bool holdsMorphs(const ColladaDocument& document);

/// A document that shows the scene which it means: where it names none, or one that is not there, its first.
struct ShownCollada {
    std::string text;
    std::string warning;  ///< Where there are several to choose from; else empty.
};
[[nodiscard]] ShownCollada shownCollada(std::string text);

}  // namespace lutka::animation::rig_import
