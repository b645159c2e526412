#include "render/gl/prop_meshes.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include "render/box_sides.hpp"

namespace lutka::render {
namespace {

// Position = roundPart · radius + extentPart · half extents.
struct PropVertex {
    vec3 roundPart;
    vec3 extentPart;
    vec3 normal;
};

void addQuad(std::vector<PropVertex>& out, const PropVertex& a, const PropVertex& b, const PropVertex& c,
             const PropVertex& d) {
    out.insert(out.end(), {a, b, c, a, c, d});
}

std::vector<PropVertex> boxVertices() {
    std::vector<PropVertex> out;
    for (const BoxSide& side : boxSides()) {
        const auto corner = [&](std::size_t index) { return PropVertex{vec3(0), side.corners[index], side.normal}; };
        addQuad(out, corner(0), corner(1), corner(2), corner(3));
    }
    return out;
}

std::vector<PropVertex> planeVertices() {
    const auto corner = [](float x, float z) { return PropVertex{vec3(0), vec3(x, 0, z), vec3(0, 1, 0)}; };
    std::vector<PropVertex> out;
    addQuad(out, corner(-1, -1), corner(-1, 1), corner(1, 1), corner(1, -1));
    return out;
}

// A sphere, cut at the equator: the halves move apart by the half length (a sphere's is not used).
std::vector<PropVertex> roundVertices(bool capsule) {
    constexpr int kSegments = 40;
    constexpr int kHalfRings = 10;
    const auto at = [&](int ring, int segment) {
        const bool upper = ring > kHalfRings;
        const int fromEquator = upper ? ring - kHalfRings - 1 : ring - kHalfRings;
        const float latitude = 0.5F * kPi * static_cast<float>(fromEquator) / kHalfRings;
        const float longitude = 2.0F * kPi * static_cast<float>(segment % kSegments) / kSegments;
        const vec3 n(std::cos(latitude) * std::cos(longitude), std::sin(latitude),
                     -std::cos(latitude) * std::sin(longitude));
        return PropVertex{n, capsule ? vec3(0, upper ? 1.0F : -1.0F, 0) : vec3(0), n};
    };
    std::vector<PropVertex> out;
    for (int ring = 0; ring < 2 * kHalfRings + 1; ++ring) {
        for (int segment = 0; segment < kSegments; ++segment)
            addQuad(out, at(ring, segment), at(ring, segment + 1), at(ring + 1, segment + 1), at(ring + 1, segment));
    }
    return out;
}

std::vector<PropVertex> verticesOf(ShapeKind kind) {
    switch (kind) {
        case ShapeKind::box:
            return boxVertices();
        case ShapeKind::sphere:
            return roundVertices(false);
        case ShapeKind::capsule:
            return roundVertices(true);
        default:
            break;
    }
    return planeVertices();
}

}  // namespace

PropMeshes::PropMeshes() {
    for (int kind = 0; kind < kKinds; ++kind) {
        if (static_cast<ShapeKind>(kind) == ShapeKind::hull) continue;
        Mesh& mesh = meshes_[kind];
        const std::vector<PropVertex> vertices = verticesOf(static_cast<ShapeKind>(kind));
        mesh.vertexArray = GlVertexArray::create();
        mesh.vertices = GlBuffer::create();
        mesh.vertexCount = static_cast<GLsizei>(vertices.size());
        glBindVertexArray(mesh.vertexArray.name());
        glBindBuffer(GL_ARRAY_BUFFER, mesh.vertices.name());
        glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(PropVertex)), vertices.data(),
                     GL_STATIC_DRAW);
        const std::size_t offsets[] = {offsetof(PropVertex, roundPart), offsetof(PropVertex, extentPart),
                                       offsetof(PropVertex, normal)};
        for (GLuint location = 0; location < 3; ++location) {
            glEnableVertexAttribArray(location);
            glVertexAttribPointer(location, 3, GL_FLOAT, GL_FALSE, sizeof(PropVertex),
                                  attributeOffset(offsets[location]));
        }
    }
    glBindVertexArray(0);
}

void PropMeshes::draw(ShapeKind kind, int instances) const {
    const Mesh& mesh = meshes_[static_cast<int>(kind)];
    glBindVertexArray(mesh.vertexArray.name());
    glDrawArraysInstanced(GL_TRIANGLES, 0, mesh.vertexCount, instances);
}

long long PropMeshes::bytes() const {
    long long sum = 0;
    for (const Mesh& mesh : meshes_)
        sum += static_cast<long long>(mesh.vertexCount) * static_cast<long long>(sizeof(PropVertex));
    return sum;
}

int PropMeshes::triangleCount(ShapeKind kind) const {
    return meshes_[static_cast<int>(kind)].vertexCount / 3;
}

}  // namespace lutka::render
