#pragma once

#include "animation/import/source_scene.hpp"

namespace lutka::animation::rig_import {

/// Leaves out the instances that the file hides (SourceInstance::hidden), with a word: a coarser copy for the distance,
/// a cage, another dress would count as the figure's skin. Where nothing of the figure would be left (no mesh with a
/// skin, or in a file without skins no mesh at all) everything stays; and, with another word, where what is shown moves
/// less than a quarter of the figure's joints: eyelashes of a hidden body.
void leaveOutHidden(SourceScene& scene);

}  // namespace lutka::animation::rig_import
