#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "animation/clip.hpp"
#include "animation/skeleton.hpp"

namespace lutka::animation {

inline constexpr int kMaxInfluences = 4;

/// A skinned triangle mesh in its bind pose, in model space (metres, Y up). Vertex arrays have one size, or are empty
/// where said so.
struct SkinnedMesh {
    std::string name;
    std::vector<vec3> positions;
    std::vector<vec3> normals;   ///< Unit length; made from the triangles when the file has none.
    std::vector<vec4> tangents;  ///< xyz unit, w = ±1 the sign of the bitangent; empty when there are no UVs.
    std::vector<vec2> uvs;       ///< glTF convention: (0, 0) is the picture's upper left; may be empty.
    std::vector<vec4> colors;    ///< Linear RGBA in [0, 1], times the material's base colour; empty: white.
    std::vector<std::array<std::uint16_t, kMaxInfluences>> joints;  ///< Indices into the skeleton.
    std::vector<std::array<float, kMaxInfluences>> weights;         ///< >= 0, sum 1, strongest first.
    std::vector<std::uint32_t> indices;                             ///< Three a triangle, counter-clockwise outside.
    int material = 0;                                               ///< Index into Character::materials.
    bool rigid = false;  ///< True for a mesh without a skin that hangs on a node (all weights 1).
    /// The vertices in the order in which the file has them: importing brings those with the same joints together.
    /// Empty where they are in that order.
    std::vector<std::uint32_t> fileOrder;
};

/// Pixels of a texture, RGBA, 8 bits each, row after row from the top.
struct Texture {
    std::string name;  ///< File name or the embedded texture's name.
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;
};

/// glTF's metallic-roughness material. Texture members are indices into Character::textures or kNoTexture.
struct Material {
    static constexpr int kNoTexture = -1;
    enum class AlphaMode { opaque, mask, blend };

    std::string name;
    vec4 baseColor{0.8F, 0.8F, 0.8F, 1.0F};  ///< Linear.
    float metallic = 0.0F;                   ///< [0, 1]
    float roughness = 0.7F;                  ///< [0, 1]
    vec3 emissive{0, 0, 0};                  ///< Linear.
    AlphaMode alphaMode = AlphaMode::opaque;
    float alphaCutoff = 0.5F;
    bool doubleSided = false;
    int baseColorTexture = kNoTexture;          ///< sRGB.
    int metallicRoughnessTexture = kNoTexture;  ///< Linear: G roughness, B metallic.
    int normalTexture = kNoTexture;             ///< Linear, tangent space, +Y up.
    int occlusionTexture = kNoTexture;          ///< Linear: R.
    int emissiveTexture = kNoTexture;           ///< sRGB.
};

/// What import settled about units and axes, for `lutka inspect`.
struct UnitInfo {
    float metresPerFileUnit = 1.0F;  ///< What positions were multiplied by.
    std::string unitSource;          ///< "glTF", "FBX UnitScaleFactor", "height of the figure", "--scale" …
    std::string upAxis = "+Y";       ///< The file's up axis: ±X, ±Y or ±Z.
    std::string upSource;            ///< Like unitSource.
};

/// One of the characters that a file holds.
struct FigureInfo {
    std::string name;          ///< Of the node that holds its joints.
    std::vector<int> joints;   ///< Of the skeleton, ascending: those that its skins name.
    std::size_t vertices = 0;  ///< That its skins move, as the file has them.
};

/// A rigged model as loaded: everything in model space, metres, Y up, rigid joint frames.
struct Character {
    std::string name;            ///< The file's stem.
    std::filesystem::path file;  ///< Where it came from; empty for one made in memory.
    Skeleton skeleton;
    std::vector<SkinnedMesh> meshes;
    std::vector<Clip> clips;
    std::vector<Material> materials;  ///< At least one when there are meshes.
    std::vector<Texture> textures;
    UnitInfo units;
    std::vector<FigureInfo>
        figures;     ///< Of the file, in its order; the skeleton holds the joints of all. Empty: no skin.
    int figure = 0;  ///< Index into `figures`: whose meshes these are.
    std::vector<std::string> warnings;  ///< What was repaired, dropped or guessed, a sentence each.

    /// The file's own humanoid map, when it has one (VRM's block, or kRoleExtra as we write it): VRM role name → joint
    /// index.
    std::map<std::string, int> vrmHumanoid;
};

}  // namespace lutka::animation
