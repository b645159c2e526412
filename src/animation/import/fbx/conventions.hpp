#pragma once

#include "animation/import/fbx/node_transform.hpp"
#include "animation/import/source_scene.hpp"

namespace lutka::animation::rig_import::fbx {

/// A document's unit and axes.
struct Conventions {
    SourceConvention stated;
    /// One unless the document's axes are left-handed: then the mirror that takes them to x right, y up, z front.
    dmat4 sceneFromFile{1.0};
};

/// From GlobalSettings: UnitScaleFactor (centimetres a unit) and UpAxis, FrontAxis, CoordAxis with their signs. What is
/// missing or out of range is left unstated.
[[nodiscard]] Conventions conventionsOf(const Properties& settings);

}  // namespace lutka::animation::rig_import::fbx
