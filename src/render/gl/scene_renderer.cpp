#include "render/gl/scene_renderer.hpp"

#include <algorithm>
#include <array>

#include "core/assert.hpp"

namespace lutka::render {
namespace {

using animation::Material;

unsigned featuresOf(const GpuCharacter& character, const GpuCharacter::Mesh& mesh) {
    const Material& material = character.materials[mesh.material];
    unsigned features = 0;
    if (mesh.colored) features |= kVertexColors;
    if (material.baseColorTexture != Material::kNoTexture) features |= kBaseTexture;
    if (material.metallicRoughnessTexture != Material::kNoTexture) features |= kMetallicRoughnessTexture;
    if (material.normalTexture != Material::kNoTexture) features |= kNormalTexture;
    if (material.occlusionTexture != Material::kNoTexture) features |= kOcclusionTexture;
    if (material.emissiveTexture != Material::kNoTexture) features |= kEmissiveTexture;
    if (material.alphaMode == Material::AlphaMode::mask) features |= kAlphaMask;
    return features;
}

void bindTexture(TextureUnit unit, GLuint texture) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_2D, texture);
}

void bindMaterialTexture(const GpuCharacter& character, TextureUnit unit, int texture) {
    if (texture != Material::kNoTexture) bindTexture(unit, character.textures[texture].name());
}

void setMaterial(const ShaderProgram& program, const GpuCharacter& character, const Material& material) {
    program.set("baseColor", material.baseColor);
    program.set("emissive", material.emissive);
    program.set("metallic", material.metallic);
    program.set("roughness", material.roughness);
    program.set("alphaCutoff", material.alphaCutoff);
    bindMaterialTexture(character, TextureUnit::baseColor, material.baseColorTexture);
    bindMaterialTexture(character, TextureUnit::metallicRoughness, material.metallicRoughnessTexture);
    bindMaterialTexture(character, TextureUnit::normal, material.normalTexture);
    bindMaterialTexture(character, TextureUnit::occlusion, material.occlusionTexture);
    bindMaterialTexture(character, TextureUnit::emissive, material.emissiveTexture);
}

// All state that a pass relies on and others (a UI's back end too) may have left otherwise.
void setBaseState() {
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_POLYGON_OFFSET_FILL);
    glVertexAttrib4f(kColorAttribute, 1.0F, 1.0F, 1.0F, 1.0F);
    glDisable(GL_RASTERIZER_DISCARD);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_MULTISAMPLE);
    glEnable(GL_FRAMEBUFFER_SRGB);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glCullFace(GL_BACK);
    glFrontFace(GL_CCW);
    glBlendEquation(GL_FUNC_ADD);
    // The picture stays opaque whatever is blended over it.
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    for (GLuint unit = 0; unit <= static_cast<GLuint>(TextureUnit::panorama); ++unit)
        glBindSampler(unit, 0);
}

std::size_t mostJointsOfTextureBuffer() {
    constexpr GLint kTexelsAJoint = 3;
    GLint texels = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
    return static_cast<std::size_t>(texels / kTexelsAJoint);
}

GlTexture makeWhite() {
    GlTexture texture = GlTexture::create();
    bindTexture(TextureUnit::baseColor, texture.name());
    const std::array<GLubyte, 4> white = {255, 255, 255, 255};
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, white.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

}  // namespace

