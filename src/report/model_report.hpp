#pragma once

#include <string>
#include <vector>

#include "report/drop_trace.hpp"
#include "report/page.hpp"
#include "report/pictures.hpp"
#include "scene/asset/ragdoll_asset.hpp"
#include "scene/measure/checkup.hpp"

namespace lutka::reporting {

/// What a model's page shows.
struct ModelFacts {
    scene::Checkup checkup;
    std::vector<DropTrace> drops;   ///< One a drop of the checkup.
    std::vector<Picture> pictures;  ///< May be empty.
};

/// Examines the ragdoll and keeps what its drops did; with a photographer, pictures too.
[[nodiscard]] ModelFacts gatherFacts(const scene::RagdollAsset& asset, Photographer* photographer = nullptr);

/// The page, of one file: it refers to nothing outside itself. The same facts give the same bytes.
[[nodiscard]] std::string modelReportHtml(const scene::RagdollAsset& asset, const ModelFacts& facts,
                                          const PageParts& parts, std::string_view version);

}  // namespace lutka::reporting
