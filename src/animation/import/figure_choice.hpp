#pragma once

#include "animation/import/source_scene.hpp"

namespace lutka::animation::rig_import {

/// Leaves out of a scene what is no part of its figure, with a warning each: meshes that hang on no joint of a skin
/// (ground, crates) beside skinned ones, and the meshes of a second character: skins of another armature whose joints
/// bear the first one's names, or that is a whole skeleton standing apart. A garment, hair or hat on joints of its own
/// stays. In a file without skins everything is the figure.
void chooseFigure(SourceScene& scene);

}  // namespace lutka::animation::rig_import
