#include "animation/import/model_ending.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>

namespace lutka::animation {
namespace {

// Of what Assimp reads those that hold skeletons.
constexpr std::array<std::string_view, 18> kModelEndings = {".glb", ".gltf", ".vrm",     ".fbx", ".dae", ".bvh",
                                                            ".x",   ".b3d",  ".md5mesh", ".md2", ".md3", ".mdl",
                                                            ".smd", ".ms3d", ".iqm",     ".cob", ".lwo", ".blend"};

}  // namespace

bool hasModelEnding(const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return std::find(kModelEndings.begin(), kModelEndings.end(), ending) != kModelEndings.end();
}

}  // namespace lutka::animation
