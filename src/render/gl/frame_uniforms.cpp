#include "render/gl/frame_uniforms.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace lutka::render {
namespace {

// From clip space [-1, 1]³ to texture space [0, 1]³.
mat4 textureFromClip() {
    mat4 m(0.5F);
    m[3] = vec4(0.5F, 0.5F, 0.5F, 1.0F);
    return m;
}

void setRows(InstanceTexels& texels, const RigidTransform& worldFromItem) {
    const mat3 r = glm::mat3_cast(worldFromItem.rotation);
    for (int row = 0; row < 3; ++row)
        texels.worldRows[row] = {r[0][row], r[1][row], r[2][row], worldFromItem.translation[row]};
}

// Metres: wider ones would need more taps than a software rasteriser can afford.
constexpr float kWidestPenumbra = 0.045F;

FrameUniforms::Light packed(const LocalLight& light) {
    // A point light is a spot whose cone holds every direction.
    const bool everywhere = light.outerAngle >= kPi;
    const float outer = everywhere ? -2.0F : std::cos(light.outerAngle);
    const float inner = everywhere ? -1.5F : std::cos(std::min(light.innerAngle, light.outerAngle - 1e-3F));
    return {vec4(light.position, light.range), vec4(glm::normalize(light.direction), outer),
            vec4(light.color * light.intensity, inner)};
}

}  // namespace

FrameUniforms makeFrameUniforms(const FrameDescription& frame, Extent size, const ShadowFit& shadow,
                                int shadowMapSize) {
    FrameUniforms u;
    const Camera& camera = frame.camera;
    u.viewFromWorld = viewFromWorld(camera);
    u.clipFromWorld = clipFromWorld(camera, size.aspect());
    u.worldFromClip = glm::inverse(u.clipFromWorld);
    u.shadowFromWorld = textureFromClip() * shadow.lightFromWorld;
    u.eye = vec4(eyeOf(camera), camera.orthographic ? 1.0F : 0.0F);
    u.forward = vec4(forwardOf(camera), frame.exposure);
    u.sunDirection = vec4(glm::normalize(frame.sun.directionToLight), frame.sun.castsShadow ? 1.0F : 0.0F);
    const float side = shadow.metresPerTexel * static_cast<float>(shadowMapSize);
    u.sunColor = vec4(frame.sun.color * frame.sun.intensity, side / shadow.depthMetres);
    const float penumbra = std::tan(std::clamp(frame.sun.angularRadius, 0.0F, 0.2F)) * shadow.depthMetres / side;
    u.shadowTexel = vec4(shadow.metresPerTexel, 1.0F / static_cast<float>(shadowMapSize), penumbra,
                         std::min(kWidestPenumbra / side, 0.03F));
    u.skyZenith = vec4(frame.sky.zenith * frame.sky.intensity, 0);
    u.skyHorizon = vec4(frame.sky.horizon * frame.sky.intensity, 0);
    u.skyGround = vec4(frame.sky.ground * frame.sky.intensity, 0);
    const vec2 extent(size.width, size.height);
    u.viewport = vec4(extent, 1.0F / extent);
    u.floorColor = vec4(vec3(toLinear(frame.floor.color)), frame.floor.height);
    // Seen from afar the floor must reach further, or it would be a small disc.
    const float fade = std::max(frame.floor.fadeDistance, 3.5F * camera.distance);
    u.floorGrid = vec4(frame.floor.gridSpacing, frame.floor.gridStrength, fade, frame.floor.visible ? 1.0F : 0.0F);
    u.target = vec4(camera.target, frame.ambientOcclusion ? 1.0F : 0.0F);
    u.backgroundTop = toLinear(frame.background.top);
    u.backgroundHorizon = toLinear(frame.background.horizon);
    u.backgroundBottom = toLinear(frame.background.bottom);
    const std::size_t lights = std::min<std::size_t>(frame.localLights.size(), kMaxLocalLights);
    u.counts[0] = static_cast<int>(lights);
    for (std::size_t i = 0; i < lights; ++i)
        u.localLights[i] = packed(frame.localLights[i]);
    return u;
}

void appendPalette(const CharacterItem& item, std::vector<animation::SkinMatrix>& palettes) {
    if (item.skinning == animation::SkinningMethod::linear) {
        palettes.insert(palettes.end(), item.palette.begin(), item.palette.end());
        return;
    }
    for (const animation::SkinMatrix& matrix : item.palette) {
        const animation::DualQuaternion joint = animation::dualQuaternion(matrix);
        palettes.push_back({{joint.real, joint.dual, vec4(0)}});
    }
}

InstanceTexels makeInstance(const CharacterItem& item, int firstPaletteJoint) {
    InstanceTexels texels;
    setRows(texels, item.worldFromModel);
    texels.color = vec4(item.tint, item.opacity);
    texels.measures = toLinear(item.highlight);
    const bool dual = item.skinning == animation::SkinningMethod::dualQuaternion;
    texels.extentOrJoint =
        vec4(static_cast<float>(firstPaletteJoint), static_cast<float>(item.highlightJoint), dual ? 1.0F : 0.0F, 0);
    return texels;
}

InstanceTexels makeInstance(const PropItem& item) {
    InstanceTexels texels;
    setRows(texels, item.worldFromShape);
    texels.color = toLinear(item.color);
    texels.measures = vec4(item.radius, item.halfLength, item.roughness, item.checkerSize);
    const bool capsule = item.kind == ShapeKind::capsule;
    texels.extentOrJoint =
        vec4(capsule ? vec3(0, item.halfLength, 0) : item.halfExtents, item.checkerInWorld ? 1.0F : 0.0F);
    return texels;
}

}  // namespace lutka::render
