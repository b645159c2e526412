#include "animation/import/model_ending.hpp"
#include "core/letter_case.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace lutka::animation {
namespace {

// Of what Assimp reads those that hold skeletons.
constexpr std::array<std::string_view, 17> kModelEndings = {".glb", ".gltf", ".vrm",     ".fbx", ".dae", ".bvh",
                                                            ".x",   ".b3d",  ".md5mesh", ".md2", ".md3", ".mdl",
                                                            ".smd", ".ms3d", ".iqm",     ".cob", ".lwo"};

}  // namespace

bool hasModelEnding(const std::filesystem::path& file) {
    const std::string ending = lowerCased(file.extension().string());
    return std::find(kModelEndings.begin(), kModelEndings.end(), ending) != kModelEndings.end();
}

}  // namespace lutka::animation
