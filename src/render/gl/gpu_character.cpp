#include "render/gl/gpu_character.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "render/level_of_detail.hpp"

namespace lutka::render {
namespace {

using animation::Character;
using animation::Material;
using animation::SkinnedMesh;
using animation::Texture;

struct Vertex {
    vec3 position;
    vec3 normal;
    vec4 tangent;
    vec2 uv;
    std::array<std::uint16_t, animation::kMaxInfluences> joints;
    std::array<float, animation::kMaxInfluences> weights;
};
static_assert(sizeof(Vertex) == 72);

// The reason why a mesh can't be drawn; empty when it can.
std::string defectOf(const SkinnedMesh& mesh, const Character& character) {
    const std::size_t count = mesh.positions.size();
    if (mesh.normals.size() != count || mesh.joints.size() != count || mesh.weights.size() != count) {
        return "its vertex arrays differ in size";
    }
    const auto fits = [&](std::size_t size) { return size == 0 || size == count; };
    if (!fits(mesh.tangents.size()) || !fits(mesh.uvs.size()) || !fits(mesh.colors.size())) {
        return "its vertex arrays differ in size";
    }
    if (mesh.indices.size() % 3 != 0) return "its indices are no triangles";
    for (const std::uint32_t index : mesh.indices) {
        if (index >= count) return "an index points outside its vertices";
    }
    for (const auto& joints : mesh.joints) {
        for (const std::uint16_t joint : joints) {
            if (joint >= character.skeleton.parents.size()) return "a weight names a joint outside the skeleton";
        }
    }
    const auto materials = static_cast<int>(character.materials.size());
    if (mesh.material < 0 || mesh.material >= materials) return "its material does not exist";
    return "";
}

std::vector<Vertex> interleaved(const SkinnedMesh& mesh) {
    std::vector<Vertex> vertices(mesh.positions.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        vertices[i] = {mesh.positions[i],
                       mesh.normals[i],
                       mesh.tangents.empty() ? vec4(0) : mesh.tangents[i],
                       mesh.uvs.empty() ? vec2(0) : mesh.uvs[i],
                       mesh.joints[i],
                       mesh.weights[i]};
    }
    return vertices;
}

// Of the figure's height: for a figure of about 170, 100 and 50 pixels.
constexpr std::array<float, 3> kCells = {1.0F / 90.0F, 1.0F / 50.0F, 1.0F / 25.0F};

float heightOf(const Character& character) {
    float lowest = std::numeric_limits<float>::max();
    float highest = std::numeric_limits<float>::lowest();
    for (const SkinnedMesh& mesh : character.meshes) {
        for (const vec3& position : mesh.positions) {
            lowest = std::min(lowest, position.y);
            highest = std::max(highest, position.y);
        }
    }
    return std::max(highest - lowest, 0.0F);
}

// All levels' indices one after the other; a level that saves little is left out.
std::vector<std::uint32_t> indicesOf(const SkinnedMesh& mesh, float height,
                                     std::vector<GpuCharacter::Detail>& details) {
    std::vector<std::uint32_t> indices = mesh.indices;
    details = {{static_cast<GLsizei>(mesh.indices.size()), 0, 0.0F}};
    for (const float part : kCells) {
        if (height <= 0.0F) break;
        const std::vector<std::uint32_t> coarse = clusteredIndices(mesh, part * height);
        if (static_cast<float>(coarse.size()) > 0.8F * static_cast<float>(details.back().indexCount)) continue;
        details.push_back({static_cast<GLsizei>(coarse.size()), indices.size() * sizeof(std::uint32_t), part * height});
        indices.insert(indices.end(), coarse.begin(), coarse.end());
    }
    return indices;
}

// Into the vertex array that is bound.
void uploadColors(const SkinnedMesh& mesh, GpuCharacter::Mesh& gpu) {
    if (mesh.colors.empty()) return;
    gpu.colored = true;
    gpu.colors = GlBuffer::create();
    glBindBuffer(GL_ARRAY_BUFFER, gpu.colors.name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.colors.size() * sizeof(vec4)), mesh.colors.data(),
                 GL_STATIC_DRAW);
    glEnableVertexAttribArray(kColorAttribute);
    glVertexAttribPointer(kColorAttribute, 4, GL_FLOAT, GL_FALSE, sizeof(vec4), attributeOffset(0));
}

GpuCharacter::Mesh upload(const SkinnedMesh& mesh, float height) {
    GpuCharacter::Mesh gpu;
    gpu.vertexArray = GlVertexArray::create();
    gpu.vertices = GlBuffer::create();
    gpu.indices = GlBuffer::create();
    const std::vector<std::uint32_t> indices = indicesOf(mesh, height, gpu.details);
    gpu.vertexCount = static_cast<GLsizei>(mesh.positions.size());
    gpu.material = mesh.material;
    const std::vector<Vertex> vertices = interleaved(mesh);
    glBindVertexArray(gpu.vertexArray.name());
    glBindBuffer(GL_ARRAY_BUFFER, gpu.vertices.name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)), vertices.data(),
                 GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, gpu.indices.name());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint32_t)),
                 indices.data(), GL_STATIC_DRAW);
    const auto floats = [](GLuint location, GLint count, std::size_t offset) {
        glEnableVertexAttribArray(location);
        glVertexAttribPointer(location, count, GL_FLOAT, GL_FALSE, sizeof(Vertex), attributeOffset(offset));
    };
    floats(0, 3, offsetof(Vertex, position));
    floats(1, 3, offsetof(Vertex, normal));
    floats(2, 4, offsetof(Vertex, tangent));
    floats(3, 2, offsetof(Vertex, uv));
    glEnableVertexAttribArray(4);
    glVertexAttribIPointer(4, animation::kMaxInfluences, GL_UNSIGNED_SHORT, sizeof(Vertex),
                           attributeOffset(offsetof(Vertex, joints)));
    floats(5, 4, offsetof(Vertex, weights));
    uploadColors(mesh, gpu);
    glBindVertexArray(0);
    return gpu;
}

