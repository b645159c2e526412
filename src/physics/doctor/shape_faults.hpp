#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "physics/fit/anatomy.hpp"
#include "physics/fit/body_plan.hpp"
#include "physics/fit/limits.hpp"

namespace lutka::physics {

/// What is wrong with one body's shape, whatever the others are like.
struct ShapeFault {
    const char* code;     ///< `body-tiny`, `body-huge`, `capsule-outside-skin` or `skin-not-covered`.
    std::string measure;  ///< The figure and the bound that it breaks.
};
[[nodiscard]] bool isShapeFault(std::string_view code);
/// Of a shape in the standard stance's axes, for the body's part of the skin and a figure of that height.
[[nodiscard]] std::vector<ShapeFault> shapeFaults(const PlannedBody& body, const PlacedShape& shape, float heightM);

/// Shapes that mend faults: those that the fit makes anew. They are made when they are asked for.
class NewShapes {
  public:
    /// Keeps references to the plan and its anatomy. `mostShapes`: what a body may have already.
    NewShapes(const BodyPlan& plan, const Anatomy& anatomy, int mostShapes, float heightM)
        : plan_(plan), anatomy_(anatomy), mostShapes_(mostShapes), heightM_(heightM) {}

    /// The fit's shape of a body of the plan that lacks the fault: with `mostShapes`, else with as many as a body can
    /// have. Null: no fit is without it.
    [[nodiscard]] const PlacedShape* without(std::string_view fault, int planned);

  private:
    const BodyPlan& plan_;
    const Anatomy& anatomy_;
    int mostShapes_;
    float heightM_;
    std::vector<PlacedShape> few_;
    std::vector<PlacedShape> many_;
};

}  // namespace lutka::physics
