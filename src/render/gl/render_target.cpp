#include "render/gl/render_target.hpp"

#include <algorithm>

#include "core/assert.hpp"

namespace lutka::render {
namespace {

void setSampling(GLint filter, GLint wrap) {
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap);
}

long long areaOf(Extent size) {
    return static_cast<long long>(size.width) * size.height;
}

void checkComplete() {
    LUTKA_ASSERT(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE);
}

// Texture bindings of unit 0 are free between draws.
void bindForSetup(GLuint texture) {
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, texture);
}

}  // namespace

PictureTarget::PictureTarget(int samples)
    : samples_(samples),
      multisampled_(GlFramebuffer::create()),
      withoutDepth_(GlFramebuffer::create()),
      color_(GlRenderbuffer::create()),
      depth_(GlTexture::create()),
      resolved_(GlFramebuffer::create()),
      texture_(GlTexture::create()) {
    GLint most = 1;
    glGetIntegerv(GL_MAX_SAMPLES, &most);
    samples_ = std::clamp(samples_, 1, std::max(most, 1));
}

void PictureTarget::resize(Extent size) {
    if (size == size_) return;
    size_ = size;
    const GLsizei samples = samples_ > 1 ? samples_ : 0;
    glBindRenderbuffer(GL_RENDERBUFFER, color_.name());
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_SRGB8_ALPHA8, size.width, size.height);
    const GLenum depthTarget = samples > 0 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D;
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(depthTarget, depth_.name());
    if (samples > 0) {
        glTexImage2DMultisample(depthTarget, samples, GL_DEPTH_COMPONENT24, size.width, size.height, GL_TRUE);
    } else {
        glTexImage2D(depthTarget, 0, GL_DEPTH_COMPONENT24, size.width, size.height, 0, GL_DEPTH_COMPONENT,
                     GL_UNSIGNED_INT, nullptr);
        setSampling(GL_NEAREST, GL_CLAMP_TO_EDGE);
    }
    for (const GlFramebuffer* framebuffer : {&multisampled_, &withoutDepth_}) {
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer->name());
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_.name());
        checkComplete();
    }
    glBindFramebuffer(GL_FRAMEBUFFER, multisampled_.name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, depthTarget, depth_.name(), 0);
    checkComplete();

    bindForSetup(texture_.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, size.width, size.height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    setSampling(GL_LINEAR, GL_CLAMP_TO_EDGE);
    glBindFramebuffer(GL_FRAMEBUFFER, resolved_.name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.name(), 0);
    checkComplete();
}

void PictureTarget::bindForDrawing() const {
    glBindFramebuffer(GL_FRAMEBUFFER, multisampled_.name());
    glViewport(0, 0, size_.width, size_.height);
}

void PictureTarget::bindWithoutDepth() const {
    glBindFramebuffer(GL_FRAMEBUFFER, withoutDepth_.name());
}

// Colour and depth take four bytes each; drivers store 24 bits of depth in 32.
long long PictureTarget::bytes() const {
    constexpr long long kColorAndDepth = 8;
    constexpr long long kResolved = 4;
    return areaOf(size_) * (kColorAndDepth * samples_ + kResolved);
}

void PictureTarget::resolve() const {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, multisampled_.name());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.name());
    glBlitFramebuffer(0, 0, size_.width, size_.height, 0, 0, size_.width, size_.height, GL_COLOR_BUFFER_BIT,
                      GL_NEAREST);
}

long long DepthTarget::bytes() const {
    return areaOf(size_) * 4;
}

long long ChannelTarget::bytes() const {
    return areaOf(size_);
}

DepthTarget::DepthTarget(Use use) : use_(use), framebuffer_(GlFramebuffer::create()), texture_(GlTexture::create()) {}

void DepthTarget::resize(Extent size) {
    if (size == size_) return;
    size_ = size;
    bindForSetup(texture_.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, size.width, size.height, 0, GL_DEPTH_COMPONENT,
                 GL_UNSIGNED_INT, nullptr);
    if (use_ == Use::shadow) {
        setSampling(GL_LINEAR, GL_CLAMP_TO_EDGE);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    } else {
        setSampling(GL_NEAREST, GL_CLAMP_TO_EDGE);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture_.name(), 0);
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
    checkComplete();
}

void DepthTarget::bindForDrawing() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glViewport(0, 0, size_.width, size_.height);
}

ChannelTarget::ChannelTarget() : framebuffer_(GlFramebuffer::create()), texture_(GlTexture::create()) {}

void ChannelTarget::resize(Extent size) {
    if (size == size_) return;
    size_ = size;
    bindForSetup(texture_.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, size.width, size.height, 0, GL_RED, GL_UNSIGNED_BYTE, nullptr);
    setSampling(GL_LINEAR, GL_CLAMP_TO_EDGE);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.name(), 0);
    checkComplete();
}

void ChannelTarget::bindForDrawing() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glViewport(0, 0, size_.width, size_.height);
}

}  // namespace lutka::render
