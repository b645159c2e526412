#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "core/result.hpp"
#include "render/frame.hpp"
#include "render/gl/draw_list.hpp"
#include "render/gl/gpu_character.hpp"
#include "render/gl/pass_timer.hpp"
#include "render/gl/prop_meshes.hpp"
#include "render/gl/render_target.hpp"
#include "render/gl/shader_program.hpp"
#include "render/gl/stream_buffer.hpp"

namespace lutka::render {

/// The characters of a renderer by handle; null where one was removed.
using CharacterStore = std::vector<std::unique_ptr<GpuCharacter>>;

/// The passes that draw characters, props, floor and background:
///
///   shadow map ──┐
///   depth at half size ─▶ occlusion ─▶ blur ─┤
///                                            ▼
///         opaque ─▶ floor ─▶ background ─▶ translucent      (the picture)
class SceneRenderer {
  public:
    [[nodiscard]] static Result<SceneRenderer> create(int shadowMapSize);

    /// Compiles what the materials of a character need, so that drawing it can't fail.
    [[nodiscard]] Result<void> prepare(const GpuCharacter& character);

    /// Draws into `picture` and leaves it bound, with the block `Frame` filled.
    void draw(const FrameDescription& frame, const CharacterStore& characters, const PictureTarget& picture,
              PassTimer& timer, FrameStats& stats);

    /// Adds what it holds on the GPU, but for the characters.
    void addMemory(GpuMemory& memory) const;

  private:
    explicit SceneRenderer(int shadowMapSize);

    /// Which programs a material needs: bits say what it has.
    using MaterialKey = unsigned;
    [[nodiscard]] static MaterialKey keyOf(const animation::Material& material);
    [[nodiscard]] static std::vector<std::string> definesOf(MaterialKey key);

    void upload(const FrameDescription& frame, const CharacterStore& characters, Extent size, FrameStats& stats);
    void drawShadowMap(const CharacterStore& characters, FrameStats& stats);
    void drawOcclusion(const FrameDescription& frame, const CharacterStore& characters, Extent size, FrameStats& stats);
    void drawOpaque(const FrameDescription& frame, const CharacterStore& characters, FrameStats& stats);
    void drawBackground(FrameStats& stats);
    void drawFloor(FrameStats& stats);
    void drawTranslucent(const CharacterStore& characters, FrameStats& stats);

    /// The depth of opaque meshes (of all meshes: `all`), seen from `depthFromWorld`.
    void drawDepth(const DrawList::Pass& pass, const CharacterStore& characters, const mat4& depthFromWorld, bool all,
                   FrameStats& stats);
    void drawCharacterDepth(std::span<const DrawList::Batch> batches, const CharacterStore& characters,
                            const mat4& depthFromWorld, bool all, FrameStats& stats);
    enum class Meshes { opaque, blended, all };
    void drawCharacters(std::span<const DrawList::Batch> batches, const CharacterStore& characters, Meshes which,
                        FrameStats& stats);
    static void drawMesh(const ShaderProgram& program, const GpuCharacter::Mesh& mesh, const DrawList::Batch& batch,
                         FrameStats& stats);
    /// With `program` in use.
    void drawProps(const ShaderProgram& program, std::span<const DrawList::Batch> batches, FrameStats& stats);
    void drawScreen(FrameStats& stats);

    int shadowMapSize_;
    std::size_t mostJoints_;  ///< That a texture buffer holds.
    std::map<MaterialKey, ShaderProgram> characterPrograms_;
    ShaderProgram characterDepth_;
    ShaderProgram characterDepthMasked_;
    ShaderProgram prop_;
    ShaderProgram propDepth_;
    ShaderProgram floor_;
    ShaderProgram floorDepth_;
    ShaderProgram background_;
    ShaderProgram occlusion_;
    ShaderProgram occlusionBlur_;

    PropMeshes propMeshes_;
    GlVertexArray noVertices_;  ///< For shapes that the vertex shader makes up.
    GlTexture white_;           ///< Stands in where a texture is missing.
    DepthTarget shadowMap_;
    GlSampler uncompared_;  ///< Reads the shadow map's depths.
    DepthTarget smallDepth_;
    ChannelTarget noisyOcclusion_;
    ChannelTarget smoothOcclusion_;

    DrawList list_;
    FrameUniforms uniforms_;
    ShadowFit shadowFit_;
    StreamBuffer uniformBuffer_;
    TexelStream palettes_;
    TexelStream instances_;
};

}  // namespace lutka::render
