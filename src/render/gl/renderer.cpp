#include "render/gl/renderer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>

#include "core/assert.hpp"
#include "render/gl/debug_renderer.hpp"
#include "render/gl/pass_timer.hpp"
#include "render/gl/render_target.hpp"
#include "render/gl/scene_renderer.hpp"

namespace lutka::render {

struct Renderer::State {
    State(PictureTarget target, SceneRenderer sceneRenderer, DebugRenderer debugRenderer, ShaderProgram feedbackProgram)
        : scene(std::move(sceneRenderer)),
          debug(std::move(debugRenderer)),
          feedback(std::move(feedbackProgram)),
          picture(std::move(target)) {}

    CharacterStore characters;
    std::vector<std::string> warnings;
    SceneRenderer scene;
    DebugRenderer debug;
    ShaderProgram feedback;
    TexelStream feedbackPalette;
    PictureTarget picture;
    PassTimer timer;
    FrameStats stats;
    bool levelsOfDetail = false;

    [[nodiscard]] GpuMemory memory() const {
        GpuMemory sum;
        for (const auto& character : characters) {
            if (!character) continue;
            sum.meshes += character->meshBytes;
            sum.textures += character->textureBytes;
        }
        scene.addMemory(sum);
        sum.targets += picture.bytes();
        sum.streams += debug.bytes() + feedbackPalette.bytes();
        return sum;
    }

    [[nodiscard]] const GpuCharacter& at(CharacterHandle handle) const {
        LUTKA_ASSERT(handle.valid() && handle.index < static_cast<int>(characters.size()) && characters[handle.index]);
        return *characters[handle.index];
    }
};

Renderer::Renderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

Result<Renderer> Renderer::create(GlContext& context, const RendererOptions& options) {
    context.makeCurrent();
    Result<SceneRenderer> scene = SceneRenderer::create(options);
    if (!scene) return scene.error();
    PictureTarget picture(options.samples);
    Result<DebugRenderer> debug = DebugRenderer::create(picture.samples());
    if (!debug) return debug.error();
    constexpr std::array<const char*, 3> kCaptured = {"skinnedPosition", "skinnedNormal", "skinnedTangent"};
    Result<ShaderProgram> feedback = ShaderProgram::load("skin_feedback.vert", "", {}, kCaptured);
    if (!feedback) return feedback.error();
    auto state = std::make_unique<State>(std::move(picture), std::move(scene).value(), std::move(debug).value(),
                                         std::move(feedback).value());
    state->levelsOfDetail = options.levelsOfDetail;
    return Renderer(std::move(state));
}

Result<CharacterHandle> Renderer::uploadCharacter(const animation::Character& character) {
    Result<GpuCharacter> gpu = makeGpuCharacter(character, state_->levelsOfDetail, state_->warnings);
    if (!gpu) return gpu.error();
    const Result<void> prepared = state_->scene.prepare(gpu.value());
    if (!prepared) return prepared.error();
    state_->characters.push_back(std::make_unique<GpuCharacter>(std::move(gpu).value()));
    return CharacterHandle{static_cast<int>(state_->characters.size()) - 1};
}

void Renderer::removeCharacter(CharacterHandle character) {
    LUTKA_ASSERT(character.valid() && character.index < static_cast<int>(state_->characters.size()));
    state_->characters[character.index].reset();
}

void Renderer::setEnvironment(const Environment* environment) {
    state_->scene.setEnvironment(environment);
}

std::span<const std::string> Renderer::warnings() const {
    return state_->warnings;
}

Result<void> Renderer::checkSize(Extent size) {
    GLint renderbuffer = 0;
    GLint texture = 0;
    std::array<GLint, 2> viewport{};
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &renderbuffer);
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
    const int most = std::min({renderbuffer, texture, viewport[0], viewport[1]});
    if (std::max(size.width, size.height) > most) {
        return Error{ErrorCode::usage,
                     fmt::format("a picture of {} x {} is larger than this driver's {} pixels a side", size.width,
                                 size.height, most),
                     "", "take a smaller picture"};
    }
    if (static_cast<long long>(size.width) * size.height > kMostPixels) {
        return Error{ErrorCode::usage,
                     fmt::format("a picture of {} x {} has more than {} million pixels", size.width, size.height,
                                 kMostPixels / 1000000),
                     "", "take a smaller picture"};
    }
    return {};
}

