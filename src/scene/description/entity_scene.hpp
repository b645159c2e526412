#pragma once

/// A scene as its author sees it: entities with components, and how it is simulated. Plain data; compileScene() makes
/// what a Simulation runs, scene_file.hpp reads and writes it, the editor edits it.

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "animation/humanoid/roles.hpp"
#include "core/rigid_transform.hpp"
#include "physics/fit/fit_options.hpp"
#include "physics/powered/muscles.hpp"
#include "physics/world/world.hpp"
#include "render/color.hpp"

namespace lutka::scene {

/// Names an entity for good: unique in its scene, > 0, kept by files and by undo.
using EntityId = std::uint32_t;
inline constexpr EntityId kNoEntity = 0;

struct Entity {
    EntityId id = kNoEntity;
    std::string name;
    EntityId parent = kNoEntity;  ///< Its Transform is relative to this one's; kNoEntity: to the world.

    friend bool operator==(const Entity&, const Entity&) = default;
};

/// Where an entity stands. A character's frame lies on the ground between its feet, Y up, the face towards +Z.
struct Transform {
    EntityId entity = kNoEntity;
    RigidTransform parentFromEntity;

    friend bool operator==(const Transform& a, const Transform& b) {
        return a.entity == b.entity && a.parentFromEntity.rotation == b.parentFromEntity.rotation &&
               a.parentFromEntity.translation == b.parentFromEntity.translation;
    }
};

/// Draws the entity's collider, or its ragdoll's skin. Without one an entity is simulated but not seen.
struct MeshRenderer {
    EntityId entity = kNoEntity;
    render::Color color{255, 255, 255, 255};  ///< Alpha is not looked at. A skin is multiplied by it: white leaves it.
    float opacity = 1.0F;                     ///< [0, 1]; below 1 it is translucent.
    bool visible = true;
    bool castsShadow = true;

    friend bool operator==(const MeshRenderer&, const MeshRenderer&) = default;
};

/// Makes the entity's collider move; without one it stands still. Only for boxes, spheres and capsules.
struct RigidBody {
    EntityId entity = kNoEntity;
    float massKg = 5.0F;            ///< > 0
    vec3 linearVelocity{0, 0, 0};   ///< At the start, m/s, world.
    vec3 angularVelocity{0, 0, 0};  ///< At the start, rad/s, world.

    friend bool operator==(const RigidBody&, const RigidBody&) = default;
};

/// The shape that others bump into.
struct Collider {
    enum class Kind {
        plane,    ///< y = 0, solid below, without end.
        box,      ///< Centred.
        sphere,   ///< Centred.
        capsule,  ///< Centred, along Y.
        ramp,     ///< From the middle of its lower edge, rising towards -Z; a slab with its surface on top.
        stairs,   ///< From the middle of the lowest step's foot, rising towards -Z.
    };
    EntityId entity = kNoEntity;
    Kind kind = Kind::box;
    vec3 halfExtents{0.25F, 0.25F, 0.25F};  ///< Box, metres, > 0.
    float radius = 0.15F;                   ///< Sphere and capsule, metres, > 0.
    float halfLength = 0.25F;               ///< Capsule: half the distance of the cap centres, metres, >= 0.
    float width = 2.0F;                     ///< Ramp and stairs: along X, metres, > 0.
    float length = 4.0F;                    ///< Ramp: of its surface; stairs: of the landing behind the top step.
    float angle = radians(25.0F);           ///< Ramp: from the horizontal, radians, [0, pi/2).
    int steps = 8;                          ///< Stairs, [1, 200].
    float rise = 0.17F;                     ///< Stairs: height of a step, metres, > 0.
    float run = 0.28F;                      ///< Stairs: depth of a step, metres, > 0.
    float friction = 0.8F;                  ///< Coulomb, >= 0. Moving bodies have the world's own.

    friend bool operator==(const Collider&, const Collider&) = default;
};

/// The pose that a doll starts in.
enum class StartPose { bind, node };

/// Starts the fall from a clip's pose with the velocities that the clip has there.
struct ClipStart {
    std::string clip;
    float seconds = 0.0F;  ///< Clamped to the clip's length.

    friend bool operator==(const ClipStart&, const ClipStart&) = default;
};

/// A push on a character at a moment, with ScenePuppets.
struct RagdollHit {
    animation::Role body = animation::Role::chest;
    float seconds = 0.0F;   ///< Since the start, [0, 3600].
    vec3 impulse{0, 0, 0};  ///< N s, as the figure faces: Y up, +Z ahead; at the body's centre.

