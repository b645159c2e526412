#include "render/gl/renderer_options.hpp"

namespace lutka::render {

RendererOptions rendererOptions(RenderQuality quality, const GlContext& context) {
    constexpr int kSmallShadowMap = 1024;
    const bool fast = quality == RenderQuality::fast || (quality == RenderQuality::automatic && context.isSoftware());
    if (!fast) return {};
    return {.samples = 1,
            .shadowMapSize = kSmallShadowMap,
            .ambientOcclusion = false,
            .levelsOfDetail = true,
            .fastShading = true};
}

}  // namespace lutka::render
