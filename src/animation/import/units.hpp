#pragma once

#include <assimp/scene.h>

#include <span>
#include <string>
#include <vector>

#include "animation/character.hpp"
#include "animation/import/affine.hpp"
#include "animation/import/import_character.hpp"

namespace lutka::animation::rig_import {

/// From scene space to model space: metres, Y up.
struct UnitsAndAxes {
    dmat3 rotation{1.0};
    double scale = 1.0;
    UnitInfo info;

    [[nodiscard]] dmat4 modelFromScene() const;
};

/// Where a scene's units and axes come from besides the figure itself.
struct SceneConvention {
    bool isGltf = false;
    bool isCollada = false;  ///< Assimp converts both unit and axes.
    const aiMetadata* metadata = nullptr;
};

/// Settles units and up axis: the options', else the file's own where they give a plausible figure, else a guess from
/// the figure (`points`: where it stands in scene space, vertices and joints) with a warning.
///
/// Plausible is a height of 0.3 to 3.5 m. Otherwise the unit is the one among centimetre, decimetre, inch,
/// millimetre … that makes the figure as tall as a person, else whatever makes it 1.75 m.
[[nodiscard]] UnitsAndAxes settleUnits(const SceneConvention& convention, std::span<const vec3> points,
                                       const ImportOptions& options, std::vector<std::string>& warnings);

}  // namespace lutka::animation::rig_import