    friend bool operator==(const RagdollHit&, const RagdollHit&) = default;
};

/// Bodies that follow a clip themselves: see physics::BodyTarget.
struct LedPart {
    std::string name;     ///< Of a body, of a physics::MuscleGroup (trunk, head, arm, leg), or all.
    float weight = 1.0F;  ///< [0, 1]; 1: kinematic. Where several name a body the last one counts.
    friend bool operator==(const LedPart&, const LedPart&) = default;
};

/// How all characters of a scene follow a clip with their muscles. A clip that a character lacks is the mannequin's,
/// retargeted.
struct ScenePuppets {
    std::string clip;                              ///< Looped; empty: the start pose is held.
    std::optional<physics::MusclePreset> muscles;  ///< Unset: each profile's own, powered where it has none.
    float strength = 1.0F;                         ///< Factor on theirs, [0, 1e6].
    std::optional<float> pinForceN;  ///< PuppetSettings::pinForceN, [0, 1e6]; unset: each profile's, else its default.
    std::vector<LedPart> kinematic;  ///< Bodies that follow the clip themselves.
    bool getUp = false;              ///< Limp ones that have come to rest get up.
    bool limp = false;               ///< They begin limp.
    float pace = 0.0F;               ///< m/s ahead, [-20, 20]: what a clip in place walks at.

    friend bool operator==(const ScenePuppets&, const ScenePuppets&) = default;
};

/// A character that falls.
struct Ragdoll {
    EntityId entity = kNoEntity;
    /// Of the model; in files relative to the scene file. Empty: the model that the scene is opened with.
    std::filesystem::path model;
    /// ImportOptions::figure for `model`.
    std::optional<int> figure;
    std::filesystem::path profile;        ///< *.ragdoll.json; empty: fitted.
    std::optional<StartPose> pose;        ///< Unset: what the simulation is started with, the bind pose as a rule.
    std::optional<ClipStart> clip;        ///< Wins over `pose`.
    std::optional<physics::RigKind> rig;  ///< What `model` is taken as; unset: as the scene is opened with.
    /// Names of bodies (of a humanoid those of its roles) held at their tips where they start.
    std::vector<std::string> pins;
    vec3 linearVelocity{0, 0, 0};   ///< Of the whole doll at the start, m/s, world.
    vec3 angularVelocity{0, 0, 0};  ///< Likewise, rad/s about its centre of mass.
    float strength = 1.0F;          ///< Factor on ScenePuppets::strength, [0, 1e6].
    std::vector<RagdollHit> hits;

    friend bool operator==(const Ragdoll&, const Ragdoll&) = default;
};

/// A light; a sun and a spot shine along the entity's -Z, and a sun stands anywhere. One sun a scene at most, which
/// takes the place of the default one.
struct Light {
    enum class Kind { sun, point, spot };
    EntityId entity = kNoEntity;
    Kind kind = Kind::point;
    vec3 color{1.0F, 0.9F, 0.75F};   ///< Linear, [0, 1].
    float intensity = 4.0F;          ///< Irradiance at one metre (sun: anywhere), >= 0.
    float range = 10.0F;             ///< Point and spot: metres at which it has faded out, > 0.
    float outerAngle = radians(30);  ///< Spot: half the cone, radians, (0, pi/2].
    float innerAngle = radians(20);  ///< Spot: where it begins to fade, [0, outerAngle].
    bool castsShadow = true;         ///< Sun.
    float angularRadius = 0.045F;    ///< Sun: of its disc, radians, [0, 0.2]. More: softer shadows.

    friend bool operator==(const Light&, const Light&) = default;
};

/// Looks along the entity's -Z with Y up; a roll is not looked at. The first active one gives pictures their view.
struct Camera {
    EntityId entity = kNoEntity;
    float fieldOfView = radians(35.0F);  ///< Vertical, radians, [0.02, 3].
    float distance = 4.0F;               ///< To what it orbits about in the editor, metres, > 0.
    bool orthographic = false;
    bool active = true;

    friend bool operator==(const Camera&, const Camera&) = default;
};

/// How the scene is simulated.
struct SceneSimulation {
    physics::WorldSettings world;
    float dt = 1.0F / 60.0F;              ///< Seconds a step, [0.001, 0.1].
    float seconds = 6.0F;                 ///< Length of a run, (0, 3600].
    std::uint64_t seed = 0;               ///< That the scene was made with; told in reports.
    vec3 focus{0, 0.9F, 0};               ///< Where to look when there is no camera, world.
    float focusRadius = 1.6F;             ///< And how far around, metres, > 0.
    float focusYaw = radians(30.0F);      ///< From which side, as render::Camera::yaw, radians, [-2 pi, 2 pi].
    float focusPitch = radians(12.0F);    ///< And from how high, as render::Camera::pitch, radians.
    bool focusFollows = false;            ///< The view goes along with the characters, near enough to see them act.
    std::optional<ScenePuppets> puppets;  ///< Unset: the characters fall.

    friend bool operator==(const SceneSimulation&, const SceneSimulation&) = default;
};

/// The scene. Each vector of components is sorted by entity and holds at most one of an entity; use add() and remove().
struct EntityScene {
    static constexpr int kVersion = 1;  ///< Of the file.

