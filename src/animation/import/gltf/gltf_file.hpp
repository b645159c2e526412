#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "animation/import/gltf/gltf_json.hpp"
#include "animation/import/model_folder.hpp"

namespace lutka::animation::rig_import::gltf {

/// Whether a URI holds its data itself.
[[nodiscard]] bool isDataUri(const std::string& uri);
/// The bytes of a data URI; nothing when it is another URI. Throws Damage when its base64 is broken.
[[nodiscard]] std::optional<std::vector<std::uint8_t>> decodeDataUri(const std::string& uri);

/// A glTF 2.0 document with its buffers. All of its functions throw Damage.
class GltfFile {
  public:
    /// Opens a .gltf or .glb, told apart by content, and checks extensionsRequired.
    /// Buffers of its own lie where ModelFolder allows.
    GltfFile(const std::filesystem::path& file, bool allowOutside);

    [[nodiscard]] const nlohmann::json& json() const { return json_; }
    [[nodiscard]] const ModelFolder& folder() const { return folder_; }
    /// An element of a top-level array; the index comes from indexOf().
    [[nodiscard]] const nlohmann::json& element(const char* array, int index) const;
    [[nodiscard]] std::size_t count(const char* array) const { return countOf(json_, array); }

    /// The bytes of a buffer view, decompressed where it is compressed (EXT_meshopt_compression).
    [[nodiscard]] std::span<const std::uint8_t> viewBytes(int view);

    /// Remembers what was left out, to be told once: extension or feature → what that means.
    void leaveOut(const std::string& what) { leftOut_.insert(what); }
    [[nodiscard]] const std::set<std::string>& leftOut() const { return leftOut_; }

  private:
    void readContainer();
    void checkExtensions();
    [[nodiscard]] std::span<const std::uint8_t> bufferBytes(int buffer);
    [[nodiscard]] std::vector<std::uint8_t> loadBuffer(int buffer) const;
    [[nodiscard]] std::span<const std::uint8_t> slice(int buffer, std::size_t offset, std::size_t length);
    [[nodiscard]] std::vector<std::uint8_t> decompressed(const nlohmann::json& block);

    std::filesystem::path file_;
    ModelFolder folder_;
    nlohmann::json json_;
    std::vector<std::uint8_t> container_;   ///< The whole .glb.
    std::span<const std::uint8_t> binary_;  ///< The .glb's own buffer in it.
    std::map<int, std::vector<std::uint8_t>> buffers_;
    std::map<int, std::vector<std::uint8_t>> unpackedViews_;
    std::set<std::string> leftOut_;
};

}  // namespace lutka::animation::rig_import::gltf
