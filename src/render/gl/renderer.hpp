#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "animation/character.hpp"
#include "animation/skinning.hpp"
#include "core/result.hpp"
#include "render/environment.hpp"
#include "render/frame.hpp"
#include "render/gl/gl_context.hpp"
#include "render/gl/renderer_options.hpp"
#include "render/image.hpp"

namespace lutka::render {

/// Where Renderer::skinOnGpu() writes, model space: one element a vertex each.
struct SkinnedVertices {
    std::span<vec3> positions;
    std::span<vec3> normals;   ///< Unit length.
    std::span<vec3> tangents;  ///< Any length; zero where the mesh has none.
};

/// Draws FrameDescriptions with OpenGL 3.3: skinned characters (GPU skinning, instanced by mesh), props, floor, shadow,
/// debug geometry. The picture is made in an offscreen multisampled framebuffer, from where it is read (headless),
/// shown in a window, or used as a texture.
///
/// All calls need the context current, on the thread that made it.
class Renderer {
  public:
    /// Makes `context` current and compiles the shaders of assets/shaders. The context (which may be moved) must
    /// outlive the renderer. Fails with ErrorCode::input for a missing shader, ErrorCode::internal naming file and line
    /// for one that does not compile.
    [[nodiscard]] static Result<Renderer> create(GlContext& context, const RendererOptions& options = {});

    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;
    ~Renderer();

    /// Uploads meshes, materials and textures (mipmapped, colour ones as sRGB). The character may be changed or freed
    /// afterwards. Fails with ErrorCode::input when a mesh's arrays or indices do not fit together.
    [[nodiscard]] Result<CharacterHandle> uploadCharacter(const animation::Character& character);
    /// Frees it; the handle is then invalid.
    void removeCharacter(CharacterHandle character);

    /// The panorama for frames with Sky::environment; null: none, such frames then have the procedural sky. It may be
    /// changed or freed afterwards. Takes some tens of milliseconds.
    void setEnvironment(const Environment* environment);

    /// What was odd about uploaded materials (a texture index without a texture …), a sentence each.
    [[nodiscard]] std::span<const std::string> warnings() const;

    /// Whether the current context can draw frames of that size: no side above what its driver takes, and no more than
    /// kMostPixels, which take 2.4 GB at four samples. Fails with ErrorCode::usage.
    [[nodiscard]] static Result<void> checkSize(Extent size);
    static constexpr long long kMostPixels = 1LL << 26;

    /// Draws a frame of that size into the offscreen target. All palettes of a frame go into one texture buffer, which
    /// holds at least 21,845 joints on any driver (tens of millions on most); characters beyond are left out and
    /// counted in stats().droppedInstances. Items with an invalid handle or a palette of the wrong size are a caller's
    /// bug.
    void draw(const FrameDescription& frame, Extent size);

    /// The last frame, read back; waits for the GPU.
    [[nodiscard]] Image readPixels();
    /// The same into a picture that is reused from frame to frame.
    void readPixels(Image& image);

    /// Copies the last frame to the window's framebuffer (scaled to it when the sizes differ) and leaves the window's
    /// framebuffer bound, ready for the UI to be drawn over it.
    void present(Extent windowFramebuffer);

    /// Draws UI (or anything) over the last frame in the offscreen target, so that a headless editor's picture has its
    /// panels: binds the resolved, single-sampled target and its viewport until the next draw().
    void bindResolvedTarget();

    /// GL name of the last frame's texture (sRGB8_ALPHA8, upside down as GL has it), for panels that show it.
    [[nodiscard]] unsigned int colorTexture() const;

    [[nodiscard]] const FrameStats& stats() const;

    /// Runs the skinning of the vertex shader on one mesh and reads the result back by transform feedback: the proof
    /// that it equals skinVertices(). Of `item`, the character, the palette and the skinning count. `out` holds one
    /// element a vertex of meshes[mesh].
    void skinOnGpu(const CharacterItem& item, int mesh, const SkinnedVertices& out);

  private:
    struct State;
    explicit Renderer(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace lutka::render
