#include "animation/import/assimp/read_with_assimp.hpp"

#include <assimp/commonMetaData.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <utility>

#include "animation/import/assimp/clip_conversion.hpp"
#include "animation/import/assimp/collada_bind_shape.hpp"
#include "animation/import/assimp/collada_clips.hpp"
#include "animation/import/assimp/collada_curves.hpp"
#include "animation/import/assimp/collada_links.hpp"
#include "animation/import/assimp/collada_text.hpp"
#include "animation/import/assimp/flat_hierarchy.hpp"
#include "animation/import/assimp/material_conversion.hpp"
#include "animation/import/assimp/mesh_instances.hpp"
#include "animation/import/assimp/scene_file.hpp"
#include "animation/import/assimp/scene_nodes.hpp"
#include "core/files.hpp"
#include "core/letter_case.hpp"

namespace lutka::animation::rig_import {
namespace {

template <class T>
std::optional<T> metadataValue(const aiMetadata* metadata, const char* key) {
    T value{};
    if (metadata == nullptr || !metadata->Get(key, value)) return std::nullopt;
    return value;
}

std::optional<double> fbxUnit(const aiMetadata* metadata) {
    const auto asDouble = metadataValue<double>(metadata, "UnitScaleFactor");
    const auto asFloat = metadataValue<float>(metadata, "UnitScaleFactor");
    const std::optional<double> centimetres = asDouble  ? asDouble
                                              : asFloat ? std::optional<double>(*asFloat)
                                                        : asDouble;
    if (!centimetres || !std::isfinite(*centimetres) || !(*centimetres > 0.0)) return std::nullopt;
    return 0.01 * *centimetres;
}

std::optional<UpAxis> fbxUp(const aiMetadata* metadata) {
    const auto axis = metadataValue<std::int32_t>(metadata, "UpAxis");
    const auto sign = metadataValue<std::int32_t>(metadata, "UpAxisSign");
    if (!axis || *axis < 0 || *axis > 2) return std::nullopt;
    return static_cast<UpAxis>(2 * *axis + (sign.value_or(1) >= 0 ? 0 : 1));
}

SourceConvention conventionOf(const aiScene& scene, const std::filesystem::path& file) {
    SourceConvention convention;
    const std::string extension = lowerCased(file.extension().string());
    if (extension == ".dae") {  // Assimp converts both.
        convention.metresPerUnit = 1.0;
        convention.unitSource = "Collada unit";
        convention.up = UpAxis::positiveY;
        convention.upSource = "Collada up_axis";
        return convention;
    }
    if (extension == ".pmx") {
        convention.metresPerUnit = 0.08;  // a figure of 20 units is 1.6 m tall; MMD Tools imports by it, too
        convention.unitSource = "MikuMikuDance's unit";
        convention.up = UpAxis::positiveY;
        convention.upSource = "MikuMikuDance";
        return convention;
    }
    convention.metresPerUnit = fbxUnit(scene.mMetaData);
    convention.unitSource = "FBX UnitScaleFactor";
    convention.up = fbxUp(scene.mMetaData);
    convention.upSource = "FBX UpAxis";
    return convention;
}

// What Assimp leaves out of a Collada document: who wrote it, the names of nodes, which it calls by their ids, and of
// clips. Tells what is left out.
void completeByDocument(const std::filesystem::path& file, const LeftOut& leftOut, SourceScene& out) {
    for (SourceNode& node : out.nodes) {
        if (const auto own = leftOut.nodeNames.find(node.name); own != leftOut.nodeNames.end()) node.name = own->second;
    }
    out.warnings.insert(out.warnings.end(), leftOut.warnings.begin(), leftOut.warnings.end());
    if (lowerCased(file.extension().string()) != ".dae") return;
    const Result<std::vector<unsigned char>> bytes = readFile(file);
    if (!bytes) return;
    const std::string text =
        decodedCollada({reinterpret_cast<const char*>(bytes.value().data()), bytes.value().size()});
    const auto tellsOfAnimations = [](const std::string& warning) {
        return warning.find("animations") != std::string::npos;
    };
    const bool told = std::any_of(leftOut.warnings.begin(), leftOut.warnings.end(), tellsOfAnimations);
    if (!told && out.clips.empty() && text.find("<channel ") != std::string::npos)
        out.warnings.emplace_back("left out: animations, for they move nothing that stands in the scene itself");
    const ColladaDocument document(text);
    if (holdsMorphs(document))
        out.warnings.emplace_back("left out: morph targets, which the file has on from the start");
    if (!out.clips.empty() && holdsOtherCurves(document))
        out.warnings.emplace_back("curves of the kinds CARDINAL and BSPLINE play straight from key to key");
    if (!out.clips.empty()) settleColladaClips(document, out);
    completeBindShapes(document, out);
    const auto names = colladaNodeNames(text);
    std::set<std::string> taken;
    for (const SourceNode& node : out.nodes)
        taken.insert(node.name);
    for (SourceNode& node : out.nodes) {
        const auto found = names.find(node.name);
        if (found != names.end() && taken.count(found->second) == 0) node.name = found->second;
    }
}

}  // namespace

Result<SourceScene> readWithAssimp(const std::filesystem::path& file, const ImportOptions& options) {
    const ModelFolder folder(file, options.allowOutside);
    const Result<SceneFile> opened = readScene(file, folder);
    if (!opened) return opened.error();
    const aiScene& scene = *opened.value().scene;
    SourceScene out;
    out.format = metadataValue<aiString>(scene.mMetaData, AI_METADATA_SOURCE_FORMAT).value_or(aiString("")).C_Str();
    Result<SceneNodes> read = readNodes(scene, file.string(), out);
    if (!read) return read.error();
    const SceneNodes& nodes = read.value();
    out.convention = conventionOf(scene, file);
    addMeshes(scene, nodes, out);
    addClips(scene, nodes, out);
    convertMaterials(scene, folder, options.loadTextures, out);
    completeByDocument(file, *opened.value().leftOut, out);
    if (const std::set<std::string>& refused = opened.value().leftOut->outside; !refused.empty()) {
        out.warnings.push_back(fmt::format(
            "{} files that the model names lie outside of its folder and were left out: {}; --allow-outside takes them",
            refused.size(), fmt::join(refused, ", ")));
    }
    restoreFlatHierarchy(out);
    return out;
}

}  // namespace lutka::animation::rig_import
