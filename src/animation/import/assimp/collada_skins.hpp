#pragma once

#include <string>
#include <vector>

#include "animation/import/assimp/collada_nodes.hpp"

namespace lutka::animation::rig_import {

/// Names the joints of each skin by the ids that ColladaNodes gives them. Which joint is meant: by its sid in the
/// skeletons that the skin is shown with, else by its id, its sid anywhere, its name. A skin that is shown with
/// several skeletons becomes one for each, as far as the copies are not too large, which is told.
void settleSkins(const ColladaDocument& document, const ColladaNodes& nodes, ColladaChanges& changes,
                 std::vector<std::string>& warnings);

}  // namespace lutka::animation::rig_import
