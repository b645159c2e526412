#pragma once

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/math.hpp"

namespace lutka::test {

/// A folder of its own for a test's files, removed with all that is in it.
class TemporaryFolder {
  public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  private:
    std::filesystem::path path_;
};

/// A glTF 2.0 document made by hand; nodes, skins and so on are added to `json` as the test needs them.
class GltfFile {
  public:
    GltfFile();

    nlohmann::json json;

    int addNode(const std::string& name, int parent, const mat4& parentFromNode = mat4(1.0F));
    /// Accessors over floats and over what else a skin needs.
    int addFloats(std::span<const float> values, const std::string& type);
    int addBytes4(std::span<const std::array<std::uint8_t, 4>> values);
    int addIndices(std::span<const std::uint16_t> values);
    /// An accessor over any component type of glTF (5120 … 5126).
    template <class T>
    int addComponents(std::span<const T> values, int componentType, const std::string& type, std::size_t count,
                      bool normalized) {
        json["accessors"].push_back({{"bufferView", addView(values.data(), values.size_bytes())},
                                     {"componentType", componentType},
                                     {"count", count},
                                     {"type", type},
                                     {"normalized", normalized}});
        return static_cast<int>(json["accessors"].size()) - 1;
    }
    /// A clip that turns a node; `times` in seconds, `values` an accessor of quaternions.
    void addTurn(const std::string& clip, int node, std::span<const float> times, int values,
                 const std::string& interpolation);

    void saveText(const std::filesystem::path& file) const;
    void saveBinary(const std::filesystem::path& file) const;
    /// As text, with the buffer in a file of its own beside it, which the document calls `uri`.
    void saveBeside(const std::filesystem::path& file, const std::string& bufferName, const std::string& uri) const;

  private:
    int addView(const void* data, std::size_t size);
    std::vector<unsigned char> bytes_;
};

/// Skin of one vertex.
struct HandSkin {
    std::array<std::uint8_t, 4> joints{};
    std::array<float, 4> weights{1, 0, 0, 0};
};

/// A post of square rings, 1.8 m tall, 0.6 m wide and 0.4 m deep, feet on the floor: what the hand-made rigs wear.
struct Post {
    std::vector<vec3> positions;  // four a ring, at the heights 0, 0.6, 1.2 and 1.8 m
    std::vector<std::uint16_t> indices;
    std::vector<HandSkin> skin;  // ring r follows joint min(r, 2)
};
[[nodiscard]] Post makePost();

/// Adds the post as a mesh (positions taken to mesh space by `meshFromModel`) and returns its index.
int addPostMesh(GltfFile& file, const Post& post, const mat4& meshFromModel = mat4(1.0F), bool skinned = true);

/// Adds a skin over the nodes and returns its index; `jointFromMesh` are the inverse bind matrices.
int addSkin(GltfFile& file, const std::vector<int>& nodes, const std::vector<mat4>& jointFromMesh);

/// A post on three joints (`low`, `middle`, `high` at heights 0, 0.6 and 1.2 m) below an `Armature` node; the mesh
/// hangs below the armature too and is written in its space.
[[nodiscard]] GltfFile makePostRig(const mat4& sceneFromArmature = mat4(1.0F));

}  // namespace lutka::test
