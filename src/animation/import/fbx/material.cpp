#include "animation/import/fbx/material.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <utility>

#include "animation/import/srgb.hpp"
#include "core/letter_case.hpp"

namespace lutka::animation::rig_import::fbx {
namespace {

using Names = std::initializer_list<std::string_view>;

constexpr std::array<std::string_view, 10> kBaseColor = {"Maya|baseColor",
                                                         "Maya|base_color",
                                                         "Maya|TEX_color_map",
                                                         "3dsMax|Parameters|base_color",
                                                         "3dsMax|Parameters|basecolor",
                                                         "3dsMax|main|baseColor",
                                                         "3dsMax|main|basecolor",
                                                         "base_color",
                                                         "baseColor",
                                                         "base"};
constexpr std::array<std::string_view, 5> kMetallic = {"Maya|metalness", "Maya|metallic", "3dsMax|Parameters|metalness",
                                                       "3dsMax|main|metalness", "metallic"};
constexpr std::array<std::string_view, 6> kRoughness = {"Maya|specularRoughness",      "Maya|roughness",
                                                        "3dsMax|Parameters|roughness", "3dsMax|main|roughness",
                                                        "3dsMax|main|roughnessValue",  "roughness"};
constexpr std::array<std::string_view, 13> kBaseColorPictures = {"Maya|baseColor",
                                                                 "Maya|TEX_color_map",
                                                                 "Maya|TEX_color_map|file",
                                                                 "Maya|base_color",
                                                                 "3dsMax|Parameters|base_color_map",
                                                                 "3dsMax|Parameters|basecolor_map",
                                                                 "3dsMax|main|base_color_map",
                                                                 "3dsMax|main|baseColorMap",
                                                                 "3dsMax|main|baseTexture",
                                                                 "base_color",
                                                                 "DiffuseColor",
                                                                 "Diffuse",
                                                                 "3dsMax|maps|texmap_diffuse"};
constexpr std::array<std::string_view, 9> kNormalPictures = {"NormalMap",
                                                             "Bump",
                                                             "Maya|normalCamera",
                                                             "Maya|TEX_normal_map",
                                                             "Maya|TEX_normal_map|file",
                                                             "3dsMax|Parameters|bump_map",
                                                             "3dsMax|Parameters|norm_map",
                                                             "3dsMax|main|norm_map",
                                                             "3dsMax|main|normalTexture"};
constexpr std::array<std::string_view, 6> kEmissivePictures = {"EmissiveColor",
                                                               "Maya|emissionColor",
                                                               "Maya|TEX_emissive_map",
                                                               "Maya|TEX_emissive_map|file",
                                                               "3dsMax|Parameters|emit_color_map",
                                                               "3dsMax|main|emit_color_map"};

constexpr std::array<std::string_view, 4> kBaseColorWords = {"diffuse", "albedo", "basecolor", "base_color"};
constexpr std::array<std::string_view, 1> kNormalWords = {"normal"};

std::optional<double> firstNumber(const Properties& properties, std::span<const std::string_view> names) {
    for (const std::string_view name : names) {
        if (properties.states(name)) return properties.number(name, 0.0);
    }
    return std::nullopt;
}

std::optional<glm::dvec3> firstColor(const Properties& properties, std::span<const std::string_view> names) {
    for (const std::string_view name : names) {
        if (properties.states(name)) return properties.vector(name, glm::dvec3(0.8));
    }
    return std::nullopt;
}

float unit(double value) {
    return static_cast<float>(std::clamp(value, 0.0, 1.0));
}

// Roughness of the microfacet distribution that falls off like a Phong lobe of that exponent (Walter et al. 2007, with
// roughness the square root of its alpha).
float roughnessFromShininess(double shininess) {
    return static_cast<float>(std::clamp(std::pow(2.0 / (std::max(shininess, 0.0) + 2.0), 0.25), 0.05, 1.0));
}

// What wrote the document: "Blender (stable FBX IO) - …", "FBX SDK … / Maya 2022" and the like.
std::string writerOf(const Document& document) {
    std::string out;
    const Record* header = document.root.child("FBXHeaderExtension");
    for (const Record* at : {document.root.child("Creator"), header ? header->child("Creator") : nullptr}) {
        if (at != nullptr) out += std::string(at->text(0)) + " ";
    }
    if (const Record* info = header ? header->child("SceneInfo") : nullptr)
        out += std::string(Properties(info, nullptr).text("Original|ApplicationName"));
    return out;
}

std::vector<std::uint8_t> decodeBase64(const Record& content) {
    std::vector<std::uint8_t> out;
    std::uint32_t bits = 0;
    int count = 0;
    for (std::size_t i = 0; i < content.values.size(); ++i) {
        for (const char c : content.text(i)) {
            const int digit = c >= 'A' && c <= 'Z'   ? c - 'A'
                              : c >= 'a' && c <= 'z' ? c - 'a' + 26
                              : c >= '0' && c <= '9' ? c - '0' + 52
                              : c == '+'             ? 62
                              : c == '/'             ? 63
                                                     : -1;
            if (digit < 0) continue;
            bits = bits << 6U | static_cast<std::uint32_t>(digit);
            count += 6;
            if (count < 8) continue;
            count -= 8;
            out.push_back(static_cast<std::uint8_t>(bits >> static_cast<unsigned>(count) & 0xFFU));
        }
    }
    return out;
}

std::string_view textOf(const Object& object, std::string_view name) {
    const Record* record = object.record->child(name);
    return record != nullptr ? record->text(0) : std::string_view{};
}

}  // namespace

MaterialReader::MaterialReader(const Document& document, const Objects& objects, PictureLoader load)
    : objects_(objects), load_(std::move(load)) {
    const std::string writer = writerOf(document);
    linear_ = writer.find("3ds") == std::string::npos && writer.find("3DS") == std::string::npos;
    blender_ = writer.find("Blender") != std::string::npos;
    // Content written as text is decoded once, to live as long as this reader.
    for (const Object& object : objects.all()) {
        const Record* content = object.kind == "Video" ? object.record->child("Content") : nullptr;
        if (content != nullptr && !document.binary)
            decoded_[std::string(textOf(object, "RelativeFilename"))] = decodeBase64(*content);
    }
}

vec3 MaterialReader::color(const glm::dvec3& written) const {
    vec3 out;
    for (int i = 0; i < 3; ++i)
        out[i] = linear_ ? unit(written[i]) : linearFromSrgb(static_cast<float>(written[i]));
    return out;
}

ReadMaterial MaterialReader::read(int material) {
    ReadMaterial out;
    const Object& object = objects_[material];
    out.material.name = object.name;
    readFactors(object.properties, out.material);
    readTransparency(object.properties, out.material);
    readPictures(material, out);
    return out;
}

void MaterialReader::readFactors(const Properties& properties, Material& out) const {
    if (const std::optional<glm::dvec3> base = firstColor(properties, kBaseColor)) {
        const double weight = properties.states("Maya|base") ? properties.number("Maya|base", 1.0) : 1.0;
        out.baseColor = vec4(color(*base) * unit(weight), 1.0F);
    } else {
        // "Diffuse" is the colour times its factor, as old exporters wrote beside it.
        const glm::dvec3 diffuse = properties.vector("DiffuseColor", properties.vector("Diffuse", glm::dvec3(0.8)));
        out.baseColor = vec4(color(diffuse * properties.number("DiffuseFactor", 1.0)), 1.0F);
    }
    if (const std::optional<double> metallic = firstNumber(properties, kMetallic)) out.metallic = unit(*metallic);
    // Blender's exporter puts the metallic share there.
    else if (blender_)
        out.metallic = unit(properties.number("ReflectionFactor", 0.0));
    if (const std::optional<double> roughness = firstNumber(properties, kRoughness)) {
        out.roughness = unit(*roughness);
    } else {
        const double shininess = properties.number("Shininess", properties.number("ShininessExponent", 0.0));
        // Blender's exporter writes (10 (1 - roughness))².
        if (blender_ && shininess >= 0.0)
            out.roughness = unit(1.0 - std::sqrt(shininess) / 10.0);
        else if (shininess > 0.0)
            out.roughness = roughnessFromShininess(shininess);
    }
    const glm::dvec3 emissive = properties.vector("EmissiveColor", properties.vector("Emissive", glm::dvec3(0)));
    out.emissive = color(emissive * properties.number("EmissiveFactor", 1.0));
}

void MaterialReader::readTransparency(const Properties& properties, Material& out) const {
    // Exporters disagree about which end of FBX's transparency is opaque: a material that would be invisible is not.
    double opacity = 1.0;
    if (properties.states("Opacity")) {
        opacity = properties.number("Opacity", 1.0);
    } else if (properties.has("TransparencyFactor")) {
        const glm::dvec3 tint = properties.vector("TransparentColor", glm::dvec3(1));
        opacity = 1.0 - properties.number("TransparencyFactor", 0.0) * (tint.x + tint.y + tint.z) / 3.0;
    }
    if (!(opacity > 0.01 && opacity < 0.99)) return;
    out.baseColor.a = unit(opacity);
    out.alphaMode = Material::AlphaMode::blend;
}

int MaterialReader::loadTexture(int texture) {
    if (const auto known = known_.find(texture); known != known_.end()) return known->second;
    const Object& object = objects_[texture];
    PictureSource source;
    std::string_view path = textOf(object, "RelativeFilename");
    if (path.empty()) path = textOf(object, "FileName");
    for (const int video : objects_.children(texture, "Video")) {
        const Object& clip = objects_[video];
        if (path.empty()) path = textOf(clip, "RelativeFilename");
        if (path.empty()) path = textOf(clip, "Filename");
        const auto decoded = decoded_.find(std::string(textOf(clip, "RelativeFilename")));
        const std::string_view content = textOf(clip, "Content");
        if (decoded != decoded_.end())
            source.embedded = decoded->second;
        else
            source.embedded = {reinterpret_cast<const std::uint8_t*>(content.data()), content.size()};
    }
    source.path = std::string(path);
    const int index = source.path.empty() && source.embedded.empty() ? Material::kNoTexture : load_(source);
    known_[texture] = index;
    return index;
}

std::vector<std::string_view> MaterialReader::propertiesWithPictures(int material) const {
    std::vector<std::string_view> out;
    for (const Connection& connection : objects_.childrenOf(material)) {
        const std::string_view kind = objects_[connection.child].kind;
        if ((kind == "Texture" || kind == "LayeredTexture") && !connection.property.empty())
            out.push_back(connection.property);
    }
    return out;
}

// Shaders that people write name their pictures as they like; most say the plain word.
MaterialReader::Picture MaterialReader::pictureSaying(int material, std::span<const std::string_view> words) {
    std::vector<std::string_view> fitting;
    for (const std::string_view property : propertiesWithPictures(material)) {
        const std::string last = lowerCased(std::string(property.substr(property.find_last_of('|') + 1)));
        const auto says = [&](std::string_view word) { return last.find(word) != std::string::npos; };
        if (std::any_of(words.begin(), words.end(), says) && !says("mask")) fitting.push_back(property);
    }
    return picture(material, fitting);
}

MaterialReader::Picture MaterialReader::picture(int material, std::span<const std::string_view> properties) {
    Picture out;
    for (const std::string_view property : properties) {
        int texture = objects_.childAt(material, property, "Texture");
        if (const int layered = objects_.childAt(material, property, "LayeredTexture"); texture < 0 && layered >= 0) {
            const std::vector<int> layers = objects_.children(layered, "Texture");
            if (!layers.empty()) texture = layers.front();
        }
        if (texture < 0) continue;
        out.named = true;
        out.texture = loadTexture(texture);
        out.uvSet = std::string(objects_[texture].properties.text("UVSet"));
        if (out.texture != Material::kNoTexture) break;
    }
    return out;
}

void MaterialReader::readPictures(int material, ReadMaterial& out) {
    Material& made = out.material;
    Picture base = picture(material, kBaseColorPictures);
    const bool known = base.named;
    if (!known) base = pictureSaying(material, kBaseColorWords);
    made.baseColorTexture = base.texture;
    out.uvSet = base.uvSet;
    Picture normal = picture(material, kNormalPictures);
    if (!known && !normal.named) normal = pictureSaying(material, kNormalWords);
    made.normalTexture = normal.texture;
    const Picture emissive = picture(material, kEmissivePictures);
    made.emissiveTexture = emissive.texture;
    if (made.emissiveTexture != Material::kNoTexture) made.emissive = vec3(1);
    if (!base.named && !normal.named && !emissive.named) {
        for (const std::string_view property : propertiesWithPictures(material))
            unread_.emplace(property);
    }
    if (!base.named) return;
    // A picture replaces the colour. One that is not there leaves the colour that it would have replaced, often black:
    // neutral is visible.
    const vec3 instead = base.texture != Material::kNoTexture ? vec3(1) : vec3(Material{}.baseColor);
    made.baseColor = vec4(instead, made.baseColor.a);
}

}  // namespace lutka::animation::rig_import::fbx
