/// validate(): what the reader of files and the editor refuse alike.

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "scene/description/entity_scene.hpp"

namespace lutka::scene {
namespace {

constexpr float kLargest = 1e6F;  // of any length, mass or speed; beyond it floats in a simulation mean nothing
constexpr float kSmallest = 1e-4F;
constexpr std::uint64_t kLargestSeed = INT64_MAX;  // what every JSON reader of ours takes
constexpr int kMostGenerations = 64;
constexpr std::size_t kLongestName = 200;  // bytes

class Checker {
  public:
    explicit Checker(const EntityScene& scene) : scene_(scene) {
        for (std::size_t i = 0; i < scene.entities.size(); ++i)
            places_.emplace(scene.entities[i].id, i);
    }

    std::vector<std::string> run() {
        checkSimulation();
        checkHierarchy();
        for (const Transform& one : scene_.all<Transform>())
            check(one);
        for (const MeshRenderer& one : scene_.all<MeshRenderer>())
            range(one.entity, "meshRenderer/opacity", one.opacity, 0, 1);
        for (const RigidBody& one : scene_.all<RigidBody>())
            check(one);
        for (const Collider& one : scene_.all<Collider>())
            check(one);
        for (const Ragdoll& one : scene_.all<Ragdoll>())
            check(one);
        for (const Light& one : scene_.all<Light>())
            check(one);
        for (const Camera& one : scene_.all<Camera>())
            check(one);
        return std::move(problems_);
    }

  private:
    void say(const std::string& pointer, const std::string& what) { problems_.push_back(pointer + ": " + what); }

    [[nodiscard]] std::string pointer(EntityId id, const char* member) const {
        const auto at = places_.find(id);
        if (at == places_.end()) return fmt::format("/entities/?{}/{}", id, member);
        return fmt::format("/entities/{}/{}", at->second, member);
    }

    void range(const std::string& where, float value, float low, float high) {
        if (std::isfinite(value) && value >= low && value <= high) return;
        say(where, fmt::format("expected a number in [{:g}, {:g}], got {:g}", low, high, value));
    }
    void range(EntityId id, const char* member, float value, float low, float high) {
        range(pointer(id, member), value, low, high);
    }
    void range(EntityId id, const char* member, const vec3& v, float low, float high) {
        for (int axis = 0; axis < 3; ++axis) {
            if (std::isfinite(v[axis]) && v[axis] >= low && v[axis] <= high) continue;
            range(fmt::format("{}/{}", pointer(id, member), axis), v[axis], low, high);
        }
    }

    void checkSimulation() {
        const SceneSimulation& simulation = scene_.simulation;
        const physics::WorldSettings& world = simulation.world;
        const std::string at = "/simulation/";
        for (int axis = 0; axis < 3; ++axis)
            range(fmt::format("{}gravity/{}", at, axis), world.gravity[axis], -1000, 1000);
        range(at + "step", simulation.dt, 0.001F, 0.1F);
        range(at + "seconds", simulation.seconds, 0, 3600);
        range(at + "threads", static_cast<float>(world.threads), 1, 256);
        if (world.substeps) range(at + "substeps", static_cast<float>(*world.substeps), 1, 64);
        if (world.iterations) range(at + "iterations", static_cast<float>(*world.iterations), 1, 1000);
        constexpr float mostDamping = 0.999F;
        if (world.linearDamping) range(at + "linearDamping", *world.linearDamping, 0, mostDamping);
        if (world.angularDamping) range(at + "angularDamping", *world.angularDamping, 0, mostDamping);
        for (int axis = 0; axis < 3; ++axis)
            range(fmt::format("{}focus/{}", at, axis), simulation.focus[axis], -kLargest, kLargest);
        if (simulation.seed > kLargestSeed) say(at + "seed", fmt::format("expected at most {}", kLargestSeed));
        range(at + "focusRadius", simulation.focusRadius, kSmallest, kLargest);
        range(at + "focusYaw", simulation.focusYaw, -2.0F * kPi, 2.0F * kPi);
        range(at + "focusPitch", simulation.focusPitch, -0.5F * kPi, 0.5F * kPi);
        if (simulation.puppets) {
            range(at + "puppets/strength", simulation.puppets->strength, 0, kLargest);
            range(at + "puppets/pinForceN", simulation.puppets->pinForceN.value_or(0.0F), 0, kLargest);
            for (std::size_t i = 0; i < simulation.puppets->kinematic.size(); ++i)
                range(fmt::format("{}puppets/kinematic/{}/weight", at, i), simulation.puppets->kinematic[i].weight, 0,
                      1);
            range(at + "puppets/pace", simulation.puppets->pace, -20, 20);
        }
    }

    void checkHierarchy() {
        if (std::ssize(scene_.entities) > kMostEntities) {
            say("/entities",
                fmt::format("expected at most {} entities, got {}", kMostEntities, scene_.entities.size()));
            return;
        }
        for (std::size_t i = 0; i < scene_.entities.size(); ++i) {
            const Entity& entity = scene_.entities[i];
            const std::string at = fmt::format("/entities/{}", i);
            if (entity.id == kNoEntity) say(at + "/id", "expected a whole number from 1");
            if (const std::size_t first = places_.at(entity.id); first != i) {
                say(at + "/id", fmt::format("expected an id of its own, entity {} has {} too", first, entity.id));
            }
            if (entity.name.empty() || entity.name.size() > kLongestName) {
                say(at + "/name", fmt::format("expected a name of 1 to {} bytes", kLongestName));
            }
            if (entity.parent == kNoEntity) continue;
            if (!places_.contains(entity.parent)) {
                say(at + "/parent", fmt::format("expected the id of another entity, there is no {}", entity.parent));
            } else {
                checkAncestors(entity, at + "/parent");
            }
        }
        const auto homeless = [&](const auto& all) {
            for (const auto& component : all) {
                if (!places_.contains(component.entity)) {
                    say("/entities", fmt::format("there is a component of entity {}, which is none", component.entity));
                }
            }
        };
        std::apply([&](const auto&... all) { (homeless(all), ...); }, scene_.components);
    }

