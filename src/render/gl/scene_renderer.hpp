#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/result.hpp"
#include "render/frame.hpp"
#include "render/gl/draw_list.hpp"
#include "render/gl/environment_map.hpp"
#include "render/gl/gpu_character.hpp"
#include "render/gl/pass_timer.hpp"
#include "render/gl/program_variants.hpp"
#include "render/gl/prop_meshes.hpp"
#include "render/gl/render_target.hpp"
#include "render/gl/renderer_options.hpp"
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
    /// Fails as ShaderProgram::load().
    [[nodiscard]] static Result<SceneRenderer> create(const RendererOptions& options);

    /// Compiles what the materials of a character need, so that drawing it can't fail.
    [[nodiscard]] Result<void> prepare(const GpuCharacter& character);

    /// Draws into `picture` and leaves it bound, with the block `Frame` filled.
    void draw(const FrameDescription& frame, const CharacterStore& characters, const PictureTarget& picture,
              PassTimer& timer, FrameStats& stats);

    /// Null: none.
    void setEnvironment(const Environment* environment);

    /// Moves what went wrong while drawing, a sentence each, to the end of `warnings`.
    void giveWarnings(std::vector<std::string>& warnings);

    /// Adds what it holds on the GPU, but for the characters.
    void addMemory(GpuMemory& memory) const;

  private:
    explicit SceneRenderer(const RendererOptions& options);

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
    [[nodiscard]] float coarsestCell(const DrawList::Batch& batch) const;
    void drawMesh(const ShaderProgram& program, const GpuCharacter::Mesh& mesh, const DrawList::Batch& batch,
                  FrameStats& stats) const;
    void drawLitProps(std::span<const DrawList::Batch> batches, FrameStats& stats);
    /// With `program` in use.
    void drawProps(const ShaderProgram& program, std::span<const DrawList::Batch> batches, FrameStats& stats);
    void drawScreen(FrameStats& stats);

    int shadowMapSize_;
    std::size_t mostJoints_;  ///< That a texture buffer holds.
    bool occlusionAllowed_;
    unsigned always_;        ///< Features of every lit program.
    unsigned lighting_ = 0;  ///< Features that this frame's light asks for.
    ProgramVariants characterPrograms_{"character.vert", "character.frag"};
    ProgramVariants propPrograms_{"prop.vert", "prop.frag"};
    ProgramVariants floorPrograms_{"floor.vert", "floor.frag"};
    ProgramVariants backgroundPrograms_{"screen.vert", "background.frag"};
    std::vector<std::string> warnings_;
    std::optional<EnvironmentMap> environment_;
    ShaderProgram characterDepth_;
    ShaderProgram characterDepthMasked_;
    ShaderProgram propDepth_;
    ShaderProgram floorDepth_;
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
    float metresAPixel_ = 0.0F;  ///< Across the view: everywhere when orthographic, else at a metre from the eye.
    bool orthographic_ = false;
    bool intoShadowMap_ = false;
    FrameUniforms uniforms_;
    ShadowFit shadowFit_;
    StreamBuffer uniformBuffer_;
    TexelStream palettes_;
    TexelStream instances_;
};

}  // namespace lutka::render
