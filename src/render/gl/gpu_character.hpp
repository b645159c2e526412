#pragma once

#include <string>
#include <vector>

#include "animation/character.hpp"
#include "core/result.hpp"
#include "render/bounds.hpp"
#include "render/gl/gl_object.hpp"

namespace lutka::render {

/// A character on the GPU: its meshes as interleaved vertices, its materials and textures.
struct GpuCharacter {
    struct Mesh {
        GlVertexArray vertexArray;
        GlBuffer vertices;
        GlBuffer indices;
        GLsizei indexCount = 0;
        GLsizei vertexCount = 0;
        int material = 0;
    };

    std::vector<Mesh> meshes;
    std::vector<animation::Material> materials;  ///< Texture members index `textures`.
    std::vector<GlTexture> textures;
    std::vector<BoundingSphere> jointBounds;  ///< One a joint.
    long long meshBytes = 0;
    long long textureBytes = 0;  ///< With mipmaps.
};

/// Checks and uploads. What is odd about a material goes to `warnings`. Fails with ErrorCode::input when arrays do not
/// fit together or an index points outside.
[[nodiscard]] Result<GpuCharacter> makeGpuCharacter(const animation::Character& character,
                                                    std::vector<std::string>& warnings);

}  // namespace lutka::render
