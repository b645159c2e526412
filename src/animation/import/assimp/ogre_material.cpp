#include "animation/import/assimp/ogre_material.hpp"

#include <algorithm>
#include <array>
#include <sstream>

namespace lutka::animation::rig_import {
namespace {

// The properties whose values Assimp reads as numbers, and how many.
struct Numbered {
    std::string_view name;
    int numbers;
};
constexpr std::array kNumbered = {Numbered{"ambient", 3}, Numbered{"diffuse", 3}, Numbered{"specular", 3},
                                  Numbered{"emissive", 3}, Numbered{"tex_coord_set", 1}};

// Blocks within one another that Assimp looks for: material, technique, pass, texture unit, and one more for each that
// the text closes too early.
constexpr int kBlocks = 8;

bool endsReading(const std::string& line) {
    std::istringstream words(line);
    std::string name;
    words >> name;
    const auto found =
        std::find_if(kNumbered.begin(), kNumbered.end(), [&](const Numbered& given) { return given.name == name; });
    if (found == kNumbered.end()) return false;
    for (int i = 0; i < found->numbers; ++i) {
        float number = 0.0F;
        if (!(words >> number)) return true;
    }
    return false;
}

}  // namespace

std::string tidyOgreMaterial(std::string_view text) {
    std::string out;
    std::istringstream lines{std::string(text)};
    auto open = static_cast<std::ptrdiff_t>(kBlocks);
    for (std::string line; std::getline(lines, line);) {
        if (endsReading(line)) continue;
        open += std::count(line.begin(), line.end(), '{') - std::count(line.begin(), line.end(), '}');
        out += line + '\n';
    }
    for (; open > 0; --open)
        out += "}\n";
    return out;
}

}  // namespace lutka::animation::rig_import
