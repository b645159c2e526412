#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "core/math.hpp"

namespace lutka::test {

/// A triangle as Assimp's scene shows it in the nodes' pose, in the file's units and axes.
struct OracleTriangle {
    std::array<vec3, 3> corners;
    bool comparable = true;  ///< False when a corner has no weights (where it goes is the importer's choice).
};

/// Reads the file with Assimp and evaluates sum(w * G * offset * v) over the four strongest weights, normalised, mesh
/// after mesh in the order of the scene's nodes: written apart from the importer, to check it.
[[nodiscard]] std::vector<OracleTriangle> oracleTriangles(const std::filesystem::path& file);

}  // namespace lutka::test