void Renderer::draw(const FrameDescription& frame, Extent size) {
    LUTKA_ASSERT(size.width > 0 && size.height > 0);
    const auto start = std::chrono::steady_clock::now();
    State& state = *state_;
    state.stats = {};
    state.picture.resize(size);
    state.timer.beginFrame(state.stats);
    state.scene.draw(frame, state.characters, state.picture, state.timer, state.stats);
    if (!frame.lines.empty() || !frame.solids.empty()) {
        state.timer.begin(RenderPass::debug, state.stats);
        state.debug.draw(frame, state.picture, state.stats);
    }
    state.timer.begin(RenderPass::resolve, state.stats);
    state.picture.resolve();
    state.timer.endFrame(state.stats);
    state.scene.giveWarnings(state.warnings);
    state.stats.memory = state.memory();
    const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start;
    state.stats.cpuMs = spent.count();
}

Image Renderer::readPixels() {
    Image image;
    readPixels(image);
    return image;
}

void Renderer::readPixels(Image& image) {
    const Extent size = state_->picture.size();
    image.width = size.width;
    image.height = size.height;
    const std::size_t row = static_cast<std::size_t>(size.width) * 4;
    image.rgba.resize(row * static_cast<std::size_t>(size.height));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, state_->picture.resolvedFramebuffer());
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, size.width, size.height, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
    // GL counts rows from below.
    for (int upper = 0, lower = size.height - 1; upper < lower; ++upper, --lower) {
        std::swap_ranges(image.rgba.begin() + static_cast<std::ptrdiff_t>(row) * upper,
                         image.rgba.begin() + static_cast<std::ptrdiff_t>(row) * (upper + 1),
                         image.rgba.begin() + static_cast<std::ptrdiff_t>(row) * lower);
    }
}

void Renderer::present(Extent windowFramebuffer) {
    const Extent size = state_->picture.size();
    // The bytes are sRGB already, and a window's framebuffer takes them as they are.
    glDisable(GL_FRAMEBUFFER_SRGB);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, state_->picture.resolvedFramebuffer());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glBlitFramebuffer(0, 0, size.width, size.height, 0, 0, windowFramebuffer.width, windowFramebuffer.height,
                      GL_COLOR_BUFFER_BIT, size == windowFramebuffer ? GL_NEAREST : GL_LINEAR);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, windowFramebuffer.width, windowFramebuffer.height);
}

void Renderer::bindResolvedTarget() {
    glDisable(GL_FRAMEBUFFER_SRGB);
    glBindFramebuffer(GL_FRAMEBUFFER, state_->picture.resolvedFramebuffer());
    glViewport(0, 0, state_->picture.size().width, state_->picture.size().height);
}

unsigned int Renderer::colorTexture() const {
    return state_->picture.texture();
}

const FrameStats& Renderer::stats() const {
    return state_->stats;
}

void Renderer::skinOnGpu(const CharacterItem& item, int mesh, const SkinnedVertices& out) {
    const GpuCharacter::Mesh& gpu = state_->at(item.character).meshes[mesh];
    const std::array<std::span<vec3>, 3> spans = {out.positions, out.normals, out.tangents};
    std::vector<animation::SkinMatrix> palette;
    appendPalette(item, palette);
    state_->feedbackPalette.upload(std::span<const animation::SkinMatrix>(palette));
    state_->feedbackPalette.bind(static_cast<int>(TextureUnit::palettes));
    const std::array<GlBuffer, 3> captured = {GlBuffer::create(), GlBuffer::create(), GlBuffer::create()};
    for (GLuint i = 0; i < captured.size(); ++i) {
        LUTKA_ASSERT(spans[i].size() == static_cast<std::size_t>(gpu.vertexCount));
        glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, i, captured[i].name());
        glBufferData(GL_TRANSFORM_FEEDBACK_BUFFER, static_cast<GLsizeiptr>(spans[i].size_bytes()), nullptr,
                     GL_STREAM_READ);
    }
    state_->feedback.use();
    state_->feedback.set("dual", item.skinning == animation::SkinningMethod::dualQuaternion ? 1 : 0);
    glEnable(GL_RASTERIZER_DISCARD);
    glBindVertexArray(gpu.vertexArray.name());
    glBeginTransformFeedback(GL_POINTS);
    glDrawArrays(GL_POINTS, 0, gpu.vertexCount);
    glEndTransformFeedback();
    glDisable(GL_RASTERIZER_DISCARD);
    for (GLuint i = 0; i < captured.size(); ++i) {
        glBindBuffer(GL_TRANSFORM_FEEDBACK_BUFFER, captured[i].name());
        glGetBufferSubData(GL_TRANSFORM_FEEDBACK_BUFFER, 0, static_cast<GLsizeiptr>(spans[i].size_bytes()),
                           spans[i].data());
        glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, i, 0);
    }
}

}  // namespace lutka::render
