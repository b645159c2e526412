#pragma once

#include "render/gl/gl_context.hpp"

namespace lutka::render {

struct RendererOptions {
    int samples = 4;               ///< Multisampling of the picture, 1 (off) to what the driver offers.
    int shadowMapSize = 2048;      ///< Texels a side, [256, 8192]. More: finer shadow edges.
    bool ambientOcclusion = true;  ///< Off: FrameDescription::ambientOcclusion does nothing.
    bool levelsOfDetail = false;   ///< Figures that are small in the picture are drawn with fewer triangles.
    bool fastShading = false;      ///< A shadow edge of fixed width from few taps.
};

/// How much work a picture is worth.
enum class RenderQuality {
    best,      ///< For pictures to keep: RendererOptions' defaults.
    fast,      ///< For a picture that moves, where a processor draws it.
    automatic  ///< fast on a software rasteriser, else best.
};

[[nodiscard]] RendererOptions rendererOptions(RenderQuality quality, const GlContext& context);

}  // namespace lutka::render
