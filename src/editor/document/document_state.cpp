#include "editor/document/document_state.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lutka::editor {
namespace {

using animation::HumanoidMap;
using Fixed = std::array<std::optional<int>, animation::kRoleCount>;

// Two roles on one joint can only come from the user's own choices.
std::optional<Error> checkTwice(const animation::Character& character, const Fixed& fixed) {
    for (int a = 0; a < animation::kRoleCount; ++a) {
        for (int b = a + 1; b < animation::kRoleCount; ++b) {
            if (!fixed[a] || fixed[a] != fixed[b] || *fixed[a] == animation::kNoJoint) continue;
            return Error{
                ErrorCode::input,
                fmt::format("the joint \"{}\" cannot be both {} and {}", character.skeleton.names[*fixed[a]],
                            animation::roleName(animation::roleAt(a)), animation::roleName(animation::roleAt(b))),
                "", "unmap one of them first"};
        }
    }
    return std::nullopt;
}

}  // namespace

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

Result<HumanoidMap> mapWithFixed(const animation::Character& character, const Fixed& fixed) {
    if (const auto twice = checkTwice(character, fixed)) return *twice;
    animation::MapOptions options;
    for (int role = 0; role < animation::kRoleCount; ++role) {
        if (fixed[role] && *fixed[role] != animation::kNoJoint) options.fixed[role] = fixed[role];
    }
    HumanoidMap map = animation::mapHumanoid(character, options);
    if (!map.humanoid) {
        return Error{ErrorCode::input,
                     "with these bindings the figure is not a humanoid: " +
                         (map.warnings.empty() ? std::string("no reason was given") : map.warnings.front()),
                     "", "assign another joint"};
    }
    for (int role = 0; role < animation::kRoleCount; ++role) {
        if (fixed[role] != animation::kNoJoint) continue;
        if (animation::isRequired(animation::roleAt(role))) {
            return Error{ErrorCode::input,
                         fmt::format("{} is required and cannot be left without a joint",
                                     animation::roleName(animation::roleAt(role))),
                         "", "assign another joint instead"};
        }
        map.roles[role].reset();
    }
    return map;
}

}  // namespace lutka::editor