    void checkAncestors(const Entity& entity, const std::string& at) {
        EntityId ancestor = entity.parent;
        for (int generation = 0; ancestor != kNoEntity; ++generation) {
            if (ancestor == entity.id) return say(at, "expected a parent that does not hang on this entity itself");
            if (generation == kMostGenerations) {
                return say(at, fmt::format("expected at most {} entities above one another", kMostGenerations));
            }
            const auto next = places_.find(ancestor);
            ancestor = next != places_.end() ? scene_.entities[next->second].parent : kNoEntity;
        }
    }

    void check(const Transform& one) {
        const quat& q = one.parentFromEntity.rotation;
        constexpr float tolerance = 1e-3F;
        if (!isFinite(q) || std::abs(glm::dot(q, q) - 1.0F) > tolerance) {
            say(pointer(one.entity, "transform/rotation"), "expected a quaternion [x, y, z, w] of length 1");
        }
        range(one.entity, "transform/translation", one.parentFromEntity.translation, -kLargest, kLargest);
    }

    void check(const RigidBody& one) {
        range(one.entity, "rigidBody/massKg", one.massKg, kSmallest, kLargest);
        range(one.entity, "rigidBody/linearVelocity", one.linearVelocity, -1000, 1000);
        range(one.entity, "rigidBody/angularVelocity", one.angularVelocity, -1000, 1000);
        const Collider* collider = scene_.find<Collider>(one.entity);
        const bool canMove =
            collider != nullptr && (collider->kind == Collider::Kind::box || collider->kind == Collider::Kind::sphere ||
                                    collider->kind == Collider::Kind::capsule);
        if (!canMove) say(pointer(one.entity, "rigidBody"), "expected a collider beside it: a box, sphere or capsule");
    }

    void check(const Collider& one) {
        range(one.entity, "collider/friction", one.friction, 0, 100);
        switch (one.kind) {
            case Collider::Kind::plane:
                break;
            case Collider::Kind::box:
                range(one.entity, "collider/halfExtents", one.halfExtents, kSmallest, kLargest);
                break;
            case Collider::Kind::capsule:
                range(one.entity, "collider/halfLength", one.halfLength, 0, kLargest);
                [[fallthrough]];
            case Collider::Kind::sphere:
                range(one.entity, "collider/radius", one.radius, kSmallest, kLargest);
                break;
            case Collider::Kind::ramp:
                range(one.entity, "collider/width", one.width, kSmallest, kLargest);
                range(one.entity, "collider/length", one.length, kSmallest, kLargest);
                range(one.entity, "collider/angle", one.angle, 0, radians(89));
                break;
            case Collider::Kind::stairs:
                range(one.entity, "collider/width", one.width, kSmallest, kLargest);
                range(one.entity, "collider/length", one.length, 0, kLargest);
                range(one.entity, "collider/steps", static_cast<float>(one.steps), 1, 200);
                range(one.entity, "collider/rise", one.rise, kSmallest, kLargest);
                range(one.entity, "collider/run", one.run, kSmallest, kLargest);
                break;
        }
    }

    void check(const Ragdoll& one) {
        range(one.entity, "ragdoll/linearVelocity", one.linearVelocity, -1000, 1000);
        range(one.entity, "ragdoll/angularVelocity", one.angularVelocity, -1000, 1000);
        if (one.clip) range(one.entity, "ragdoll/clip/seconds", one.clip->seconds, 0, kLargest);
        range(one.entity, "ragdoll/strength", one.strength, 0, kLargest);
        for (std::size_t i = 0; i < one.hits.size(); ++i) {
            const std::string at = fmt::format("ragdoll/hits/{}/", i);
            range(one.entity, (at + "seconds").c_str(), one.hits[i].seconds, 0, 3600);
            range(one.entity, (at + "impulse").c_str(), one.hits[i].impulse, -kLargest, kLargest);
        }
        if (scene_.find<Collider>(one.entity) != nullptr) {
            say(pointer(one.entity, "collider"), "expected none beside a ragdoll, whose bodies collide themselves");
        }
    }

    void check(const Light& one) {
        range(one.entity, "light/color", one.color, 0, 1);
        range(one.entity, "light/intensity", one.intensity, 0, kLargest);
        if (one.kind == Light::Kind::sun) {
            range(one.entity, "light/angularRadius", one.angularRadius, 0, 0.2F);
            if (suns_++ > 0) say(pointer(one.entity, "light/kind"), "expected one sun in a scene, there is another");
            return;
        }
        range(one.entity, "light/range", one.range, kSmallest, kLargest);
        if (one.kind != Light::Kind::spot) return;
        range(one.entity, "light/outerAngle", one.outerAngle, radians(0.5F), kPi / 2);
        range(one.entity, "light/innerAngle", one.innerAngle, 0, one.outerAngle);
    }

    void check(const Camera& one) {
        range(one.entity, "camera/fieldOfView", one.fieldOfView, 0.02F, 3);
        range(one.entity, "camera/distance", one.distance, 0.01F, 1000);
    }

    const EntityScene& scene_;
    std::unordered_map<EntityId, std::size_t> places_;
    std::vector<std::string> problems_;
    int suns_ = 0;
};

}  // namespace

std::vector<std::string> validate(const EntityScene& scene) {
    return Checker(scene).run();
}

}  // namespace lutka::scene
