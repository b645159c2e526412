#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace lutka::animation::rig_import::iqm {

/// A pose relative to the parent: scaled first, then turned, then moved.
struct Placement {
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< A unit.
    glm::dvec3 scale{1.0};
};

struct Joint {
    std::string name;
    int parent = -1;  ///< Smaller than the joint's own index; -1 for a root.
    Placement bind;
};

/// A range of the document's vertices and triangles.
struct Mesh {
    std::string name;
    std::string material;  ///< By the format the name of a picture; exporters write any name.
    std::size_t firstVertex = 0, vertexCount = 0;
    std::size_t firstTriangle = 0, triangleCount = 0;
};

struct Animation {
    std::string name;
    std::size_t firstFrame = 0, frameCount = 0;
    double frameRate = 0.0;  ///< Frames a second, > 0.
};

/// A property of the vertices, `components` numbers each.
struct VertexArray {
    int components = 0;
    std::vector<float> values;  ///< Whole numbers as they are, not yet divided.
    float most = 1.0F;          ///< What stands for 1 where such a number is a share: 255 of unsigned bytes …

    [[nodiscard]] bool empty() const { return values.empty(); }
    [[nodiscard]] std::span<const float> at(std::size_t vertex) const {
        return std::span(values).subspan(vertex * static_cast<std::size_t>(components),
                                         static_cast<std::size_t>(components));
    }
};

/// An Inter-Quake Model, version 1 or 2 (Lee Salzman's format of Sauerbraten, Red Eclipse, raylib and others).
struct IqmDocument {
    int version = 2;
    std::vector<Joint> joints;
    std::vector<Mesh> meshes;
    std::size_t vertexCount = 0;
    VertexArray positions, normals, uvs, blendIndices, blendWeights, colors;
    std::vector<std::uint32_t> corners;  ///< Three a triangle, clockwise as seen from outside.
    std::vector<Animation> animations;
    std::size_t frameCount = 0;
    std::vector<Placement> frames;  ///< joints.size() a frame, or none at all.
    std::vector<std::string> warnings;
};

/// Whether the bytes are those of such a file.
[[nodiscard]] bool isIqm(std::string_view start);

/// Reads the file's bytes; every place and count is checked. Animations of a file whose poses are not those of its
/// joints are left out, with a warning. Fails with ErrorCode::input when the file is cut off or damaged, is of another
/// version, or has more than a file may have (source_limits.hpp).
[[nodiscard]] Result<IqmDocument> parseIqm(std::span<const unsigned char> bytes, const std::string& location);

}  // namespace lutka::animation::rig_import::iqm
