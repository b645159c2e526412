#pragma once

/// What one picture shows, told without GL. Scene, CLI and editor fill a FrameDescription a frame and hand it to
/// render/gl's Renderer. Reuse one object: clear() keeps all memory.

#include <span>
#include <vector>

#include "animation/dual_quaternion_skinning.hpp"
#include "animation/skinning.hpp"
#include "core/rigid_transform.hpp"
#include "core/shape_kind.hpp"
#include "render/camera.hpp"
#include "render/color.hpp"
#include "render/frame_stats.hpp"
#include "render/light.hpp"
#include "render/line_batch.hpp"
#include "render/solid_batch.hpp"

namespace lutka::render {

/// A character uploaded to the renderer that gave it (Renderer::uploadCharacter).
struct CharacterHandle {
    int index = -1;

    [[nodiscard]] bool valid() const { return index >= 0; }
    friend bool operator==(CharacterHandle, CharacterHandle) = default;
};

/// One instance of a character. Instances that share a handle are drawn together.
struct CharacterItem {
    CharacterHandle character;
    /// One matrix a joint, from skinMatrices(); borrowed until draw() returns.
    std::span<const animation::SkinMatrix> palette;
    RigidTransform worldFromModel;
    vec3 tint{1, 1, 1};                ///< Multiplies the base colour, linear.
    float opacity = 1.0F;              ///< [0, 1]; below 1 the whole figure is translucent (its nearest surface only).
    Color highlight{247, 147, 40, 0};  ///< Selection: mixed in by its alpha, with a rim of the same colour.
    int highlightJoint = -1;           ///< The joint whose skin is highlighted; -1: the whole figure.
    bool castsShadow = true;
    /// How its joints' motions are blended; both kinds of one mesh are still one draw call.
    animation::SkinningMethod skinning = animation::SkinningMethod::linear;
};

/// A simple shape of the scene: static geometry, balls, targets.
struct PropItem {
    ShapeKind kind = ShapeKind::box;  ///< Any but a mesh or hull.
    RigidTransform worldFromShape;
    vec3 halfExtents{0.5F, 0.5F, 0.5F};  ///< Box; a plane uses x and z. Metres.
    float radius = 0.5F;                 ///< Sphere and capsule, metres.
    float halfLength = 0.5F;             ///< Capsule: half the distance of the cap centres, metres.
    Color color{178, 182, 188, 255};     ///< Alpha below 255 draws it translucent.
    float roughness = 0.8F;              ///< [0, 1]
    float checkerSize = 0.0F;            ///< Metres; above 0 every other square is a little darker.
    bool checkerInWorld = false;         ///< The squares lie in world space (turned with the shape): faces of static
                                         ///< shapes that share a plane then match. Else they move with the shape.
    bool castsShadow = true;
};

/// The soft infinite floor at a world height, with a grid that fades out with the distance.
struct Floor {
    bool visible = true;
    float height = 0.0F;  ///< World y, metres.
    Color color{158, 160, 164, 255};
    float gridSpacing = 0.5F;    ///< Metres between thin lines, every fourth is stronger; 0: no grid.
    float gridStrength = 0.5F;   ///< [0, 1]; more: darker lines.
    float fadeDistance = 14.0F;  ///< Metres from the camera's target at which it has melted into the background.
};

/// The backdrop, a gradient by the direction of view; display colours, untouched by exposure and light.
struct Background {
    Color top{104, 116, 134, 255};      ///< Straight up.
    Color horizon{196, 200, 205, 255};  ///< At the horizon, into which the floor melts.
    Color bottom{150, 152, 156, 255};   ///< Straight down, where there is no floor.
};

/// One picture.
struct FrameDescription {
    Camera camera;
    SunLight sun;
    std::vector<LocalLight> localLights;  ///< The first eight are used.
    Sky sky;
    Background background;
    Floor floor;
    float exposure = 1.0F;  ///< Multiplies all light before the tone mapping; 2 is one stop brighter.
    bool ambientOcclusion = true;

    std::vector<CharacterItem> characters;
    std::vector<PropItem> props;

    LineBatch lines;                   ///< Debug lines; what lies behind surfaces shows with `hiddenLineOpacity`.
    float lineWidth = 1.5F;            ///< Pixels.
    float hiddenLineOpacity = 0.35F;   ///< [0, 1]; 1: lines over all, 0: hidden by what is before them.
    SolidBatch solids;                 ///< Translucent debug shapes.
    float hiddenSolidOpacity = 0.35F;  ///< Like hiddenLineOpacity, a factor on their alpha.

    /// Empties the lists and batches and keeps the rest (camera, light, floor …).
    void clear() {
        localLights.clear();
        characters.clear();
        props.clear();
        lines.clear();
        solids.clear();
    }
};

}  // namespace lutka::render
