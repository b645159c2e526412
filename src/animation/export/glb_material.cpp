#include <stb/stb_image_write.h>

#include <algorithm>

#include "animation/export/glb_parts.hpp"

namespace lutka::animation::glb {
namespace {

void append(void* context, void* data, int size) {
    auto& bytes = *static_cast<std::vector<unsigned char>*>(context);
    const auto* first = static_cast<const unsigned char*>(data);
    bytes.insert(bytes.end(), first, first + size);
}

void addTexture(const Texture& texture, BufferBuilder& buffer, tinygltf::Model& model) {
    std::vector<unsigned char> png;
    stbi_write_png_to_func(append, &png, texture.width, texture.height, 4, texture.rgba.data(), 4 * texture.width);
    tinygltf::Image image;
    image.name = utf8(texture.name);
    image.mimeType = "image/png";
    image.bufferView = buffer.addBytes(png.data(), png.size(), 0);
    model.images.push_back(std::move(image));
    tinygltf::Texture out;
    out.source = static_cast<int>(model.images.size()) - 1;
    out.sampler = 0;
    model.textures.push_back(std::move(out));
}

const char* nameOf(Material::AlphaMode mode) {
    switch (mode) {
        case Material::AlphaMode::opaque:
            return "OPAQUE";
        case Material::AlphaMode::mask:
            return "MASK";
        case Material::AlphaMode::blend:
            return "BLEND";
    }
    return "OPAQUE";
}

constexpr const char* kEmissiveStrength = "KHR_materials_emissive_strength";

tinygltf::Material convert(const Material& material, int firstTexture) {
    const auto placed = [&](int texture) { return texture < 0 ? texture : firstTexture + texture; };
    tinygltf::Material out;
    out.name = utf8(material.name);
    tinygltf::PbrMetallicRoughness& pbr = out.pbrMetallicRoughness;
    const vec4& color = material.baseColor;
    pbr.baseColorFactor = {color.r, color.g, color.b, color.a};
    pbr.metallicFactor = material.metallic;
    pbr.roughnessFactor = material.roughness;
    pbr.baseColorTexture.index = placed(material.baseColorTexture);
    pbr.metallicRoughnessTexture.index = placed(material.metallicRoughnessTexture);
    out.normalTexture.index = placed(material.normalTexture);
    out.occlusionTexture.index = placed(material.occlusionTexture);
    out.emissiveTexture.index = placed(material.emissiveTexture);
    // A factor is at most 1: what shines more says how much more.
    const float strength = std::max({1.0F, material.emissive.r, material.emissive.g, material.emissive.b});
    const vec3 emissive = material.emissive / strength;
    out.emissiveFactor = {emissive.r, emissive.g, emissive.b};
    if (strength > 1.0F) {
        out.extensions[kEmissiveStrength] = tinygltf::Value(
            tinygltf::Value::Object{{"emissiveStrength", tinygltf::Value(static_cast<double>(strength))}});
    }
    out.alphaMode = nameOf(material.alphaMode);
    if (material.alphaMode == Material::AlphaMode::mask) out.alphaCutoff = material.alphaCutoff;
    out.doubleSided = material.doubleSided;
    return out;
}

}  // namespace

void addMaterials(const Character& character, BufferBuilder& buffer, tinygltf::Model& model) {
    const int firstTexture = static_cast<int>(model.textures.size());
    if (!character.textures.empty() && model.samplers.empty()) {
        tinygltf::Sampler sampler;
        sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
        sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
        model.samplers.push_back(std::move(sampler));
    }
    for (const Texture& texture : character.textures)
        addTexture(texture, buffer, model);
    for (const Material& material : character.materials) {
        model.materials.push_back(convert(material, firstTexture));
        auto& used = model.extensionsUsed;
        if (!model.materials.back().extensions.empty() &&
            std::find(used.begin(), used.end(), kEmissiveStrength) == used.end())
            used.emplace_back(kEmissiveStrength);
    }
}

}  // namespace lutka::animation::glb
