/// compileScene(): entities → what is simulated and drawn.

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "core/assert.hpp"
#include "scene/description/scenario.hpp"

namespace lutka::scene {
namespace {

using physics::BodyShape;
using physics::StaticShape;

class Compiler {
  public:
    Compiler(const EntityScene& scene, std::span<const Figure> figures, std::span<const int> assetOfRagdoll)
        : scene_(scene), figures_(figures), assetOfRagdoll_(assetOfRagdoll) {}

    Scenario run() {
        const SceneSimulation& simulation = scene_.simulation;
        out_.name = scene_.name;
        out_.seed = simulation.seed;
        out_.seconds = simulation.seconds;
        out_.focus = simulation.focus;
        out_.focusRadius = simulation.focusRadius;
        out_.focusYaw = simulation.focusYaw;
        out_.focusPitch = simulation.focusPitch;
        out_.focusFollows = simulation.focusFollows;
        const std::vector<RigidTransform> world = worldFromEntities(scene_);
        for (std::size_t i = 0; i < scene_.entities.size(); ++i) {
            const EntityId id = scene_.entities[i].id;
            const RigidTransform place{glm::normalize(world[i].rotation), world[i].translation};
            if (const Collider* collider = scene_.find<Collider>(id)) add(id, *collider, place);
            if (const Ragdoll* ragdoll = scene_.find<Ragdoll>(id)) add(id, *ragdoll, place);
            if (const Light* light = scene_.find<Light>(id)) add(*light, place);
            const Camera* camera = scene_.find<Camera>(id);
            if (camera != nullptr && camera->active && !out_.camera) out_.camera = viewOf(*camera, place);
        }
        return std::move(out_);
    }

  private:
    [[nodiscard]] Look lookOf(EntityId id) const {
        const MeshRenderer* mesh = scene_.find<MeshRenderer>(id);
        Look look;
        look.visible = mesh != nullptr && mesh->visible && mesh->opacity > 0.0F;
        if (mesh == nullptr) return look;
        look.color = withAlpha(mesh->color, mesh->opacity);
        look.castsShadow = mesh->castsShadow;
        return look;
    }

    void addStatic(EntityId id, const StaticShape& shape) {
        out_.statics.push_back(shape);
        out_.staticLooks.push_back(lookOf(id));
        out_.staticEntities.push_back(id);
    }

    void add(EntityId id, const Collider& collider, const RigidTransform& world) {
        if (const RigidBody* body = scene_.find<RigidBody>(id)) return add(id, collider, *body, world);
        StaticShape shape;
        shape.friction = collider.friction;
        shape.worldFromShape = world;
        switch (collider.kind) {
            case Collider::Kind::plane:
                return addStatic(id, shape);
            case Collider::Kind::box:
                shape.kind = StaticShape::Kind::box;
                shape.halfExtents = collider.halfExtents;
                return addStatic(id, shape);
            case Collider::Kind::sphere:
                shape.kind = StaticShape::Kind::sphere;
                shape.radius = collider.radius;
                return addStatic(id, shape);
            case Collider::Kind::capsule:
                shape.kind = StaticShape::Kind::capsule;
                shape.radius = collider.radius;
                shape.halfLength = collider.halfLength;
                return addStatic(id, shape);
            case Collider::Kind::ramp:
            case Collider::Kind::stairs:
                break;
        }
        shape.kind = StaticShape::Kind::box;
        for (const ColliderBox& box : boxesOf(collider)) {
            shape.worldFromShape = world * box.entityFromBox;
            shape.halfExtents = box.halfExtents;
            addStatic(id, shape);
        }
    }

    void add(EntityId id, const Collider& collider, const RigidBody& body, const RigidTransform& world) {
        physics::DynamicProp prop;
        prop.shape.kind = collider.kind == Collider::Kind::box      ? BodyShape::Kind::box
                          : collider.kind == Collider::Kind::sphere ? BodyShape::Kind::sphere
                                                                    : BodyShape::Kind::capsule;
        prop.shape.halfExtents = collider.halfExtents;
        prop.shape.radius = collider.radius;
        prop.shape.halfLength = collider.halfLength;
        prop.massKg = body.massKg;
        prop.state = {world, body.linearVelocity, body.angularVelocity};
        out_.props.push_back(prop);
        out_.propLooks.push_back(lookOf(id));
        out_.propEntities.push_back(id);
    }

