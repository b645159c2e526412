#pragma once

#include <array>

#include "render/frame.hpp"
#include "render/gl/gl_object.hpp"

namespace lutka::render {

/// One mesh for each kind of prop, of unit measures; the vertex shader gives it its size (assets/shaders/prop.glsl).
class PropMeshes {
  public:
    static constexpr int kKinds = 5;  // ShapeKind without the mesh, which is its last; no prop is a hull

    PropMeshes();

    /// Draws instances of a kind with the program in use.
    void draw(ShapeKind kind, int instances) const;
    [[nodiscard]] int triangleCount(ShapeKind kind) const;
    [[nodiscard]] long long bytes() const;

  private:
    struct Mesh {
        GlVertexArray vertexArray;
        GlBuffer vertices;
        GLsizei vertexCount = 0;
    };
    std::array<Mesh, kKinds> meshes_;
};

}  // namespace lutka::render
