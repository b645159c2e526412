/// What the entities that can be added are made of, and how large they are.

#include <array>

#include "scene/description/entity_colors.hpp"
#include "scene/description/entity_scene.hpp"

namespace lutka::scene {
namespace {

constexpr float kMarkerHalf = 0.12F;    // metres: of lights and cameras, which are drawn as markers
constexpr float kRampThickness = 0.5F;  // metres

constexpr std::array<std::string_view, kEntityKindCount> kNames = {"Character",   "Box",        "Sphere", "Capsule",
                                                                   "Ramp",        "Stairs",     "Floor",  "Sun",
                                                                   "Point light", "Spot light", "Camera", "Empty"};

void addShape(EntityScene& scene, EntityId id, Collider::Kind kind, bool moves) {
    Collider collider;
    collider.kind = kind;
    scene.add(id, collider);
    const bool floor = kind == Collider::Kind::plane;
    scene.add(id, MeshRenderer{.color = moves ? kMovingColor : floor ? kFloorColor : kStandingColor});
    if (moves) scene.add(id, RigidBody{});
}

void addLight(EntityScene& scene, EntityId id, Light::Kind kind) {
    Light light;
    light.kind = kind;
    if (kind == Light::Kind::sun) {
        light.color = {1.0F, 0.965F, 0.91F};  // the default sun's
        light.intensity = 2.2F;
    }
    scene.add(id, light);
}

std::string freeNameFor(const EntityScene& scene, std::string_view kind) {
    std::string name(kind);
    const auto taken = [&] {
        return std::any_of(scene.entities.begin(), scene.entities.end(),
                           [&](const Entity& entity) { return entity.name == name; });
    };
    for (int number = 2; taken(); ++number)
        name = std::string(kind) + " " + std::to_string(number);
    return name;
}

EntityBox boundsOf(const std::vector<ColliderBox>& boxes) {
    vec3 low(1e9F);
    vec3 high(-1e9F);
    for (const ColliderBox& box : boxes) {
        const mat3 turn = glm::mat3_cast(box.entityFromBox.rotation);
        vec3 half(0);
        for (int axis = 0; axis < 3; ++axis)
            half += glm::abs(turn[axis]) * box.halfExtents[axis];
        low = glm::min(low, box.entityFromBox.translation - half);
        high = glm::max(high, box.entityFromBox.translation + half);
    }
    return {(low + high) * 0.5F, (high - low) * 0.5F};
}

std::optional<EntityBox> boxOf(const Collider& collider) {
    switch (collider.kind) {
        case Collider::Kind::plane:
            return std::nullopt;
        case Collider::Kind::box:
            return EntityBox{vec3(0), collider.halfExtents};
        case Collider::Kind::sphere:
            return EntityBox{vec3(0), vec3(collider.radius)};
        case Collider::Kind::capsule:
            return EntityBox{vec3(0), {collider.radius, collider.radius + collider.halfLength, collider.radius}};
        case Collider::Kind::ramp:
        case Collider::Kind::stairs:
            break;
    }
    return boundsOf(boxesOf(collider));
}

}  // namespace

std::string_view entityKindName(EntityKind kind) {
    return kNames[static_cast<std::size_t>(kind)];
}

Entity& addEntity(EntityScene& scene, EntityKind kind, const RigidTransform& world) {
    const EntityId id = addEntity(scene, freeNameFor(scene, entityKindName(kind)), world).id;
    switch (kind) {
        case EntityKind::character:
            scene.add(id, Ragdoll{});
            scene.add(id, MeshRenderer{.color = render::colors::white});
            break;
        case EntityKind::box:
            addShape(scene, id, Collider::Kind::box, false);
            break;
        case EntityKind::sphere:
            addShape(scene, id, Collider::Kind::sphere, true);
            break;
        case EntityKind::capsule:
            addShape(scene, id, Collider::Kind::capsule, true);
            break;
        case EntityKind::ramp:
            addShape(scene, id, Collider::Kind::ramp, false);
            break;
        case EntityKind::stairs:
            addShape(scene, id, Collider::Kind::stairs, false);
            scene.find<Collider>(id)->length = 1.0F;
            break;
        case EntityKind::floor:
            addShape(scene, id, Collider::Kind::plane, false);
            break;
        case EntityKind::sun:
            addLight(scene, id, Light::Kind::sun);
            break;
        case EntityKind::point:
            addLight(scene, id, Light::Kind::point);
            break;
        case EntityKind::spot:
            addLight(scene, id, Light::Kind::spot);
            break;
        case EntityKind::camera:
            scene.add(id, Camera{});
            break;
        case EntityKind::empty:
            break;
    }
    return scene.entities.back();
}

std::vector<ColliderBox> boxesOf(const Collider& collider) {
    std::vector<ColliderBox> boxes;
    const float halfWidth = collider.width * 0.5F;
    if (collider.kind == Collider::Kind::ramp) {
        const float half = collider.length * 0.5F;
        const quat tilt = glm::angleAxis(collider.angle, vec3(1, 0, 0));
        const vec3 surface(0, half * std::sin(collider.angle), -half * std::cos(collider.angle));
        boxes.push_back(
            {{tilt, surface - tilt * vec3(0, kRampThickness * 0.5F, 0)}, {halfWidth, kRampThickness * 0.5F, half}});
    }
    if (collider.kind == Collider::Kind::stairs) {
        const float back = -(collider.run * static_cast<float>(collider.steps) + collider.length);
        for (int step = 0; step < collider.steps; ++step) {
            // Each step reaches back under the ones above, so that no edge is exposed between two of them.
            const float height = collider.rise * static_cast<float>(step + 1);
            const float front = -collider.run * static_cast<float>(step);
            boxes.push_back({{{1, 0, 0, 0}, {0, height * 0.5F, (back + front) * 0.5F}},
                             {halfWidth, height * 0.5F, (front - back) * 0.5F}});
        }
    }
    return boxes;
}

std::optional<EntityBox> boxOf(const EntityScene& scene, EntityId id) {
    if (const Collider* collider = scene.find<Collider>(id)) return boxOf(*collider);
    const bool marker = scene.find<Light>(id) != nullptr || scene.find<Camera>(id) != nullptr;
    if (marker) return EntityBox{vec3(0), vec3(kMarkerHalf)};
    return std::nullopt;
}

}  // namespace lutka::scene
