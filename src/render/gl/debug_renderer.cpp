#include "render/gl/debug_renderer.hpp"

#include <cstddef>

namespace lutka::render {
namespace {

void floatAttribute(GLuint location, GLint count, GLsizei stride, std::size_t offset) {
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, count, GL_FLOAT, GL_FALSE, stride, attributeOffset(offset));
}

void colorAttribute(GLuint location, GLsizei stride, std::size_t offset) {
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride, attributeOffset(offset));
}

}  // namespace

DebugRenderer::DebugRenderer()
    : lineBuffer_(GL_ARRAY_BUFFER),
      solidBuffer_(GL_ARRAY_BUFFER),
      lineArray_(GlVertexArray::create()),
      solidArray_(GlVertexArray::create()) {
    // A segment is one instance: both its ends are attributes of it.
    glBindVertexArray(lineArray_.name());
    glBindBuffer(GL_ARRAY_BUFFER, lineBuffer_.name());
    constexpr GLsizei kSegment = 2 * sizeof(LineVertex);
    floatAttribute(0, 3, kSegment, offsetof(LineVertex, position));
    colorAttribute(1, kSegment, offsetof(LineVertex, color));
    floatAttribute(2, 3, kSegment, sizeof(LineVertex) + offsetof(LineVertex, position));
    colorAttribute(3, kSegment, sizeof(LineVertex) + offsetof(LineVertex, color));
    for (GLuint location = 0; location < 4; ++location)
        glVertexAttribDivisor(location, 1);

    glBindVertexArray(solidArray_.name());
    glBindBuffer(GL_ARRAY_BUFFER, solidBuffer_.name());
    floatAttribute(0, 3, sizeof(SolidVertex), offsetof(SolidVertex, position));
    floatAttribute(1, 3, sizeof(SolidVertex), offsetof(SolidVertex, normal));
    colorAttribute(2, sizeof(SolidVertex), offsetof(SolidVertex, color));
    glBindVertexArray(0);
}

Result<DebugRenderer> DebugRenderer::create(int samples) {
    DebugRenderer renderer;
    const std::vector<std::string> defines(samples > 1 ? 1 : 0, "MULTISAMPLED");
    Result<ShaderProgram> lines = ShaderProgram::load("line.vert", "line.frag", defines);
    if (!lines) return lines.error();
    Result<ShaderProgram> solids = ShaderProgram::load("solid.vert", "solid.frag");
    if (!solids) return solids.error();
    renderer.lineProgram_ = std::move(lines).value();
    renderer.solidProgram_ = std::move(solids).value();
    return renderer;
}

void DebugRenderer::draw(const FrameDescription& frame, const PictureTarget& picture, FrameStats& stats) {
    const int before = stats.drawCalls;
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    if (!frame.solids.empty()) drawSolids(frame, stats);
    if (!frame.lines.empty()) drawLines(frame, picture, stats);
    stats.debugDrawCalls = stats.drawCalls - before;
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_TRUE);
}

void DebugRenderer::drawSolids(const FrameDescription& frame, FrameStats& stats) {
    const std::span<const SolidVertex> vertices(frame.solids.vertices);
    solidBuffer_.upload(vertices);
    ++stats.debugUploads;
    stats.uploadedBytes += static_cast<long long>(vertices.size_bytes());
    glEnable(GL_CULL_FACE);
    glBindVertexArray(solidArray_.name());
    solidProgram_.use();
    const auto drawOnce = [&](float opacity) {
        solidProgram_.set("opacity", opacity);
        glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices.size()));
        ++stats.drawCalls;
        stats.triangles += static_cast<long long>(vertices.size() / 3);
    };
    // What the scene hides, before the solids' own depth comes in.
    glDepthMask(GL_FALSE);
    if (frame.hiddenSolidOpacity > 0.0F) {
        glDepthFunc(GL_GREATER);
        drawOnce(frame.hiddenSolidOpacity);
    }
    // Depth first, then colour where it is the nearest: shapes that overlap do not add up.
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LEQUAL);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    drawOnce(1.0F);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_FALSE);
    drawOnce(1.0F);
}

void DebugRenderer::drawLines(const FrameDescription& frame, const PictureTarget& picture, FrameStats& stats) {
    const std::span<const LineVertex> vertices(frame.lines.vertices);
    lineBuffer_.upload(vertices);
    ++stats.debugUploads;
    stats.uploadedBytes += static_cast<long long>(vertices.size_bytes());
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
    picture.bindWithoutDepth();
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(TextureUnit::depthMap));
    glBindTexture(picture.samples() > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D, picture.depthTexture());
    glBindVertexArray(lineArray_.name());
    lineProgram_.use();
    lineProgram_.set("lineWidth", frame.lineWidth);
    lineProgram_.set("hiddenOpacity", frame.hiddenLineOpacity);
    lineProgram_.set("samples", picture.samples());
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(vertices.size() / 2));
    ++stats.drawCalls;
    stats.triangles += static_cast<long long>(vertices.size());
    glEnable(GL_DEPTH_TEST);
    picture.bindForDrawing();
}

}  // namespace lutka::render