GlTexture upload(const Texture& texture, bool srgb) {
    GlTexture gpu = GlTexture::create();
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, gpu.name());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8, texture.width, texture.height, 0, GL_RGBA,
                 GL_UNSIGNED_BYTE, texture.rgba.data());
    glGenerateMipmap(GL_TEXTURE_2D);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
    return gpu;
}

// Rows start at the picture's top, as UVs do in glTF, so nothing is flipped.
bool isWhole(const Texture& texture) {
    return texture.width > 0 && texture.height > 0 &&
           texture.rgba.size() ==
               static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height) * 4;
}

bool isTooLarge(const Texture& texture) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    return std::max(texture.width, texture.height) > most;
}

// Uploads each texture once for each colour space that materials use it in.
class TextureUploader {
  public:
    TextureUploader(const Character& character, GpuCharacter& gpu, std::vector<std::string>& warnings)
        : character_(character),
          gpu_(gpu),
          warnings_(warnings),
          linear_(character.textures.size(), Material::kNoTexture),
          srgb_(character.textures.size(), Material::kNoTexture) {}

    /// The index in the GPU's list for one of the character's.
    int operator()(int texture, bool srgb, const std::string& material) {
        if (texture == Material::kNoTexture) return Material::kNoTexture;
        const bool exists = texture >= 0 && texture < static_cast<int>(character_.textures.size());
        if (exists && isTooLarge(character_.textures[texture])) {
            warnings_.push_back(fmt::format(
                "{}: a texture of material '{}' has {} x {} pixels, more than this driver takes; it is drawn without",
                character_.name, material, character_.textures[texture].width, character_.textures[texture].height));
            return Material::kNoTexture;
        }
        if (!exists || !isWhole(character_.textures[texture])) {
            warnings_.push_back(fmt::format("{}: a texture of material '{}' is missing; it is drawn without",
                                            character_.name, material));
            return Material::kNoTexture;
        }
        int& known = srgb ? srgb_[texture] : linear_[texture];
        if (known == Material::kNoTexture) {
            known = static_cast<int>(gpu_.textures.size());
            gpu_.textures.push_back(upload(character_.textures[texture], srgb));
            gpu_.textureBytes += static_cast<long long>(character_.textures[texture].rgba.size()) * 4 / 3;
        }
        return known;
    }

  private:
    const Character& character_;
    GpuCharacter& gpu_;
    std::vector<std::string>& warnings_;
    std::vector<int> linear_;
    std::vector<int> srgb_;
};

}  // namespace

Result<GpuCharacter> makeGpuCharacter(const Character& character, bool levelsOfDetail,
                                      std::vector<std::string>& warnings) {
    for (const SkinnedMesh& mesh : character.meshes) {
        const std::string defect = defectOf(mesh, character);
        if (!defect.empty()) {
            return Error{ErrorCode::input, fmt::format("the mesh '{}' can't be drawn: {}", mesh.name, defect),
                         character.file.string(), ""};
        }
    }
    GpuCharacter gpu;
    const float height = levelsOfDetail ? heightOf(character) : 0.0F;
    for (const SkinnedMesh& mesh : character.meshes)
        gpu.meshes.push_back(upload(mesh, height));
    TextureUploader textures(character, gpu, warnings);
    for (Material material : character.materials) {
        material.baseColorTexture = textures(material.baseColorTexture, true, material.name);
        material.metallicRoughnessTexture = textures(material.metallicRoughnessTexture, false, material.name);
        material.normalTexture = textures(material.normalTexture, false, material.name);
        material.occlusionTexture = textures(material.occlusionTexture, false, material.name);
        material.emissiveTexture = textures(material.emissiveTexture, true, material.name);
        gpu.materials.push_back(std::move(material));
    }
    gpu.jointBounds = jointBounds(character);
    for (const GpuCharacter::Mesh& mesh : gpu.meshes) {
        gpu.meshBytes +=
            static_cast<long long>(mesh.vertexCount) *
                static_cast<long long>(sizeof(Vertex) + (mesh.colored ? sizeof(vec4) : 0)) +
            static_cast<long long>(mesh.details.back().firstByte) +
            static_cast<long long>(mesh.details.back().indexCount) * static_cast<long long>(sizeof(std::uint32_t));
    }
    return gpu;
}

}  // namespace lutka::render
