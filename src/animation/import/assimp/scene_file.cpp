#include "animation/import/assimp/scene_file.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <fmt/format.h>

#include <exception>
#include <stdexcept>
#include <string>

#include "animation/import/assimp/confined_files.hpp"
#include "animation/import/source_limits.hpp"

// Debian builds Assimp with its assertions on; on some damaged files they abort the whole process. They are called
// through the dynamic linker, so this definition takes the place of Assimp's own and throws, which read() catches.
namespace Assimp {
void aiAssertViolation(const char* expression, const char* file, int line);
void aiAssertViolation(const char* expression, const char* file, int line) {
    throw std::runtime_error(fmt::format("the file is damaged: {} does not hold ({}:{})", expression, file, line));
}
}  // namespace Assimp

namespace lutka::animation::rig_import {
namespace {

namespace fs = std::filesystem;

Error unreadable(const fs::path& file, std::string message, std::string mend = "") {
    return {ErrorCode::input, std::move(message), file.string(), std::move(mend)};
}

void configure(Assimp::Importer& importer) {
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    // A file without meshes (BVH) would get a made-up one whose bind matrices mean nothing.
    importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_CAMERAS, false);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_LIGHTS, false);
}

std::optional<Error> findAbsurdCount(const aiScene& scene, const fs::path& file) {
    std::uint64_t vertices = 0;
    for (unsigned i = 0; i < scene.mNumMeshes; ++i)
        vertices += scene.mMeshes[i]->mNumVertices;
    if (scene.mNumMeshes <= kMaxMeshes && vertices <= kMaxVertices) return std::nullopt;
    return unreadable(
        file, fmt::format("{} meshes with {} vertices are more than a character can have", scene.mNumMeshes, vertices),
        "export the character without the rest of the scene");
}

const aiScene* read(Assimp::Importer& importer, const fs::path& file, std::string& why) {
    constexpr unsigned kSteps = aiProcess_Triangulate | aiProcess_GenSmoothNormals | aiProcess_SortByPType;
    try {
        const aiScene* scene = importer.ReadFile(file.string(), kSteps);
        why = importer.GetErrorString();
        return scene;
    } catch (const std::exception& e) {
        why = e.what();
        return nullptr;
    }
}

// A part of the model in a file of its own that is not there is not a fault of the file that names it.
std::string mendOf(const std::string& why, const LeftOut& leftOut) {
    for (const std::string& name : leftOut.absent) {
        const std::string part = fs::path(name).filename().string();
        if (why.find(part) != std::string::npos)
            return fmt::format("put {} beside the model, it is a part of it", part);
    }
    return "check that the file is whole, or export it again as glTF 2.0 or FBX";
}

}  // namespace

Result<SceneFile> readScene(const fs::path& file, const ModelFolder& folder) {
    SceneFile out;
    out.importer = std::make_unique<Assimp::Importer>();
    out.leftOut = std::make_shared<LeftOut>();
    out.importer->SetIOHandler(new ConfinedFiles(file, folder, out.leftOut));  // the importer owns it
    configure(*out.importer);
    std::string why;
    out.scene = read(*out.importer, file, why);
    if (out.scene == nullptr)
        return unreadable(file, why.empty() ? "can't be read as a model" : why, mendOf(why, *out.leftOut));
    if (out.scene->mRootNode == nullptr) return unreadable(file, "holds no scene");
    if (std::optional<Error> error = findAbsurdCount(*out.scene, file)) return *std::move(error);
    return out;
}

}  // namespace lutka::animation::rig_import
