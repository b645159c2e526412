#pragma once

#include <vector>

#include "scene/run/simulation.hpp"

namespace lutka::scene {

/// Points around what a view has to show, world: those of one doll as it is between its last two steps (`alpha` as in
/// Simulation::pose), the box of each body with its eight corners, and the skin that reaches beyond (skinReach()).
/// Appends to `points`.
void addExtentOfDoll(Simulation& simulation, int doll, float alpha, std::vector<vec3>& points);

/// The same of all that a scene shows: its dolls, what stands still, and what rolls about. Floors have no end and count
/// as the ground below the dolls; what flies in fast comes into the picture by itself.
void addExtentOfScene(Simulation& simulation, float alpha, std::vector<vec3>& points);

}  // namespace lutka::scene
