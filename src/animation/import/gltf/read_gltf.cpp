#include "animation/import/gltf/read_gltf.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "animation/import/gltf/gltf_parts.hpp"

namespace lutka::animation::rig_import {
namespace {

SourceScene read(const std::filesystem::path& path, const ImportOptions& options) {
    gltf::GltfFile file(path, options.allowOutside);
    SourceScene scene;
    scene.format = "glTF 2.0";
    scene.convention = {1.0, "glTF", UpAxis::positiveY, "glTF"};
    const gltf::NodeMap nodes = gltf::addNodes(file, scene);
    gltf::addMaterials(file, options.loadTextures, scene);
    gltf::addMeshes(file, nodes, scene);
    gltf::addClips(file, nodes, scene);
    gltf::addVrmHumanoid(file, nodes, scene);
    if (!file.leftOut().empty()) scene.warnings.push_back(fmt::format("left out: {}", fmt::join(file.leftOut(), "; ")));
    return scene;
}

}  // namespace

Result<SourceScene> readGltf(const std::filesystem::path& file, const ImportOptions& options) {
    try {
        return read(file, options);
    } catch (const gltf::Damage& damage) {
        return Error{ErrorCode::input, damage.what, file.string(), damage.mend};
    }
}

}  // namespace lutka::animation::rig_import
