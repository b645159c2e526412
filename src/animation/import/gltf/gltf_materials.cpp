#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "animation/import/gltf/gltf_parts.hpp"
#include "animation/import/texture_loader.hpp"

namespace lutka::animation::rig_import::gltf {
namespace {

using nlohmann::json;

// What the loader calls a picture that is in the file itself; no path begins so.
constexpr const char* kEmbedded = "\x01picture ";

vec4 colorOf(const json& object, const char* key, std::size_t count, const vec4& otherwise) {
    const std::optional<std::vector<double>> numbers = numbersOf(object, key, count);
    vec4 color = otherwise;
    for (std::size_t i = 0; numbers && i < count; ++i)
        color[static_cast<int>(i)] = static_cast<float>(std::clamp((*numbers)[i], 0.0, 1.0));
    return color;
}

float fractionOf(const json& object, const char* key, double otherwise) {
    return static_cast<float>(std::clamp(numberOf(object, key, otherwise), 0.0, 1.0));
}

// Offset, rotation and scale of KHR_texture_transform, over homogeneous UVs.
mat3 transformOf(const json& block) {
    const auto offset = numbersOf(block, "offset", 2).value_or(std::vector<double>{0, 0});
    const auto scale = numbersOf(block, "scale", 2).value_or(std::vector<double>{1, 1});
    const double angle = numberOf(block, "rotation", 0.0);
    const auto c = static_cast<float>(std::cos(angle));
    const auto s = static_cast<float>(std::sin(angle));
    const mat3 translation(vec3(1, 0, 0), vec3(0, 1, 0),
                           vec3(static_cast<float>(offset[0]), static_cast<float>(offset[1]), 1));
    const mat3 rotation(vec3(c, -s, 0), vec3(s, c, 0), vec3(0, 0, 1));
    const mat3 scaling(vec3(static_cast<float>(scale[0]), 0, 0), vec3(0, static_cast<float>(scale[1]), 0),
                       vec3(0, 0, 1));
    return translation * rotation * scaling;
}

UvUse useOf(const json& texture) {
    UvUse use;
    use.set = static_cast<int>(std::min<std::size_t>(sizeOf(texture, "texCoord", 0), 7));
    if (const json* block = extensionOf(texture, "KHR_texture_transform")) {
        use.transform = transformOf(*block);
        use.set = static_cast<int>(std::min<std::size_t>(sizeOf(*block, "texCoord", use.set), 7));
    }
    return use;
}

// Whether a picture is repeated along both of its sides, which is what pictures are unless their sampler says else.
bool repeats(const GltfFile& file, const json& reference) {
    constexpr std::size_t kRepeat = 10497;
    const std::optional<int> texture = indexOf(reference, "index", file.count("textures"));
    if (!texture) return true;
    const std::optional<int> index = indexOf(file.element("textures", *texture), "sampler", file.count("samplers"));
    if (!index) return true;
    const json& sampler = file.element("samplers", *index);
    return sizeOf(sampler, "wrapS", kRepeat) == kRepeat && sizeOf(sampler, "wrapT", kRepeat) == kRepeat;
}

// The texture references of a material, the base colour's first.
std::vector<const json*> texturesOf(const json& material) {
    std::vector<const json*> found;
    const auto add = [&](const json* object, const char* key) {
        const json* texture = object == nullptr ? nullptr : member(*object, key);
        if (texture != nullptr) found.push_back(texture);
    };
    const json* pbr = member(material, "pbrMetallicRoughness");
    const json* gloss = extensionOf(material, "KHR_materials_pbrSpecularGlossiness");
    add(gloss, "diffuseTexture");
    add(pbr, "baseColorTexture");
    add(pbr, "metallicRoughnessTexture");
    for (const char* key : {"normalTexture", "occlusionTexture", "emissiveTexture"})
        add(&material, key);
    return found;
}

class MaterialReader {
  public:
    MaterialReader(GltfFile& file, TextureLoader& loader) : file_(file), loader_(loader) {}

    Material read(const json& source) {
        Material material;
        material.name = textOf(source, "name");
        const json* gloss = extensionOf(source, "KHR_materials_pbrSpecularGlossiness");
        gloss != nullptr ? readGlossiness(*gloss, material) : readMetallic(source, material);
        const vec4 emissive = colorOf(source, "emissiveFactor", 3, vec4(0, 0, 0, 1));
        material.emissive = vec3(emissive);
        if (const json* block = extensionOf(source, "KHR_materials_emissive_strength"))
            material.emissive *= static_cast<float>(std::clamp(numberOf(*block, "emissiveStrength", 1.0), 0.0, 100.0));
        const std::string mode = textOf(source, "alphaMode");
        if (mode == "MASK") material.alphaMode = Material::AlphaMode::mask;
        if (mode == "BLEND") material.alphaMode = Material::AlphaMode::blend;
        material.alphaCutoff = fractionOf(source, "alphaCutoff", 0.5);
        material.doubleSided = truthOf(source, "doubleSided", false);
        material.normalTexture = texture(source, "normalTexture");
        material.occlusionTexture = texture(source, "occlusionTexture");
        material.emissiveTexture = texture(source, "emissiveTexture");
        // Without the picture that it is a factor of, everything would shine.
        const bool pictured = member(source, "emissiveTexture") != nullptr;
        if (pictured && material.emissiveTexture == Material::kNoTexture) material.emissive = vec3(0);
        tellMixedUvs(source);
        return material;
    }

