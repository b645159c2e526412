#pragma once

#include <span>
#include <vector>

#include "physics/doctor/doctor.hpp"
#include "physics/fit/body_plan.hpp"
#include "physics/fit/limits.hpp"

namespace lutka::physics {

/// Signs that the figure as a whole is broken: no measure of the rest makes a ragdoll of it, so each is an error. Codes
/// `skin-outside-bodies`, `skin-on-one-joint`, `skin-of-others`, `skin-small` and `body-beside-skin` of diagnose().
/// `shapes` are the profile's bodies in the bind pose, in the plan's order; `fit` has been measured on them.
[[nodiscard]] std::vector<Finding> findBrokenFigure(const animation::Character& character, const BodyPlan& plan,
                                                    std::span<const PlacedShape> shapes, const FitMeasures& fit);

/// Bodies without skin that stand beside the figure, as on a control below a creature: code `body-in-the-air`, a
/// warning, for the parts of some figures that are not drawn have them. Arguments as above.
[[nodiscard]] std::vector<Finding> findBodiesInTheAir(const BodyPlan& plan, std::span<const PlacedShape> shapes);

}  // namespace lutka::physics
