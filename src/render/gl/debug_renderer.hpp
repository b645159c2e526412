#pragma once

#include "core/result.hpp"
#include "render/frame.hpp"
#include "render/gl/render_target.hpp"
#include "render/gl/shader_program.hpp"
#include "render/gl/stream_buffer.hpp"

namespace lutka::render {

/// Draws a frame's line batch and solid batch over its picture: one upload each, one draw call for all lines (what is
/// seen, and faintly what is hidden), three for the solids.
class DebugRenderer {
  public:
    /// `samples` of the picture that it will draw over.
    [[nodiscard]] static Result<DebugRenderer> create(int samples);

    /// The framebuffer of `picture` is bound, its depth is the scene's, the block `Frame` is filled.
    void draw(const FrameDescription& frame, const PictureTarget& picture, FrameStats& stats);

    [[nodiscard]] long long bytes() const { return lineBuffer_.bytes() + solidBuffer_.bytes(); }

  private:
    DebugRenderer();
    void drawSolids(const FrameDescription& frame, FrameStats& stats);
    void drawLines(const FrameDescription& frame, const PictureTarget& picture, FrameStats& stats);

    ShaderProgram lineProgram_;
    ShaderProgram solidProgram_;
    StreamBuffer lineBuffer_;
    StreamBuffer solidBuffer_;
    GlVertexArray lineArray_;
    GlVertexArray solidArray_;
};

}  // namespace lutka::render