  private:
    void readMetallic(const json& source, Material& material) {
        static const json kNone = json::object();
        const json* block = member(source, "pbrMetallicRoughness");
        const json& pbr = block == nullptr ? kNone : *block;
        material.baseColor = colorOf(pbr, "baseColorFactor", 4, vec4(1.0F));
        material.metallic = fractionOf(pbr, "metallicFactor", 1.0);
        material.roughness = fractionOf(pbr, "roughnessFactor", 1.0);
        material.baseColorTexture = texture(pbr, "baseColorTexture");
        material.metallicRoughnessTexture = texture(pbr, "metallicRoughnessTexture");
    }

    // A dielectric reflects 4 %; what the specular colour has beyond is metal, whose base colour it is. By the
    // reflected energies as in Khronos' conversion of the extension.
    void readGlossiness(const json& gloss, Material& material) {
        constexpr float kDielectric = 0.04F;
        const vec4 diffuse = colorOf(gloss, "diffuseFactor", 4, vec4(1.0F));
        const vec3 specular(colorOf(gloss, "specularFactor", 3, vec4(1.0F)));
        const float strongest = std::max({specular.r, specular.g, specular.b});
        material.baseColorTexture = texture(gloss, "diffuseTexture");
        // With a picture in its place the factor of specular says little: most exporters leave it at white.
        const bool pictured = member(gloss, "specularGlossinessTexture") != nullptr;
        material.metallic = pictured ? 0.0F : std::clamp((strongest - kDielectric) / (1.0F - kDielectric), 0.0F, 1.0F);
        const bool defaulted = member(gloss, "specularFactor") == nullptr;
        if (defaulted || strongest < 0.3F) material.metallic = 0.0F;
        material.baseColor = vec4(glm::mix(vec3(diffuse), specular, material.metallic), diffuse.a);
        material.roughness = 1.0F - fractionOf(gloss, "glossinessFactor", 1.0);
        if (pictured) {
            material.roughness = std::max(material.roughness, 0.5F);
            file_.leaveOut("specular-glossiness pictures (their materials are dull instead)");
        }
    }

    int texture(const json& object, const char* key) {
        const json* reference = member(object, key);
        if (reference == nullptr) return Material::kNoTexture;
        const std::optional<int> index = indexOf(*reference, "index", file_.count("textures"));
        if (!index) return Material::kNoTexture;
        const json& source = file_.element("textures", *index);
        const std::optional<int> image = indexOf(source, "source", file_.count("images"));
        if (!image) {
            file_.leaveOut("pictures that are stored in another format than PNG or JPEG (WebP, KTX2 …)");
            return Material::kNoTexture;
        }
        const json& picture = file_.element("images", *image);
        const std::string uri = textOf(picture, "uri");
        const bool inside = uri.empty() || isDataUri(uri);
        return loader_.load(inside ? kEmbedded + std::to_string(*image) : uri);
    }

    // A mesh has one set of UVs here: the base colour's.
    void tellMixedUvs(const json& source) {
        const std::vector<const json*> textures = texturesOf(source);
        for (const json* texture : textures) {
            const UvUse use = useOf(*texture);
            const UvUse first = useOf(*textures.front());
            if (use.set != first.set || use.transform != first.transform) {
                file_.leaveOut("UV sets of pictures that differ from the base colour's");
                return;
            }
        }
    }

    GltfFile& file_;
    TextureLoader& loader_;
};

std::optional<PictureDecoder::Decoded> embeddedPicture(GltfFile& file, const std::string& key,
                                                       PictureDecoder& decoder) {
    if (!key.starts_with(kEmbedded)) return std::nullopt;
    const json& image = file.element("images", std::stoi(key.substr(std::string(kEmbedded).size())));
    std::optional<PictureDecoder::Decoded> picture;
    if (const std::optional<int> view = indexOf(image, "bufferView", file.count("bufferViews"))) {
        picture = decoder.decode(file.viewBytes(*view), key);
    } else if (const auto data = decodeDataUri(textOf(image, "uri"))) {
        picture = decoder.decode(*data, key);
    }
    if (picture) picture->texture.name = textOf(image, "name");
    return picture;
}

}  // namespace

UvUse uvUseOf(GltfFile& file, int material) {
    const std::vector<const json*> textures = texturesOf(file.element("materials", material));
    if (textures.empty()) return {};
    UvUse use = useOf(*textures.front());
    use.repeats = repeats(file, *textures.front());
    return use;
}

void addMaterials(GltfFile& file, bool loadTextures, SourceScene& out) {
    TextureLoader loader(
        [&](const std::string& key, PictureDecoder& decoder) { return embeddedPicture(file, key, decoder); },
        file.folder(), loadTextures);
    MaterialReader reader(file, loader);
    for (std::size_t i = 0; i < file.count("materials"); ++i)
        out.materials.push_back(reader.read(file.element("materials", static_cast<int>(i))));
    for (std::string& sentence : loader.sentences()) {
        std::erase(sentence, kEmbedded[0]);
        out.warnings.push_back(std::move(sentence));
    }
    out.textures = loader.takeTextures();
}

}  // namespace lutka::animation::rig_import::gltf
