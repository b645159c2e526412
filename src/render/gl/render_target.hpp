#pragma once

#include "core/result.hpp"
#include "render/extent.hpp"
#include "render/gl/gl_object.hpp"

namespace lutka::render {

/// Where the picture is made: a multisampled colour and depth buffer, and the texture that it is resolved into. sRGB.
class PictureTarget {
  public:
    explicit PictureTarget(int samples);

    /// Makes the buffers anew when the size has changed.
    void resize(Extent size);
    void bindForDrawing() const;
    /// The same colours without a depth buffer, so that shaders may read depthTexture() while they draw.
    void bindWithoutDepth() const;
    void resolve() const;

    /// Bytes of the buffers, samples counted.
    [[nodiscard]] long long bytes() const;
    [[nodiscard]] int samples() const { return samples_; }
    /// GL_TEXTURE_2D_MULTISAMPLE, or GL_TEXTURE_2D with one sample.
    [[nodiscard]] GLuint depthTexture() const { return depth_.name(); }

    [[nodiscard]] Extent size() const { return size_; }
    [[nodiscard]] GLuint resolvedFramebuffer() const { return resolved_.name(); }
    [[nodiscard]] GLuint texture() const { return texture_.name(); }

  private:
    int samples_;
    Extent size_{0, 0};
    GlFramebuffer multisampled_;
    GlFramebuffer withoutDepth_;
    GlRenderbuffer color_;
    GlTexture depth_;
    GlFramebuffer resolved_;
    GlTexture texture_;
};

/// A depth texture to draw into: the shadow map (compared when sampled) or the depth of a small picture.
class DepthTarget {
  public:
    enum class Use { shadow, plain };
    explicit DepthTarget(Use use);

    void resize(Extent size);
    void bindForDrawing() const;

    [[nodiscard]] Extent size() const { return size_; }
    [[nodiscard]] GLuint texture() const { return texture_.name(); }
    [[nodiscard]] long long bytes() const;

  private:
    Use use_;
    Extent size_{0, 0};
    GlFramebuffer framebuffer_;
    GlTexture texture_;
};

/// A texture of one 8-bit channel to draw into, for ambient occlusion.
class ChannelTarget {
  public:
    ChannelTarget();

    void resize(Extent size);
    void bindForDrawing() const;

    [[nodiscard]] GLuint texture() const { return texture_.name(); }
    [[nodiscard]] long long bytes() const;

  private:
    Extent size_{0, 0};
    GlFramebuffer framebuffer_;
    GlTexture texture_;
};

}  // namespace lutka::render