SceneRenderer::SceneRenderer(const RendererOptions& options)
    : shadowMapSize_(std::clamp(options.shadowMapSize, 256, 8192)),
      mostJoints_(mostJointsOfTextureBuffer()),
      occlusionAllowed_(options.ambientOcclusion),
      always_((options.fastShading ? kFastShading : 0U) | (options.ambientOcclusion ? 0U : kUnoccluded)),
      noVertices_(GlVertexArray::create()),
      white_(makeWhite()),
      shadowMap_(DepthTarget::Use::shadow),
      uncompared_(GlSampler::create()),
      smallDepth_(DepthTarget::Use::plain),
      uniformBuffer_(GL_UNIFORM_BUFFER) {
    glSamplerParameteri(uncompared_.name(), GL_TEXTURE_COMPARE_MODE, GL_NONE);
    glSamplerParameteri(uncompared_.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glSamplerParameteri(uncompared_.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glSamplerParameteri(uncompared_.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glSamplerParameteri(uncompared_.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

Result<SceneRenderer> SceneRenderer::create(const RendererOptions& options) {
    SceneRenderer renderer(options);
    struct Wanted {
        ShaderProgram& program;
        const char* vertexFile;
        const char* fragmentFile;
        std::vector<std::string> defines;
    };
    const std::array<Wanted, 6> all = {{
        {renderer.characterDepth_, "character_depth.vert", "depth.frag", {}},
        {renderer.characterDepthMasked_, "character_depth.vert", "depth.frag", {"ALPHA_MASK"}},
        {renderer.propDepth_, "prop_depth.vert", "depth.frag", {}},
        {renderer.floorDepth_, "floor.vert", "depth.frag", {}},
        {renderer.occlusion_, "screen.vert", "occlusion.frag", {}},
        {renderer.occlusionBlur_, "screen.vert", "occlusion_blur.frag", {}},
    }};
    for (const Wanted& wanted : all) {
        Result<ShaderProgram> loaded = ShaderProgram::load(wanted.vertexFile, wanted.fragmentFile, wanted.defines);
        if (!loaded) return loaded.error();
        wanted.program = std::move(loaded).value();
    }
    for (ProgramVariants* lit : {&renderer.propPrograms_, &renderer.floorPrograms_, &renderer.backgroundPrograms_}) {
        const Result<void> made = lit->prepare(renderer.always_);
        if (!made) return made.error();
    }
    return renderer;
}

Result<void> SceneRenderer::prepare(const GpuCharacter& character) {
    for (const GpuCharacter::Mesh& mesh : character.meshes) {
        const Result<void> made = characterPrograms_.prepare(featuresOf(character, mesh) | always_);
        if (!made) return made.error();
    }
    return {};
}

void SceneRenderer::setEnvironment(const Environment* environment) {
    environment_.reset();
    if (environment != nullptr) environment_.emplace(*environment);
}

void SceneRenderer::giveWarnings(std::vector<std::string>& warnings) {
    for (std::string& warning : warnings_)
        warnings.push_back(std::move(warning));
    warnings_.clear();
}

void SceneRenderer::addMemory(GpuMemory& memory) const {
    memory.meshes += propMeshes_.bytes();
    if (environment_) memory.textures += environment_->bytes();
    memory.targets += shadowMap_.bytes() + smallDepth_.bytes() + noisyOcclusion_.bytes() + smoothOcclusion_.bytes();
    memory.streams += uniformBuffer_.bytes() + palettes_.bytes() + instances_.bytes();
}

void SceneRenderer::draw(const FrameDescription& frame, const CharacterStore& characters, const PictureTarget& picture,
                         PassTimer& timer, FrameStats& stats) {
    timer.begin(RenderPass::prepare, stats);
    setBaseState();
    const bool environment = frame.sky.environment && environment_;
    if (environment) environment_->bind();
    lighting_ = (environment ? kEnvironmentMap : 0U) | (frame.localLights.empty() ? 0U : kLocalLights) |
                (frame.sun.castsShadow ? 0U : kUnshadowed);
    upload(frame, characters, picture.size(), stats);
    if (frame.sun.castsShadow) {
        timer.begin(RenderPass::shadow, stats);
        drawShadowMap(characters, stats);
    }
    bindTexture(TextureUnit::shadowMap, shadowMap_.texture());
    bindTexture(TextureUnit::shadowDepth, shadowMap_.texture());
    glBindSampler(static_cast<GLuint>(TextureUnit::shadowDepth), uncompared_.name());
    const bool occlusion = frame.ambientOcclusion && occlusionAllowed_;
    if (occlusion) {
        timer.begin(RenderPass::occlusion, stats);
        drawOcclusion(frame, characters, picture.size(), stats);
    }
    bindTexture(TextureUnit::occlusionMap, occlusion ? smoothOcclusion_.texture() : white_.name());
    timer.begin(RenderPass::opaque, stats);
    picture.bindForDrawing();
    glClear(GL_DEPTH_BUFFER_BIT);
    drawOpaque(frame, characters, stats);
    timer.begin(RenderPass::translucent, stats);
    drawTranslucent(characters, stats);
}

void SceneRenderer::upload(const FrameDescription& frame, const CharacterStore& characters, Extent size,
                           FrameStats& stats) {
    const mat4 clip = clipFromWorld(frame.camera, size.aspect());
    orthographic_ = frame.camera.orthographic;
    metresAPixel_ = 2.0F / (clipFromView(frame.camera, size.aspect())[1][1] * static_cast<float>(size.height));
    list_.build(frame, clip, mostJoints_, [&](int index) {
        LUTKA_ASSERT(index >= 0 && index < static_cast<int>(characters.size()) && characters[index]);
        return std::span<const BoundingSphere>(characters[index]->jointBounds);
    });
    shadowFit_ = fitShadow(list_.casters(), frame.sun.directionToLight, frame.camera, shadowMapSize_);
    uniforms_ = makeFrameUniforms(frame, size, shadowFit_, shadowMapSize_);
    if (environment_) {
        uniforms_.environment =
            vec4(frame.sky.intensity, environment_->lastLevel(), frame.sky.intensity * environment_->panoramaGain(),
                 frame.sky.environmentBackground ? 1.0F : 0.0F);
        for (std::size_t i = 0; i < uniforms_.environmentDiffuse.size(); ++i)
            uniforms_.environmentDiffuse[i] = vec4(environment_->diffuse()[i], 0.0F);
    }
    shadowMap_.resize({shadowMapSize_, shadowMapSize_});

    uniformBuffer_.upload(std::span<const FrameUniforms>(&uniforms_, 1));
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, uniformBuffer_.name());
    palettes_.upload(list_.palettes());
    instances_.upload(list_.instances());
    palettes_.bind(static_cast<int>(TextureUnit::palettes));
    instances_.bind(static_cast<int>(TextureUnit::instances));
    stats.uploadedBytes +=
        static_cast<long long>(sizeof(FrameUniforms) + list_.palettes().size_bytes() + list_.instances().size_bytes());
    stats.instances = static_cast<int>(frame.characters.size()) - list_.culled() - list_.dropped();
    stats.droppedInstances = list_.dropped();
    stats.culledInstances = list_.culled();
}

void SceneRenderer::drawShadowMap(const CharacterStore& characters, FrameStats& stats) {
    shadowMap_.bindForDrawing();
    glClear(GL_DEPTH_BUFFER_BIT);
    // Casters between the light and the map's near plane are pressed onto it instead of being cut away.
    glEnable(GL_DEPTH_CLAMP);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1.2F, 2.0F);
    const int before = stats.drawCalls;
    intoShadowMap_ = true;
    drawDepth(list_.shadow(), characters, shadowFit_.lightFromWorld, true, stats);
    intoShadowMap_ = false;
    stats.shadowDrawCalls += stats.drawCalls - before;
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDisable(GL_DEPTH_CLAMP);
}

void SceneRenderer::drawOcclusion(const FrameDescription& frame, const CharacterStore& characters, Extent size,
                                  FrameStats& stats) {
    const Extent half{(size.width + 1) / 2, (size.height + 1) / 2};
    smallDepth_.resize(half);
    noisyOcclusion_.resize(half);
    smoothOcclusion_.resize(half);

    smallDepth_.bindForDrawing();
    glClear(GL_DEPTH_BUFFER_BIT);
    drawDepth(list_.opaque(), characters, uniforms_.clipFromWorld, false, stats);
    if (frame.floor.visible) {
        floorDepth_.use();
        floorDepth_.set("depthFromWorld", uniforms_.clipFromWorld);
        drawFloor(stats);
    }
    glDisable(GL_DEPTH_TEST);
    bindTexture(TextureUnit::depthMap, smallDepth_.texture());
    bindTexture(TextureUnit::noisyMap, noisyOcclusion_.texture());
    const vec2 depthSize(half.width, half.height);
    const mat4 clip = clipFromView(frame.camera, size.aspect());
    const vec4 projection(clip[0][0], clip[1][1], clip[2][2], clip[3][2]);
    occlusion_.use();
    occlusion_.set("depthSize", depthSize);
    occlusion_.set("projection", projection);
    occlusion_.set("radiusPixels", 0.5F * clip[1][1] * depthSize.y);
    noisyOcclusion_.bindForDrawing();
    drawScreen(stats);
    occlusionBlur_.use();
    occlusionBlur_.set("depthSize", depthSize);
    occlusionBlur_.set("projection", projection);
    smoothOcclusion_.bindForDrawing();
    drawScreen(stats);
    glEnable(GL_DEPTH_TEST);
}

void SceneRenderer::drawOpaque(const FrameDescription& frame, const CharacterStore& characters, FrameStats& stats) {
    const int before = stats.drawCalls;
    drawCharacters(list_.opaque().characters, characters, Meshes::opaque, stats);
    stats.characterDrawCalls += stats.drawCalls - before;
    glDisable(GL_CULL_FACE);
    drawLitProps(list_.opaque().props, stats);
    const bool fromBelow = frame.floor.visible && eyeOf(frame.camera).y < frame.floor.height;
    if (fromBelow) drawBackground(stats);
    if (frame.floor.visible) {
        if (fromBelow) glEnable(GL_BLEND);
        // Behind what lies in its plane: contact lines and flat props win.
        glEnable(GL_POLYGON_OFFSET_FILL);
        glPolygonOffset(0.5F, 4.0F);
        const ShaderProgram& program = floorPrograms_.at(always_, lighting_, warnings_);
        program.use();
        program.set("depthFromWorld", uniforms_.clipFromWorld);
        drawFloor(stats);
        glDisable(GL_POLYGON_OFFSET_FILL);
        glDisable(GL_BLEND);
    }
    if (!fromBelow) drawBackground(stats);
}

// At the far plane, so that it only fills what nothing else has covered.
void SceneRenderer::drawBackground(FrameStats& stats) {
    backgroundPrograms_.at(always_, lighting_ & kEnvironmentMap, warnings_).use();
    glDepthMask(GL_FALSE);
    drawScreen(stats);
    glDepthMask(GL_TRUE);
}

void SceneRenderer::drawFloor(FrameStats& stats) {
    glBindVertexArray(noVertices_.name());
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    ++stats.drawCalls;
    stats.triangles += 2;
}

void SceneRenderer::drawTranslucent(const CharacterStore& characters, FrameStats& stats) {
    glEnable(GL_BLEND);
    glDepthMask(GL_FALSE);
    // Front faces only: through clear walls one would see each twice.
    glEnable(GL_CULL_FACE);
    drawLitProps(list_.translucent().props, stats);
    int before = stats.drawCalls;
    drawCharacters(list_.opaque().characters, characters, Meshes::blended, stats);
    stats.characterDrawCalls += stats.drawCalls - before;
    if (!list_.translucent().characters.empty()) {
        // Their depth first, so that only the nearest surface of a figure is blended.
        glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        glDepthMask(GL_TRUE);
        drawCharacterDepth(list_.translucent().characters, characters, uniforms_.clipFromWorld, true, stats);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        glDepthMask(GL_FALSE);
        before = stats.drawCalls;
        drawCharacters(list_.translucent().characters, characters, Meshes::all, stats);
        stats.characterDrawCalls += stats.drawCalls - before;
    }
    glDepthMask(GL_TRUE);
}

void SceneRenderer::drawDepth(const DrawList::Pass& pass, const CharacterStore& characters, const mat4& depthFromWorld,
                              bool all, FrameStats& stats) {
    drawCharacterDepth(pass.characters, characters, depthFromWorld, all, stats);
    propDepth_.use();
    propDepth_.set("depthFromWorld", depthFromWorld);
    drawProps(propDepth_, pass.props, stats);
}

void SceneRenderer::drawCharacterDepth(std::span<const DrawList::Batch> batches, const CharacterStore& characters,
                                       const mat4& depthFromWorld, bool all, FrameStats& stats) {
    for (const ShaderProgram* program : {&characterDepth_, &characterDepthMasked_}) {
        program->use();
        program->set("depthFromWorld", depthFromWorld);
    }
    glDisable(GL_CULL_FACE);
    for (const DrawList::Batch& batch : batches) {
        const GpuCharacter& character = *characters[batch.what];
        for (const GpuCharacter::Mesh& mesh : character.meshes) {
            const Material& material = character.materials[mesh.material];
            const bool blended = material.alphaMode == Material::AlphaMode::blend;
            if (blended && !all) continue;
            const bool masked = material.alphaMode != Material::AlphaMode::opaque;
            const ShaderProgram& program = masked ? characterDepthMasked_ : characterDepth_;
            program.use();
            if (masked) {
                setMaterial(program, character, material);
                const bool untextured = material.baseColorTexture == Material::kNoTexture;
                if (untextured) bindTexture(TextureUnit::baseColor, white_.name());
                // A blended mesh casts the shadow of what is more than half opaque.
                if (blended) program.set("alphaCutoff", 0.5F);
            }
            drawMesh(program, mesh, batch, stats);
        }
    }
}

// Metres that nobody sees: of the nearest instance in the picture, or under the shadow's filter.
float SceneRenderer::coarsestCell(const DrawList::Batch& batch) const {
    constexpr float kPixels = 2.0F;
    constexpr float kTexels = 2.0F;
    constexpr float kNearest = 0.05F;  // metres
    if (intoShadowMap_) return kTexels * shadowFit_.metresPerTexel;
    return kPixels * metresAPixel_ * (orthographic_ ? 1.0F : std::max(batch.nearest, kNearest));
}

void SceneRenderer::drawMesh(const ShaderProgram& program, const GpuCharacter::Mesh& mesh, const DrawList::Batch& batch,
                             FrameStats& stats) const {
    program.set("firstInstance", batch.firstInstance);
    glBindVertexArray(mesh.vertexArray.name());
    const GpuCharacter::Detail& detail = mesh.detailFor(coarsestCell(batch));
    glDrawElementsInstanced(GL_TRIANGLES, detail.indexCount, GL_UNSIGNED_INT, attributeOffset(detail.firstByte),
                            batch.count);
    ++stats.drawCalls;
    stats.triangles += static_cast<long long>(detail.indexCount) / 3 * batch.count;
}

void SceneRenderer::drawCharacters(std::span<const DrawList::Batch> batches, const CharacterStore& characters,
                                   Meshes which, FrameStats& stats) {
    for (const DrawList::Batch& batch : batches) {
        const GpuCharacter& character = *characters[batch.what];
        for (const GpuCharacter::Mesh& mesh : character.meshes) {
            const Material& material = character.materials[mesh.material];
            const bool blended = material.alphaMode == Material::AlphaMode::blend;
            if (which != Meshes::all && blended != (which == Meshes::blended)) continue;
            const ShaderProgram& program =
                characterPrograms_.at(featuresOf(character, mesh) | always_, lighting_, warnings_);
            program.use();
            setMaterial(program, character, material);
            program.set("blended", which == Meshes::opaque ? 0.0F : 1.0F);
            if (material.doubleSided) {
                glDisable(GL_CULL_FACE);
            } else {
                glEnable(GL_CULL_FACE);
            }
            drawMesh(program, mesh, batch, stats);
        }
    }
}

void SceneRenderer::drawLitProps(std::span<const DrawList::Batch> batches, FrameStats& stats) {
    if (batches.empty()) return;
    const ShaderProgram& program = propPrograms_.at(always_, lighting_, warnings_);
    program.use();
    drawProps(program, batches, stats);
}

void SceneRenderer::drawProps(const ShaderProgram& program, std::span<const DrawList::Batch> batches,
                              FrameStats& stats) {
    for (const DrawList::Batch& batch : batches) {
        const auto kind = static_cast<ShapeKind>(batch.what);
        program.set("firstInstance", batch.firstInstance);
        propMeshes_.draw(kind, batch.count);
        ++stats.drawCalls;
        stats.triangles += static_cast<long long>(propMeshes_.triangleCount(kind)) * batch.count;
    }
}

void SceneRenderer::drawScreen(FrameStats& stats) {
    glBindVertexArray(noVertices_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    ++stats.drawCalls;
    ++stats.triangles;
}

}  // namespace lutka::render
