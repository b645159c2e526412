#include "animation/import/assimp/scene_file.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

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

constexpr const char* kUsualMend = "check that the file is whole, or export it again as glTF 2.0 or FBX";

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

// What Assimp says that means nothing to whoever has the file, in plain words.
struct PlainWords {
    std::string_view said;
    std::string_view message;  // "{}" stands for the version that follows what is said
    const char* mend;          // null: the usual one
};

constexpr std::array kPlainWords = {
    PlainWords{"No suitable reader found", "is of no format that is read", "export it as glTF 2.0 or FBX"},
    PlainWords{"File came out empty", "holds no scene with meshes or joints", "export it with its scene"},
    PlainWords{"No meshes remaining", "holds points and lines alone, no triangles", "export it with its meshes"},
    PlainWords{"Unknown reference format", "links to other files, and links between Collada files are not followed",
               "export all of it into one file"},
    PlainWords{"malformed XML", "its XML is broken or cut off", nullptr},
    PlainWords{"XML parse error", "its XML is broken or cut off", nullptr},
    PlainWords{"Invalid data index", "its polygons name values that are not there", nullptr},
    PlainWords{"Unsupported vertex referencing scheme", "its polygons name the vertices of another mesh", nullptr},
    PlainWords{"model from an MDL sequence file", "holds motions of a Half-Life model without the model",
               "take the model's own .mdl file"},
    PlainWords{"HL2 MDLs are not implemented", "is a model of Half-Life 2 (Source), which is not read",
               "decompile it (Crowbar) and export glTF 2.0 or FBX from Blender"},
    PlainWords{"[MeshSerializer_v", "is an Ogre mesh of version {}; 1.8 is read",
               "run OgreMeshUpgrader -V 1.8 on it, or export it again as glTF 2.0 or FBX"},
    PlainWords{"[Serializer_v", "its skeleton is an Ogre one of version {}; 1.10 and 1.80 are read",
               "run OgreMeshUpgrader -V 1.8 on it, or export it again as glTF 2.0 or FBX"},
    PlainWords{"Invalid Ogre Mesh file header", "is no Ogre mesh, though its name says so", nullptr},
    PlainWords{" does not hold (", "is damaged, or holds what the reader of its format does not know", nullptr},
};

std::optional<Error> inPlainWords(const fs::path& file, const std::string& why) {
    const auto found = std::find_if(kPlainWords.begin(), kPlainWords.end(),
                                    [&](const PlainWords& words) { return why.find(words.said) != std::string::npos; });
    if (found == kPlainWords.end()) return std::nullopt;
    std::string message(found->message);
    if (const std::size_t place = message.find("{}"); place != std::string::npos) {
        const std::string rest = why.substr(why.find(found->said) + found->said.size());
        message.replace(place, 2, rest.substr(0, rest.find(']')));
    }
    return unreadable(file, message, found->mend == nullptr ? kUsualMend : found->mend);
}

// Half-Life keeps pictures of a model in a file of its own, which Assimp reads as a model without joints.
bool isPartOfHalfLifeModel(const aiScene& scene) {
    return scene.mNumMeshes == 0 && scene.mRootNode->mName == aiString("<MDL_root>") &&
           scene.mRootNode->FindNode("<MDL_bones>") == nullptr;
}

// A part of the model in a file of its own that is not there is not a fault of the file that names it.
std::string mendOf(const std::string& why, const LeftOut& leftOut) {
    for (const std::string& name : leftOut.absent) {
        const std::string part = fs::path(name).filename().string();
        if (why.find(part) != std::string::npos)
            return fmt::format("put {} beside the model, it is a part of it", part);
    }
    return kUsualMend;
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
    if (out.scene == nullptr && out.leftOut->absent.empty()) {
        if (std::optional<Error> plain = inPlainWords(file, why)) return *std::move(plain);
    }
    if (out.scene == nullptr)
        return unreadable(file, why.empty() ? "can't be read as a model" : why, mendOf(why, *out.leftOut));
    if (out.scene->mRootNode == nullptr) return unreadable(file, "holds no scene");
    if (isPartOfHalfLifeModel(*out.scene)) {
        return unreadable(file, "holds the pictures of a Half-Life model without the model",
                          "take the model's own .mdl file, whose name has no T at its end");
    }
    if (std::optional<Error> error = findAbsurdCount(*out.scene, file)) return *std::move(error);
    return out;
}

}  // namespace lutka::animation::rig_import