    std::string name = "scene";
    SceneSimulation simulation;
    std::vector<Entity> entities;  ///< In the order of lists and of dolls.
    std::tuple<std::vector<Transform>, std::vector<MeshRenderer>, std::vector<RigidBody>, std::vector<Collider>,
               std::vector<Ragdoll>, std::vector<Light>, std::vector<Camera>>
        components;

    template <class T>
    [[nodiscard]] std::vector<T>& all() {
        return std::get<std::vector<T>>(components);
    }
    template <class T>
    [[nodiscard]] const std::vector<T>& all() const {
        return std::get<std::vector<T>>(components);
    }
    /// The entity's component; null when it has none.
    template <class T>
    [[nodiscard]] T* find(EntityId entity) {
        const auto at = place(all<T>(), entity);
        return at != all<T>().end() && at->entity == entity ? &*at : nullptr;
    }
    template <class T>
    [[nodiscard]] const T* find(EntityId entity) const {
        const auto at = place(all<T>(), entity);
        return at != all<T>().end() && at->entity == entity ? &*at : nullptr;
    }
    /// Gives the entity that component in place of the one that it has, if any.
    template <class T>
    T& add(EntityId entity, T component) {
        component.entity = entity;
        auto at = place(all<T>(), entity);
        if (at == all<T>().end() || at->entity != entity) return *all<T>().insert(at, std::move(component));
        return *at = std::move(component);
    }
    template <class T>
    void remove(EntityId entity) {
        std::erase_if(all<T>(), [&](const T& component) { return component.entity == entity; });
    }

    friend bool operator==(const EntityScene&, const EntityScene&) = default;

  private:
    template <class Components>
    static auto place(Components& components, EntityId entity) {
        return std::lower_bound(components.begin(), components.end(), entity,
                                [](const auto& component, EntityId id) { return component.entity < id; });
    }
};

[[nodiscard]] Entity* findEntity(EntityScene& scene, EntityId id);
[[nodiscard]] const Entity* findEntity(const EntityScene& scene, EntityId id);
/// An id that the scene has not used.
[[nodiscard]] EntityId freeId(const EntityScene& scene);
/// Appends an entity with a Transform.
Entity& addEntity(EntityScene& scene, std::string name, const RigidTransform& parentFromEntity = {},
                  EntityId parent = kNoEntity);
/// Takes an entity away with its components and all that hangs on it.
void removeEntity(EntityScene& scene, EntityId id);
/// A copy with all that hangs on it, beside the original, with names and ids of their own. Its id; kNoEntity when there
/// is no such entity.
EntityId duplicateEntity(EntityScene& scene, EntityId id);
/// Hangs an entity on another one (kNoEntity: on nothing) where it stands. False, and nothing done, when that would
/// close a ring.
bool reparentEntity(EntityScene& scene, EntityId id, EntityId parent);

/// An entity without a Transform is where its parent is.
[[nodiscard]] RigidTransform worldFromEntity(const EntityScene& scene, EntityId id);
/// The same of all, in the order of `entities`.
[[nodiscard]] std::vector<RigidTransform> worldFromEntities(const EntityScene& scene);
/// Places an entity in the world, whatever it hangs on; gives it a Transform when it has none.
void placeEntity(EntityScene& scene, EntityId id, const RigidTransform& worldFromEntity);

/// Entities in a scene at most.
inline constexpr int kMostEntities = 20000;

/// What is wrong with a scene as a whole or in a value's range, one sentence a problem, each with the JSON pointer of
/// its place in a file; empty: sound. Files that characters name are not looked at.
[[nodiscard]] std::vector<std::string> validate(const EntityScene& scene);

/// What the editor adds.
enum class EntityKind { character, box, sphere, capsule, ramp, stairs, floor, sun, point, spot, camera, empty };
inline constexpr int kEntityKindCount = 12;
[[nodiscard]] std::string_view entityKindName(EntityKind kind);
/// Appends one with its usual components, standing at `world` (a box: its middle). Boxes, ramps, stairs and floors
/// stand still, spheres and capsules move.
Entity& addEntity(EntityScene& scene, EntityKind kind, const RigidTransform& world);

/// The box around an entity's shape or marker in its own frame; nothing for planes and what has none.
struct EntityBox {
    vec3 center{0, 0, 0};
    vec3 half{0, 0, 0};
};
[[nodiscard]] std::optional<EntityBox> boxOf(const EntityScene& scene, EntityId id);

/// The boxes that a ramp's or stairs' collider is made of, in the entity's frame.
struct ColliderBox {
    RigidTransform entityFromBox;
    vec3 halfExtents{1, 1, 1};
};
[[nodiscard]] std::vector<ColliderBox> boxesOf(const Collider& collider);

}  // namespace lutka::scene
