#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "physics/world/world.hpp"
#include "render/camera.hpp"
#include "render/light.hpp"
#include "scene/asset/figure_bounds.hpp"
#include "scene/asset/ragdoll_asset.hpp"
#include "scene/description/entity_scene.hpp"

namespace lutka::scene {

/// How something is drawn.
struct Look {
    render::Color color{172, 177, 184, 255};  ///< Alpha below 255: translucent.
    bool visible = true;
    bool castsShadow = true;
};

/// Where one doll starts: its model frame and the velocity of the whole body.
struct Placement {
    RigidTransform worldFromModel;
    vec3 linearVelocity{0, 0, 0};      ///< m/s
    vec3 angularVelocity{0, 0, 0};     ///< rad/s about the figure's centre.
    int asset = 0;                     ///< Which of the simulation's assets it is.
    std::optional<StartPose> pose;     ///< Unset: the simulation's.
    std::optional<ClipStart> clip;     ///< Likewise; wins over `pose`.
    float strength = 1.0F;             ///< Factor on the muscles' strength.
    Look look{render::colors::white};  ///< The colour multiplies the skin.
};

/// A push on the dolls of a scene at a moment.
struct PuppetHit {
    /// A body's name, or that of a role; what a part of the trunk without a body gets the next one below does. Dolls
    /// without it are spared.
    std::string body = "chest";
    float seconds = 0.0F;   ///< Since the start, >= 0.
    vec3 impulse{0, 0, 0};  ///< N s, as the figure faces: Y up, +Z ahead; at the body's centre.
    int doll = -1;          ///< Which one; -1: all.
};

/// A body of a doll held at a world point from the start (the scene `hang`).
struct Pin {
    int doll = 0;
    std::string body;  ///< Its name; a doll without one of that name falls.
};

/// A deterministic set-up shared by tests, benchmarks, CLI and editor: what a Simulation runs and pictures show. Made
/// of an EntityScene; the vectors of looks and entities are as long as what they belong to, or empty.
struct Scenario {
    std::string name;
    std::uint64_t seed = 0;
    std::vector<physics::StaticShape> statics;
    std::vector<physics::DynamicProp> props;
    std::vector<Placement> dolls;
    std::vector<Pin> pins;
    std::vector<PuppetHit> hits;
    std::vector<Look> staticLooks;
    std::vector<Look> propLooks;
    std::vector<EntityId> staticEntities;  ///< Which entity each comes from.
    std::vector<EntityId> propEntities;
    std::vector<EntityId> dollEntities;
    float seconds = 6.0F;                  ///< Long enough for one doll to come to rest.
    vec3 focus{0, 0.9F, 0};                ///< What a camera should look at.
    float focusRadius = 1.6F;              ///< And how far around, metres.
    float focusYaw = radians(30.0F);       ///< From this side …
    float focusPitch = radians(12.0F);     ///< … and this high.
    bool focusFollows = false;             ///< See FilmCamera.
    std::optional<render::Camera> camera;  ///< The scene's own; wins over the focus.
    std::optional<render::SunLight> sun;   ///< In place of the default one.
    std::vector<render::LocalLight> lights;
};

struct ScenarioInfo {
    std::string_view name;
    std::string_view summary;
};

/// drop, spread, pile, stairs, ramp, hang, throw, balls, walk, push, getup, march.
[[nodiscard]] std::span<const ScenarioInfo> scenarioRegistry();

/// The named scene for `count` characters of one figure, `count` in [1, 10000], whose models are left empty. With
/// seed 0 the first figure starts nearly upright; those beside it, and all of other seeds, are turned, tilted and
/// nudged. Fails with ErrorCode::usage for an unknown name (the known ones are listed) or count.
[[nodiscard]] Result<EntityScene> makeScene(std::string_view name, int count, std::uint64_t seed,
                                            const FigureBounds& figure);

/// What a camera that stands at `worldFromCamera` sees.
[[nodiscard]] render::Camera viewOf(const Camera& camera, const RigidTransform& worldFromCamera);

/// What runs of a scene. `figures` are those of the simulation's assets, and `assetOfRagdoll` says which of them each
/// of scene.all<Ragdoll>() is. Fails with ErrorCode::input, all problems at once, when validate() finds some.
[[nodiscard]] Result<Scenario> compileScene(const EntityScene& scene, std::span<const Figure> figures,
                                            std::span<const int> assetOfRagdoll);

/// Which of the named scenes (scenarioRegistry()), for makeScenario().
struct NamedScene {
    std::string_view name = "drop";
    int count = 1;           ///< Dolls, [1, 10000].
    std::uint64_t seed = 0;  ///< 0: the first figure starts nearly upright; see makeScene().
};

/// makeScene() and compileScene() in one, for dolls of one figure. Fails as they do.
[[nodiscard]] Result<Scenario> makeScenario(const NamedScene& scene, const Figure& figure);
/// For dolls of one asset: its figure is figureOf(asset).
[[nodiscard]] Result<Scenario> makeScenario(const NamedScene& scene, const RagdollAsset& asset);

}  // namespace lutka::scene
