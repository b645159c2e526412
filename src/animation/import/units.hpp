#pragma once

#include <span>
#include <string>
#include <vector>

#include "animation/character.hpp"
#include "animation/import/affine.hpp"
#include "animation/import/source_scene.hpp"

namespace lutka::animation::rig_import {

/// From scene space to model space: metres, Y up.
struct UnitsAndAxes {
    dmat3 rotation{1.0};
    double scale = 1.0;
    dvec3 translation{0.0};  ///< Model space: brings a figure that stands far away to the origin, else zero.
    UnitInfo info;

    [[nodiscard]] dmat4 modelFromScene() const;
};

/// What a file shows, as far as its size goes.
enum class Subject { figure, hand };

/// A hand where eight joints or more, and seven in ten of all, are named as parts of fingers, and none as a part of
/// trunk, head, legs or arms.
[[nodiscard]] Subject subjectOf(std::span<const std::string> jointNames);

/// Settles units and up axis: the options', else the file's own where they give a plausible figure, else a guess from
/// the figure (`points`: where it stands in scene space, vertices and joints) with a warning.
///
/// Plausible is a height of 0.3 to 3.5 m. Otherwise the unit is the one among centimetre, decimetre, inch,
/// millimetre … that makes the figure as tall as a person, else whatever makes it 1.75 m. A hand is 0.19 m long,
/// plausibly 0.08 to 0.6 m.
[[nodiscard]] UnitsAndAxes settleUnits(const SourceConvention& convention, std::span<const vec3> points,
                                       Subject subject, const ImportOptions& options,
                                       std::vector<std::string>& warnings);

}  // namespace lutka::animation::rig_import
