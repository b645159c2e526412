#pragma once

#include <string>
#include <vector>

#include "animation/import/assimp/collada_nodes.hpp"

namespace lutka::animation::rig_import {

/// Writes the targets of a document's animations as Assimp 5.2.5 knows them, `id/sid` or `id/sid.MEMBER`, with the ids
/// and sids that ColladaNodes gives: a target may lead there over several sids, call members by their place or in small
/// letters, and (of some exporters) call the node by its name or sid. Numbers of a matrix become `id/sid(i)(j)` or
/// `id/sid(i)`, as the file has them. Channels that move no part of a node are taken out and told.
void settleTargets(const ColladaDocument& document, const ColladaNodes& nodes, ColladaChanges& changes,
                   std::vector<std::string>& warnings);

}  // namespace lutka::animation::rig_import
