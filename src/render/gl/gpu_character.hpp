#pragma once

#include <string>
#include <vector>

#include "animation/character.hpp"
#include "core/result.hpp"
#include "render/bounds.hpp"
#include "render/gl/gl_object.hpp"

namespace lutka::render {

/// Where shaders take vertex colours; a mesh without has the constant of the context, which is set to white.
inline constexpr GLuint kColorAttribute = 6;

/// A character on the GPU: its meshes as interleaved vertices, its materials and textures.
struct GpuCharacter {
    /// A level of detail: a range of the mesh's indices.
    struct Detail {
        GLsizei indexCount = 0;
        std::size_t firstByte = 0;
        float cell = 0.0F;  ///< Metres that it may be off by, about.
    };
    struct Mesh {
        GlVertexArray vertexArray;
        GlBuffer vertices;
        GlBuffer indices;
        GlBuffer colors;              ///< None without vertex colours.
        std::vector<Detail> details;  ///< The whole mesh first, then ever coarser ones.
        GLsizei vertexCount = 0;
        int material = 0;
        bool colored = false;  ///< It has vertex colours.

        /// The coarsest that is off by no more than `cell` metres.
        [[nodiscard]] const Detail& detailFor(float cell) const {
            std::size_t i = details.size() - 1;
            while (i > 0 && details[i].cell > cell)
                --i;
            return details[i];
        }
    };

    std::vector<Mesh> meshes;
    std::vector<animation::Material> materials;  ///< Texture members index `textures`.
    std::vector<GlTexture> textures;
    std::vector<BoundingSphere> jointBounds;  ///< One a joint.
    long long meshBytes = 0;
    long long textureBytes = 0;  ///< With mipmaps.
};

/// Checks and uploads, with coarser levels of detail when asked for. What is odd about a material goes to `warnings`.
/// Fails with ErrorCode::input when arrays do not fit together or an index points outside.
[[nodiscard]] Result<GpuCharacter> makeGpuCharacter(const animation::Character& character, bool levelsOfDetail,
                                                    std::vector<std::string>& warnings);

}  // namespace lutka::render
