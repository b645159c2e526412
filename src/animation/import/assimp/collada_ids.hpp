#pragma once

#include <string>

namespace lutka::animation::rig_import {

/// A tidied Collada document (tidyCollada()) in which no two animations, controllers or geometries share the id of a
/// source, of the numbers in it, of vertices or of a sampler. Ids are to be the only ones of their name in a document,
/// but exporters exist that call each animation's sampler "sampler", and Assimp knows all sources of a document by
/// their ids. What an animation means by an id is its own element, else that of the animation around it. Other elements
/// keep their ids.
[[nodiscard]] std::string withOwnIds(std::string text);

/// Such a document in which each channel has a sampler of its own: of several channels that name one, Assimp plays the
/// last alone.
[[nodiscard]] std::string withOwnSamplers(std::string text);

}  // namespace lutka::animation::rig_import
