#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "animation/character.hpp"
#include "animation/import/fbx/objects.hpp"

namespace lutka::animation::rig_import::fbx {

/// A picture that a material uses.
struct PictureSource {
    std::string path;                        ///< As the file writes it; relative where it states that, too.
    std::span<const std::uint8_t> embedded;  ///< The picture's own file, or empty.
};

/// Gives a texture's index, or Material::kNoTexture.
using PictureLoader = std::function<int(const PictureSource&)>;

/// A material and the UV set that its base colour's picture uses (empty: the first).
struct ReadMaterial {
    Material material;
    std::string uvSet;
};

/// Reads Lambert and Phong materials and the physically based ones of Maya (Standard Surface, Arnold, Stingray), 3ds
/// Max (Physical, PBR, glTF) and Blender. Of shaders that it does not know, pictures whose property says base colour,
/// diffuse, albedo or normal are taken. Colours are taken as linear, except those of 3ds Max, which writes sRGB.
class MaterialReader {
  public:
    MaterialReader(const Document& document, const Objects& objects, PictureLoader load);

    [[nodiscard]] ReadMaterial read(int material);
    /// The properties with pictures of materials of which no picture was known, in the order of the alphabet.
    [[nodiscard]] const std::set<std::string>& unread() const { return unread_; }

  private:
    struct Picture {
        int texture = Material::kNoTexture;
        bool named = false;  ///< The material names one, found or not.
        std::string uvSet;
    };

    [[nodiscard]] Picture picture(int material, std::span<const std::string_view> properties);
    [[nodiscard]] std::vector<std::string_view> propertiesWithPictures(int material) const;
    [[nodiscard]] Picture pictureSaying(int material, std::span<const std::string_view> words);
    [[nodiscard]] int loadTexture(int texture);
    void readFactors(const Properties& properties, Material& out) const;
    void readTransparency(const Properties& properties, Material& out) const;
    void readPictures(int material, ReadMaterial& out);
    [[nodiscard]] vec3 color(const glm::dvec3& written) const;

    const Objects& objects_;
    PictureLoader load_;
    std::map<int, int> known_;  // texture object → texture
    std::map<std::string, std::vector<std::uint8_t>> decoded_;
    std::set<std::string> unread_;
    bool linear_ = true;
    bool blender_ = false;
};

}  // namespace lutka::animation::rig_import::fbx
