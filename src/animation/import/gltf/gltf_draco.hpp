#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "animation/import/gltf/accessor.hpp"

namespace draco {
class Mesh;
class PointAttribute;
}  // namespace draco

namespace lutka::animation::rig_import::gltf {

/// The part of a primitive that is compressed (KHR_draco_mesh_compression): its triangles, and those attributes that
/// the extension lists. Others of the primitive's attributes lie in accessors as ever.
class DracoPrimitive {
  public:
    /// Throws Damage where the block or its data is damaged.
    DracoPrimitive(GltfFile& file, const nlohmann::json& block);
    DracoPrimitive(DracoPrimitive&&) noexcept;
    ~DracoPrimitive();

    /// The vertices' numbers; integers are fractions where the attribute's accessor says `normalised`, which the
    /// compressed data need not repeat. Nothing where the attribute is not compressed.
    [[nodiscard]] std::optional<Numbers> numbers(const std::string& attribute, bool normalised) const;
    /// Unsigned integers as they are, vertex after vertex. Nothing where the attribute is not compressed.
    [[nodiscard]] std::optional<std::vector<std::uint32_t>> integers(const std::string& attribute) const;
    /// Three vertices a triangle.
    [[nodiscard]] std::vector<std::uint32_t> triangles() const;

  private:
    [[nodiscard]] const draco::PointAttribute* find(const std::string& attribute) const;

    std::unique_ptr<draco::Mesh> mesh_;
    nlohmann::json ids_;  ///< Name of an attribute → its number in the compressed data.
};

}  // namespace lutka::animation::rig_import::gltf
