#include "animation/import/scene_file.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <fmt/format.h>

#include <assimp/DefaultIOSystem.h>
#include <exception>
#include <stdexcept>
#include <string>
#include <system_error>

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

constexpr unsigned kMaxMeshes = 20000;
constexpr std::uint64_t kMaxVertices = 50'000'000;

// Shows the file under an alias with another extension: Assimp takes `.vrm` for an OBJ.
class AliasedFile : public Assimp::DefaultIOSystem {
  public:
    AliasedFile(std::string alias, std::string file) : alias_(std::move(alias)), file_(std::move(file)) {}
    bool Exists(const char* path) const override { return Assimp::DefaultIOSystem::Exists(target(path)); }
    Assimp::IOStream* Open(const char* path, const char* mode) override {
        return Assimp::DefaultIOSystem::Open(target(path), mode);
    }

  private:
    const char* target(const char* path) const { return alias_ == path ? file_.c_str() : path; }
    std::string alias_;
    std::string file_;
};

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

const aiScene* read(Assimp::Importer& importer, const fs::path& file, bool aliasAsGlb, std::string& why) {
    constexpr unsigned kSteps = aiProcess_Triangulate | aiProcess_GenSmoothNormals | aiProcess_SortByPType;
    std::string path = file.string();
    if (aliasAsGlb) {
        const std::string alias = path + ".glb";
        importer.SetIOHandler(new AliasedFile(alias, path));  // the importer owns it
        path = alias;
    }
    try {
        const aiScene* scene = importer.ReadFile(path, kSteps);
        why = importer.GetErrorString();
        return scene;
    } catch (const std::exception& e) {
        why = e.what();
        return nullptr;
    }
}

}  // namespace

Result<SceneFile> readScene(const fs::path& file) {
    std::error_code ignored;
    if (!fs::exists(file, ignored)) return unreadable(file, "there is no such file");
    if (fs::is_directory(file, ignored)) return unreadable(file, "is a folder, not a model");
    if (fs::file_size(file, ignored) == 0) return unreadable(file, "is empty");
    SceneFile out;
    Result<std::optional<GltfDocument>> gltf = readGltfDocument(file);
    if (!gltf) return gltf.error();
    out.gltf = std::move(gltf).value();
    out.importer = std::make_unique<Assimp::Importer>();
    configure(*out.importer);
    std::string why;
    const bool oddName = out.gltf && out.gltf->binary && file.extension() != ".glb";
    out.scene = read(*out.importer, file, oddName, why);
    if (out.scene == nullptr) {
        return unreadable(file, why.empty() ? "can't be read as a model" : why,
                          "check that the file is whole, or export it again as glTF 2.0 or FBX");
    }
    if (out.scene->mRootNode == nullptr) return unreadable(file, "holds no scene");
    if (std::optional<Error> error = findAbsurdCount(*out.scene, file)) return *std::move(error);
    return out;
}

}  // namespace lutka::animation::rig_import
