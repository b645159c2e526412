#pragma once

#include <array>
#include <string>
#include <vector>

#include "animation/character.hpp"
#include "animation/import/skin_binding.hpp"

namespace lutka::animation::rig_import {

/// The skin of one vertex: joints and weights, strongest first, sum 1; unused places are joint 0 with weight 0.
struct VertexSkin {
    std::array<std::uint16_t, kMaxInfluences> joints{};
    std::array<float, kMaxInfluences> weights{};
};

/// What had to be done to the file's weights, over all meshes.
struct WeightRepairs {
    int vertices = 0;             ///< Of skinned meshes, all.
    int dropped = 0;              ///< Vertices with more than kMaxInfluences influences.
    int mostInfluences = 0;       ///< The largest number on one vertex.
    double largestDropped = 0.0;  ///< The largest share of a vertex's weight that was dropped, [0, 1].
    int unweighted = 0;           ///< Vertices without any weight.
    int invalid = 0;              ///< Weights that were negative, not finite or on no vertex.
    int unnormalised = 0;         ///< Vertices whose weights summed to something more than 1 % off 1.
    double largestSumError = 0.0;

    /// A sentence for each kind of repair that occurred.
    [[nodiscard]] std::vector<std::string> sentences() const;
};

/// The weights of all vertices of a skinned mesh; those without any go to `fallbackJoint`.
[[nodiscard]] std::vector<VertexSkin> readWeights(const MeshInstance& instance, int fallbackJoint,
                                                  WeightRepairs& repairs);

}  // namespace lutka::animation::rig_import
