#include "animation/import/assimp/material_conversion.hpp"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "animation/import/srgb.hpp"
#include "animation/import/texture_loader.hpp"

namespace lutka::animation::rig_import {
namespace {

constexpr unsigned kMaxTexels = 65536;  // of a side

float clampUnit(float value, float otherwise) {
    return std::isfinite(value) ? std::clamp(value, 0.0F, 1.0F) : otherwise;
}

vec4 clampUnit(const aiColor4D& c) {
    return {clampUnit(c.r, 0.8F), clampUnit(c.g, 0.8F), clampUnit(c.b, 0.8F), clampUnit(c.a, 1.0F)};
}

// Roughness of the microfacet distribution that falls off like a Phong lobe of that exponent (Walter et al. 2007, with
// roughness the square root of its alpha).
float roughnessFromShininess(float shininess) {
    return std::clamp(std::pow(2.0F / (std::max(shininess, 0.0F) + 2.0F), 0.25F), 0.05F, 1.0F);
}

void readPbrFactors(const aiMaterial& source, Material& material) {
    aiColor4D color(1, 1, 1, 1);
    source.Get(AI_MATKEY_BASE_COLOR, color);
    material.baseColor = clampUnit(color);
    float value = 1.0F;
    if (source.Get(AI_MATKEY_METALLIC_FACTOR, value) == aiReturn_SUCCESS) material.metallic = clampUnit(value, 0.0F);
    if (source.Get(AI_MATKEY_ROUGHNESS_FACTOR, value) == aiReturn_SUCCESS) material.roughness = clampUnit(value, 0.7F);
    aiString mode;
    if (source.Get(AI_MATKEY_GLTF_ALPHAMODE, mode) == aiReturn_SUCCESS) {
        if (mode == aiString("MASK")) material.alphaMode = Material::AlphaMode::mask;
        if (mode == aiString("BLEND")) material.alphaMode = Material::AlphaMode::blend;
    }
    if (source.Get(AI_MATKEY_GLTF_ALPHACUTOFF, value) == aiReturn_SUCCESS)
        material.alphaCutoff = clampUnit(value, 0.5F);
}

void readPhongFactors(const aiMaterial& source, Material& material) {
    aiColor4D color(0.8F, 0.8F, 0.8F, 1.0F);
    source.Get(AI_MATKEY_COLOR_DIFFUSE, color);
    material.baseColor = clampUnit(color);
    for (int i = 0; i < 3; ++i)
        material.baseColor[i] = linearFromSrgb(material.baseColor[i]);
    float value = 0.0F;
    if (source.Get(AI_MATKEY_SHININESS, value) == aiReturn_SUCCESS && value > 0.0F)
        material.roughness = roughnessFromShininess(value);
    // Exporters disagree about which end of FBX's transparency is opaque: a material that would be invisible is not.
    material.baseColor.a = 1.0F;
    if (source.Get(AI_MATKEY_OPACITY, value) == aiReturn_SUCCESS && value > 0.01F && value < 0.99F) {
        material.baseColor.a = value;
        material.alphaMode = Material::AlphaMode::blend;
    }
}

bool isPbr(const aiMaterial& source) {
    aiColor4D color;
    float value = 0.0F;
    return source.Get(AI_MATKEY_BASE_COLOR, color) == aiReturn_SUCCESS ||
           source.Get(AI_MATKEY_METALLIC_FACTOR, value) == aiReturn_SUCCESS;
}

// The first texture of the first kind that the material has.
int textureOf(const aiMaterial& source, std::initializer_list<aiTextureType> kinds, TextureLoader& loader) {
    for (const aiTextureType kind : kinds) {
        aiString path;
        if (source.GetTexture(kind, 0, &path) == aiReturn_SUCCESS && path.length > 0) return loader.load(path.C_Str());
    }
    return Material::kNoTexture;
}

bool names(const aiMaterial& source, aiTextureType kind) {
    aiString path;
    return source.GetTexture(kind, 0, &path) == aiReturn_SUCCESS && path.length > 0;
}

void readTextures(const aiMaterial& source, bool pbr, TextureLoader& loader, Material& material) {
    material.baseColorTexture = textureOf(source, {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}, loader);
    material.normalTexture = textureOf(source, {aiTextureType_NORMALS, aiTextureType_NORMAL_CAMERA}, loader);
    material.emissiveTexture = textureOf(source, {aiTextureType_EMISSIVE, aiTextureType_EMISSION_COLOR}, loader);
    if (!pbr) {
        // In the Phong world a texture replaces the colour instead of tinting it.
        if (material.baseColorTexture != Material::kNoTexture) material.baseColor = {1, 1, 1, material.baseColor.a};
        // A texture that is not there leaves the colour that it would have replaced, often black: neutral is visible.
        else if (names(source, aiTextureType_DIFFUSE)) {
            const vec4 neutral = Material{}.baseColor;
            material.baseColor = {neutral.r, neutral.g, neutral.b, material.baseColor.a};
        }
        return;
    }
    material.metallicRoughnessTexture = textureOf(source, {aiTextureType_UNKNOWN}, loader);
    material.occlusionTexture = textureOf(source, {aiTextureType_LIGHTMAP, aiTextureType_AMBIENT_OCCLUSION}, loader);
}

Material convert(const aiMaterial& source, TextureLoader& loader) {
    Material material;
    aiString name;
    if (source.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS) material.name = name.C_Str();
    const bool pbr = isPbr(source);
    pbr ? readPbrFactors(source, material) : readPhongFactors(source, material);
    aiColor4D emissive(0, 0, 0, 1);
    if (source.Get(AI_MATKEY_COLOR_EMISSIVE, emissive) == aiReturn_SUCCESS)
        material.emissive = vec3(clampUnit(emissive.r, 0), clampUnit(emissive.g, 0), clampUnit(emissive.b, 0));
    int twoSided = 0;
    if (source.Get(AI_MATKEY_TWOSIDED, twoSided) == aiReturn_SUCCESS) material.doubleSided = twoSided != 0;
    readTextures(source, pbr, loader, material);
    return material;
}

// A picture in the scene: a compressed file (height 0, width its bytes) or plain BGRA texels.
std::optional<PictureDecoder::Decoded> decodeEmbedded(const aiScene& scene, const std::string& path,
                                                      PictureDecoder& decoder) {
    const aiTexture* source = scene.GetEmbeddedTexture(path.c_str());
    if (source == nullptr) return std::nullopt;
    using Outcome = PictureDecoder::Outcome;
    PictureDecoder::Decoded picture;
    if (source->mHeight == 0) {
        picture = decoder.decode({reinterpret_cast<const std::uint8_t*>(source->pcData), source->mWidth}, path);
    } else if (source->mWidth > kMaxTexels || source->mHeight > kMaxTexels ||
               !decoder.admits(static_cast<int>(source->mWidth), static_cast<int>(source->mHeight), path)) {
        picture.outcome = Outcome::tooLarge;
    } else {
        Texture texture;
        texture.width = static_cast<int>(source->mWidth);
        texture.height = static_cast<int>(source->mHeight);
        const std::size_t count = static_cast<std::size_t>(source->mWidth) * source->mHeight;
        for (std::size_t i = 0; i < count; ++i) {
            const aiTexel& texel = source->pcData[i];
            texture.rgba.insert(texture.rgba.end(), {texel.r, texel.g, texel.b, texel.a});
        }
        picture = {Outcome::decoded, decoder.fitted(std::move(texture), path)};
    }
    picture.texture.name = source->mFilename.length > 0 ? source->mFilename.C_Str() : path;
    return picture;
}

}  // namespace

void convertMaterials(const aiScene& scene, const ModelFolder& folder, bool loadTextures, SourceScene& out) {
    TextureLoader loader(
        [&scene](const std::string& path, PictureDecoder& decoder) { return decodeEmbedded(scene, path, decoder); },
        folder, loadTextures);
    for (unsigned i = 0; i < scene.mNumMaterials; ++i)
        out.materials.push_back(convert(*scene.mMaterials[i], loader));
    for (std::string& sentence : loader.sentences())
        out.warnings.push_back(std::move(sentence));
    out.textures = loader.takeTextures();
}

}  // namespace lutka::animation::rig_import
