#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "report/page.hpp"
#include "scene/asset/ragdoll_asset.hpp"
#include "scene/measure/checkup.hpp"

namespace lutka::reporting {

/// What the table keeps of a model.
struct LibraryRow {
    std::string model;  ///< Path below the folder.
    scene::Checkup checkup;
    bool humanoid = false;
    float mappingSure = 0;  ///< [0, 1]; of a humanoid.
    std::size_t bodies = 0;
    float heightM = 0;
    float massKg = 0;
    std::string thumbnail;  ///< PNG; may be empty.
};

/// A model that is not in the table, and why.
struct RefusedModel {
    std::string model;
    Error error;
};

struct Library {
    std::string folder;
    std::vector<LibraryRow> rows;
    std::vector<RefusedModel> refused;
};

/// The files below the folder whose names end like a model's, sorted by path; hidden ones and what can't be looked into
/// are left out. Fails with ErrorCode::input when the folder itself can't be read.
[[nodiscard]] Result<std::vector<std::filesystem::path>> modelsBelow(const std::filesystem::path& folder);

[[nodiscard]] LibraryRow libraryRow(const std::string& model, const scene::RagdollAsset& asset, scene::Checkup checkup);

/// Best score first, then by name; refused ones by name.
void sortLibrary(Library& library);

/// The page, of one file; models in the order of the library.
[[nodiscard]] std::string libraryReportHtml(const Library& library, const PageParts& parts, std::string_view version);

/// The same facts: {"folder", "models": [{"model", "score", "errors", "warnings", …}], "refused": [{"model", "why",
/// "mend"}]}.
[[nodiscard]] std::string libraryReportJson(const Library& library);

}  // namespace lutka::reporting
