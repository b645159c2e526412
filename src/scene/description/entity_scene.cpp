#include "scene/description/entity_scene.hpp"

#include <fmt/format.h>

#include <unordered_map>
#include <unordered_set>

namespace lutka::scene {
namespace {

template <class F>
void forEachComponentType(EntityScene& scene, const F& f) {
    std::apply([&](auto&... all) { (f(all), ...); }, scene.components);
}

// `id` and all that hangs on it, parents first.
std::vector<EntityId> familyOf(const EntityScene& scene, EntityId id) {
    std::vector<EntityId> family{id};
    for (std::size_t i = 0; i < family.size(); ++i) {
        for (const Entity& entity : scene.entities) {
            if (entity.parent == family[i]) family.push_back(entity.id);
        }
    }
    return family;
}

bool nameTaken(const EntityScene& scene, const std::string& name) {
    return std::any_of(scene.entities.begin(), scene.entities.end(),
                       [&](const Entity& entity) { return entity.name == name; });
}

// "Box" → "Box 2"; "Box 2" → "Box 3".
std::string freeName(const EntityScene& scene, const std::string& wanted) {
    if (!nameTaken(scene, wanted)) return wanted;
    std::string stem = wanted;
    const std::size_t space = stem.rfind(' ');
    const bool numbered = space != std::string::npos && space + 1 < stem.size() &&
                          stem.find_first_not_of("0123456789", space + 1) == std::string::npos;
    if (numbered) stem.resize(space);
    for (int number = 2;; ++number) {
        std::string name = fmt::format("{} {}", stem, number);
        if (!nameTaken(scene, name)) return name;
    }
}

template <class T>
void copyComponent(EntityScene& scene, const std::vector<T>& /*all*/, EntityId from, EntityId to) {
    if (const T* component = scene.find<T>(from)) {
        T copy = *component;  // add() may move what is pointed to
        scene.add(to, std::move(copy));
    }
}

}  // namespace

Entity* findEntity(EntityScene& scene, EntityId id) {
    const auto at = std::find_if(scene.entities.begin(), scene.entities.end(),
                                 [&](const Entity& entity) { return entity.id == id; });
    return at != scene.entities.end() ? &*at : nullptr;
}

const Entity* findEntity(const EntityScene& scene, EntityId id) {
    return findEntity(const_cast<EntityScene&>(scene), id);  // NOLINT(cppcoreguidelines-pro-type-const-cast)
}

EntityId freeId(const EntityScene& scene) {
    EntityId highest = kNoEntity;
    for (const Entity& entity : scene.entities)
        highest = std::max(highest, entity.id);
    return highest + 1;
}

Entity& addEntity(EntityScene& scene, std::string name, const RigidTransform& parentFromEntity, EntityId parent) {
    // Makers append thousands: ids grow along the list there, and the last one's successor is free.
    const EntityId id = freeId(scene);
    scene.entities.push_back({id, std::move(name), parent});
    scene.add(id, Transform{id, parentFromEntity});
    return scene.entities.back();
}

void removeEntity(EntityScene& scene, EntityId id) {
    const std::vector<EntityId> family = familyOf(scene, id);
    const std::unordered_set<EntityId> gone(family.begin(), family.end());
    std::erase_if(scene.entities, [&](const Entity& entity) { return gone.contains(entity.id); });
    forEachComponentType(scene, [&](auto& all) {
        std::erase_if(all, [&](const auto& component) { return gone.contains(component.entity); });
    });
}

EntityId duplicateEntity(EntityScene& scene, EntityId id) {
    if (findEntity(scene, id) == nullptr) return kNoEntity;
    std::unordered_map<EntityId, EntityId> copyOf;
    for (const EntityId original : familyOf(scene, id)) {
        Entity copy = *findEntity(scene, original);
        copy.id = freeId(scene);
        copy.name = freeName(scene, copy.name);
        if (const auto parent = copyOf.find(copy.parent); parent != copyOf.end()) copy.parent = parent->second;
        copyOf[original] = copy.id;
        scene.entities.push_back(copy);
        forEachComponentType(scene, [&](auto& all) { copyComponent(scene, all, original, copy.id); });
    }
    return copyOf.at(id);
}

bool reparentEntity(EntityScene& scene, EntityId id, EntityId parent) {
    Entity* entity = findEntity(scene, id);
    if (entity == nullptr || (parent != kNoEntity && findEntity(scene, parent) == nullptr)) return false;
    const std::vector<EntityId> family = familyOf(scene, id);
    if (std::find(family.begin(), family.end(), parent) != family.end()) return false;
    const RigidTransform world = worldFromEntity(scene, id);
    entity->parent = parent;
    placeEntity(scene, id, world);
    return true;
}

RigidTransform worldFromEntity(const EntityScene& scene, EntityId id) {
    RigidTransform worldFromHere;
    std::size_t generations = 0;
    while (id != kNoEntity && generations++ <= scene.entities.size()) {
        if (const Transform* transform = scene.find<Transform>(id)) {
            worldFromHere = transform->parentFromEntity * worldFromHere;
        }
        const Entity* entity = findEntity(scene, id);
        id = entity != nullptr ? entity->parent : kNoEntity;
    }
    return worldFromHere;
}

std::vector<RigidTransform> worldFromEntities(const EntityScene& scene) {
    std::vector<RigidTransform> all;
    all.reserve(scene.entities.size());
    for (const Entity& entity : scene.entities) {
        const Transform* transform = scene.find<Transform>(entity.id);
        const RigidTransform own = transform != nullptr ? transform->parentFromEntity : RigidTransform{};
        all.push_back(entity.parent == kNoEntity ? own : worldFromEntity(scene, entity.parent) * own);
    }
    return all;
}

void placeEntity(EntityScene& scene, EntityId id, const RigidTransform& worldFromEntityWanted) {
    const Entity* entity = findEntity(scene, id);
    if (entity == nullptr) return;
    RigidTransform own = worldFromEntityWanted;
    if (entity->parent != kNoEntity) own = inverse(worldFromEntity(scene, entity->parent)) * own;
    own.rotation = glm::normalize(own.rotation);
    scene.add(id, Transform{id, own});
}

}  // namespace lutka::scene
