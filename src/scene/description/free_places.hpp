#pragma once

#include <vector>

#include "scene/asset/figure_bounds.hpp"

namespace lutka::scene {

/// Where figures of one kind have been placed, to place others beside them: dolls that start inside each other are
/// thrown apart in the first frames.
class FreePlaces {
  public:
    explicit FreePlaces(const FigureBounds& figure);

    /// How deep a figure would lie in those that are placed, metres, with its middle at `centre` and turned by `turn`
    /// about it; 0 where it is clear of all.
    [[nodiscard]] float depthAt(const vec3& centre, const quat& turn) const;
    void take(const vec3& centre, const quat& turn) { taken_.push_back(bodiesAt(centre, turn)); }

  private:
    struct Placed {
        vec3 centre{0, 0, 0};
        std::vector<RigidTransform> worldFromBody;
    };
    [[nodiscard]] Placed bodiesAt(const vec3& centre, const quat& turn) const;
    [[nodiscard]] float depthIn(const Placed& a, const Placed& b) const;

    const FigureBounds& figure_;
    float reach_ = 0.0F;  // of the figure from its middle
    std::vector<Placed> taken_;
};

}  // namespace lutka::scene
