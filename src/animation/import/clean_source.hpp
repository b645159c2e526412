#pragma once

#include "animation/import/source_scene.hpp"

namespace lutka::animation::rig_import {

/// Takes what is not a finite number out of a scene: triangles with such vertices, such weights, normals, keys and
/// transforms. Tells what was dropped.
void cleanNumbers(SourceScene& scene);

/// Control characters of names become '_', those of warnings blanks.
void cleanNames(SourceScene& scene);

}  // namespace lutka::animation::rig_import
