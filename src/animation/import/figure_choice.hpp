#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "animation/import/source_scene.hpp"
#include "core/result.hpp"

namespace lutka::animation::rig_import {

/// One of a file's characters, with its hats and hair on joints of their own.
struct SourceFigure {
    std::string name;          ///< Of the node above its topmost joint; of that joint when there is none.
    std::vector<int> skins;    ///< Indices into SourceScene::skins.
    std::set<int> joints;      ///< Nodes that its skins name.
    std::size_t vertices = 0;  ///< That its skins move.
};

struct FigureChoice {
    std::vector<SourceFigure> figures;  ///< In the order of their nodes; empty in a file without skins.
    std::size_t taken = 0;              ///< Index into `figures`.
};

/// Leaves out of a scene what is no part of its figure, with a warning each: meshes that hang on no joint of a skin
/// (ground, crates) beside skinned ones, or on a few joints of their own and larger than the figure or away from it,
/// and the meshes of other characters: skins of another armature whose joints bear the first one's names, or that is a
/// whole skeleton standing beside it. A garment, hair or hat on joints of its own stays. The figure is `wanted`,
/// counted from 1, else the one with most vertices. In a file without skins the figure is what hangs on the joints of
/// its own humanoid block (VRM), else everything. Fails with ErrorCode::usage when there is no such figure.
[[nodiscard]] Result<FigureChoice> chooseFigure(SourceScene& scene, std::optional<int> wanted);

}  // namespace lutka::animation::rig_import
