#include "editor/document/scene_settings.hpp"

#include <algorithm>

#include "core/random.hpp"

namespace lutka::editor {

Result<void> makeNamedScene(SceneSettings& settings, const scene::FigureBounds& figure) {
    if (settings.scenario.empty()) return {};
    auto named = scene::makeScene(settings.scenario, settings.count, settings.seed, figure);
    if (!named) return named.error();
    scene::EntityScene& fresh = named.value();
    scene::EntityScene& old = settings.entities;
    for (const scene::EntityId id : settings.made) {
        // What the user hung on it stays, where it is.
        for (const scene::Entity& entity : std::vector<scene::Entity>(old.entities)) {
            const bool own = !std::binary_search(settings.made.begin(), settings.made.end(), entity.id);
            if (entity.parent == id && own) scene::reparentEntity(old, entity.id, scene::kNoEntity);
        }
    }
    for (const scene::EntityId id : settings.made)
        scene::removeEntity(old, id);
    settings.made.clear();
    const scene::EntityId above = scene::freeId(old) - 1;
    for (scene::Entity& entity : fresh.entities) {
        entity.id += above;
        if (entity.parent != scene::kNoEntity) entity.parent += above;
        settings.made.push_back(entity.id);
    }
    const auto take = [&](auto& components) {
        for (auto& component : components) {
            component.entity += above;
            old.add(component.entity, component);
        }
    };
    std::apply([&](auto&... all) { (take(all), ...); }, fresh.components);
    old.entities.insert(old.entities.begin(), fresh.entities.begin(), fresh.entities.end());
    old.name = fresh.name;
    fresh.simulation.world = old.simulation.world;
    fresh.simulation.dt = old.simulation.dt;
    old.simulation = fresh.simulation;
    if (old.entities.size() == settings.made.size()) settings.begun = old;
    return {};
}

void addCopies(scene::EntityScene& scene, int count) {
    constexpr float spacing = 1.1F;
    constexpr float lowest = 2.4F;  // metres over the floor: above who stands there
    constexpr float storey = 2.2F;
    constexpr int side = 4;
    Random random(scene.entities.size());
    for (int i = 0; i < count; ++i) {
        const int place = i % (side * side);
        const int row = place / side;
        const int level = i / (side * side);
        const float middle = (static_cast<float>(std::min(count, side * side)) / static_cast<float>(side) - 1) * 0.5F;
        const vec3 at{(static_cast<float>(place % side) - 1.5F) * spacing * (count > 1 ? 1.0F : 0.0F),
                      lowest + storey * static_cast<float>(level), (static_cast<float>(row) - middle) * spacing};
        const quat turn = glm::angleAxis(random.uniform(-kPi, kPi), vec3(0, 1, 0)) *
                          glm::angleAxis(random.uniform(-0.5F, 0.5F), vec3(1, 0, 0));
        scene::addEntity(scene, scene::EntityKind::character, {turn, at});
    }
}

}  // namespace lutka::editor
