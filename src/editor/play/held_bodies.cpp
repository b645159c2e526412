#include "editor/play/held_bodies.hpp"

#include <algorithm>

namespace lutka::editor {
namespace {

// More than any ragdoll can pull with; the pins are springs of the doll's whole mass, so that nothing sags.
constexpr float kHoldingN = 1e6F;

}  // namespace

void HeldBodies::holdAllBut(std::span<const Item> moving, std::span<const int> dolls, scene::Simulation& simulation) {
    letGo();
    for (const int doll : dolls) {
        const auto& bodies = simulation.assetOf(doll).profile.bodies;
        for (int body = 0; body < static_cast<int>(bodies.size()); ++body) {
            const Item item{Item::Kind::body, doll, body};
            if (std::find(moving.begin(), moving.end(), item) != moving.end()) continue;
            places_[{simulation.scenario().dollEntities[doll], bodies[body].name}] = {};
        }
    }
    attach(simulation, [](int) { return true; });
}

void HeldBodies::letGo() {
    detach();
    places_.clear();
}

bool HeldBodies::holds(const scene::Simulation& simulation, int doll, int body) const {
    return places_.contains(
        {simulation.scenario().dollEntities[doll], simulation.assetOf(doll).profile.bodies[body].name});
}

void HeldBodies::attach(scene::Simulation& simulation, const std::function<bool(int)>& anew) {
    detach();
    for (int doll = 0; doll < simulation.dollCount() && !places_.empty(); ++doll) {
        const scene::EntityId entity = simulation.scenario().dollEntities[doll];
        const auto& bodies = simulation.assetOf(doll).profile.bodies;
        const auto present = simulation.worldFromBody(doll);
        const bool moved = anew(doll);
        for (int body = 0; body < static_cast<int>(bodies.size()); ++body) {
            const auto place = places_.find({entity, bodies[body].name});
            if (place == places_.end()) continue;
            if (moved) place->second = present[body] * inverse(bodies[body].jointFromBody);
            pins_.push_back({std::make_unique<physics::BodyPin>(simulation.world(), simulation.dollId(doll), body),
                             place->second * bodies[body].jointFromBody});
        }
    }
}

void HeldBodies::prepare(float dt) {
    for (const Pin& one : pins_)
        one.pin->follow(one.worldFromBody, one.worldFromBody, dt, kHoldingN);
}

}  // namespace lutka::editor
