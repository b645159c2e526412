#pragma once

#include <span>

#include "render/gl/gl_object.hpp"

namespace lutka::render {

/// A buffer that is filled anew each frame. Its storage is orphaned first, so that the driver never waits for the frame
/// before, and grows by half when it must, so that steady frames allocate nothing of ours.
class StreamBuffer {
  public:
    explicit StreamBuffer(GLenum target) : buffer_(GlBuffer::create()), target_(target) {}

    template <class T>
    void upload(std::span<const T> data) {
        const auto bytes = static_cast<GLsizeiptr>(data.size_bytes());
        glBindBuffer(target_, buffer_.name());
        if (bytes > capacity_) capacity_ = bytes + bytes / 2;
        if (capacity_ == 0) return;
        glBufferData(target_, capacity_, nullptr, GL_STREAM_DRAW);
        if (bytes > 0) glBufferSubData(target_, 0, bytes, data.data());
    }

    [[nodiscard]] GLuint name() const { return buffer_.name(); }
    [[nodiscard]] long long bytes() const { return capacity_; }

  private:
    GlBuffer buffer_;
    GLenum target_;
    GLsizeiptr capacity_ = 0;
};

/// A stream buffer that shaders read as a samplerBuffer of RGBA32F texels.
class TexelStream {
  public:
    TexelStream() : buffer_(GL_TEXTURE_BUFFER), texture_(GlTexture::create()) {}

    template <class T>
    void upload(std::span<const T> data) {
        static_assert(sizeof(T) % 16 == 0, "whole RGBA32F texels");
        buffer_.upload(data);
    }

    void bind(int unit) const {
        glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
        glBindTexture(GL_TEXTURE_BUFFER, texture_.name());
        glTexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, buffer_.name());
    }
    [[nodiscard]] long long bytes() const { return buffer_.bytes(); }

  private:
    StreamBuffer buffer_;
    GlTexture texture_;
};

}  // namespace lutka::render