    // The entity's frame is between the feet; what is kept exactly is where the figure's centre is.
    void add(EntityId id, const Ragdoll& ragdoll, const RigidTransform& world) {
        const auto index = static_cast<std::size_t>(&ragdoll - scene_.all<Ragdoll>().data());
        const int asset = assetOfRagdoll_[index];
        const Figure& figure = figures_[static_cast<std::size_t>(asset)];
        const vec3 middle = (figure.bounds.low + figure.bounds.high) * 0.5F;
        const float halfHeight = (figure.bounds.high.y - figure.bounds.low.y) * 0.5F;
        const vec3 centre = world.translation + world.rotation * vec3(0, halfHeight, 0);
        Placement placement;
        placement.worldFromModel.rotation = glm::normalize(world.rotation * figure.standardFromModel);
        placement.worldFromModel.translation = centre - world.rotation * middle;
        placement.linearVelocity = ragdoll.linearVelocity;
        placement.angularVelocity = ragdoll.angularVelocity;
        placement.asset = asset;
        placement.pose = ragdoll.pose;
        placement.clip = ragdoll.clip;
        placement.look = lookOf(id);
        placement.strength = ragdoll.strength;
        for (const RagdollHit& hit : ragdoll.hits)
            out_.hits.push_back({std::string(animation::roleName(hit.body)), hit.seconds, hit.impulse,
                                 static_cast<int>(out_.dolls.size())});
        for (const std::string& body : ragdoll.pins)
            out_.pins.push_back({static_cast<int>(out_.dolls.size()), body});
        out_.dolls.push_back(placement);
        out_.dollEntities.push_back(id);
    }

    void add(const Light& light, const RigidTransform& world) {
        const vec3 shines = world.rotation * vec3(0, 0, -1);
        if (light.kind == Light::Kind::sun) {
            render::SunLight& sun = out_.sun.emplace();
            sun.directionToLight = -shines;
            sun.color = light.color;
            sun.intensity = light.intensity;
            sun.castsShadow = light.castsShadow;
            sun.angularRadius = light.angularRadius;
            return;
        }
        render::LocalLight& local = out_.lights.emplace_back();
        local.position = world.translation;
        local.direction = shines;
        local.color = light.color;
        local.intensity = light.intensity;
        local.range = light.range;
        if (light.kind == Light::Kind::point) return;
        local.outerAngle = light.outerAngle;
        local.innerAngle = light.innerAngle;
    }

    const EntityScene& scene_;
    std::span<const Figure> figures_;
    std::span<const int> assetOfRagdoll_;
    Scenario out_;
};

}  // namespace

render::Camera viewOf(const Camera& camera, const RigidTransform& world) {
    const vec3 back = world.rotation * vec3(0, 0, 1);
    render::Camera view;
    view.distance = camera.distance;
    view.target = world.translation - back * camera.distance;
    view.pitch = std::asin(std::clamp(back.y, -1.0F, 1.0F));
    // Straight up or down the heading is that of the picture's upper edge.
    const vec3 up = world.rotation * vec3(0, 1, 0);
    constexpr float pole = 0.9999F;
    view.yaw = std::abs(back.y) < pole ? std::atan2(back.x, back.z) : std::atan2(-up.x * back.y, -up.z * back.y);
    view.fieldOfView = camera.fieldOfView;
    view.orthographic = camera.orthographic;
    return view;
}

Result<Scenario> compileScene(const EntityScene& scene, std::span<const Figure> figures,
                              std::span<const int> assetOfRagdoll) {
    LUTKA_ASSERT(assetOfRagdoll.size() == scene.all<Ragdoll>().size());
    const std::vector<std::string> problems = validate(scene);
    if (!problems.empty()) {
        std::string message = "the scene is not sound:";
        for (const std::string& problem : problems)
            message += "\n  " + problem;
        return Error{ErrorCode::input, std::move(message), scene.name, "docs/scene.md describes every member"};
    }
    return Compiler(scene, figures, assetOfRagdoll).run();
}

}  // namespace lutka::scene
