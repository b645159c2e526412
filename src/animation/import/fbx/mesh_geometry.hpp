#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "animation/import/fbx/node_transform.hpp"
#include "animation/import/fbx/objects.hpp"
#include "animation/import/source_scene.hpp"

namespace lutka::animation::rig_import::fbx {

/// A mesh of one material, and which control point of the geometry each vertex comes from.
struct MeshPart {
    SourceMesh mesh;
    std::vector<std::uint32_t> controlPoints;
    int slot = 0;  ///< The place of its material among those of the node.
};

/// What was wrong with a document's meshes, over all of them.
struct GeometryRepairs {
    std::size_t brokenPolygons = 0;  ///< Named corners that are not there, or had fewer than three.
    bool tooManyVertices = false;    ///< The meshes from there on were left out.

    [[nodiscard]] std::vector<std::string> sentences() const;
};

/// Reads geometries as triangle meshes, split by material.
class GeometryReader {
  public:
    GeometryReader(const Objects& objects, GeometryRepairs& repairs) : objects_(objects), repairs_(repairs) {}

    /// The parts of a geometry with its blend shapes at their default weights, with `meshFromGeometry` applied.
    /// `uvSet` names the UV set for each material slot of the node; empty or missing: the first.
    [[nodiscard]] std::vector<MeshPart> read(int geometry, const dmat4& meshFromGeometry,
                                             std::span<const std::string> uvSets);

  private:
    [[nodiscard]] std::vector<dvec3> controlPoints(int geometry) const;

    const Objects& objects_;
    GeometryRepairs& repairs_;
    std::size_t corners_ = 0;
};

}  // namespace lutka::animation::rig_import::fbx
