#pragma once

#include <array>
#include <vector>

#include "core/math.hpp"
#include "render/extent.hpp"
#include "render/frame.hpp"
#include "render/shadow_fit.hpp"

namespace lutka::render {

inline constexpr int kMaxLocalLights = 8;

/// The uniform block `Frame` of assets/shaders/frame.glsl, which says what each member means; std140 layout.
struct FrameUniforms {
    struct Light {
        vec4 positionRange{0};
        vec4 directionCosine{0};
        vec4 colorCosine{0};
    };
    mat4 clipFromWorld{1};
    mat4 viewFromWorld{1};
    mat4 worldFromClip{1};
    mat4 shadowFromWorld{1};
    vec4 eye{0};
    vec4 forward{0};
    vec4 sunDirection{0};
    vec4 sunColor{0};
    vec4 shadowTexel{0};
    vec4 skyZenith{0};
    vec4 skyHorizon{0};
    vec4 skyGround{0};
    vec4 viewport{0};
    vec4 floorColor{0};
    vec4 floorGrid{0};
    vec4 target{0};
    vec4 backgroundTop{0};
    vec4 backgroundHorizon{0};
    vec4 backgroundBottom{0};
    vec4 environment{0};  ///< Set by the renderer, which has the environment.
    std::array<vec4, 9> environmentDiffuse{};
    std::array<int, 4> counts{};
    std::array<Light, kMaxLocalLights> localLights{};
};
static_assert(sizeof(FrameUniforms) == 4 * 64 + 26 * 16 + kMaxLocalLights * 48);

/// One instance of a character or prop as assets/shaders/instance.glsl reads it.
struct InstanceTexels {
    vec4 worldRows[3];
    vec4 color{1};     ///< Characters: tint and opacity. Props: linear colour.
    vec4 measures{0};  ///< Characters: highlight, linear. Props: radius, half length, roughness, checker size.
    /// Characters: first palette joint, highlighted joint, 1 for dual quaternions. Props: half extents, checkerInWorld.
    vec4 extentOrJoint{0};
};
static_assert(sizeof(InstanceTexels) == 6 * 16);

/// All that a frame's description fixes once for all shaders.
[[nodiscard]] FrameUniforms makeFrameUniforms(const FrameDescription& frame, Extent size, const ShadowFit& shadow,
                                              int shadowMapSize);

/// Appends a character's palette as assets/shaders/skinning.glsl reads it by the item's skinning: three texels a joint,
/// the matrix's rows, or the dual quaternion's two halves and one without meaning.
void appendPalette(const CharacterItem& item, std::vector<animation::SkinMatrix>& palettes);

/// Fills a TexelStream's element.
[[nodiscard]] InstanceTexels makeInstance(const CharacterItem& item, int firstPaletteJoint);
[[nodiscard]] InstanceTexels makeInstance(const PropItem& item);

}  // namespace lutka::render
