#include "editor/play/pulls.hpp"

#include <algorithm>

namespace lutka::editor {
namespace {

// Enough to lift a whole adult by a hand; the constraint's damping keeps it from whipping.
constexpr float kMaxForceN = 1500.0F;

std::optional<physics::Drag> dragOf(const Pull& pull, const scene::Simulation& simulation) {
    if (pull.doll >= simulation.dollCount()) return std::nullopt;
    const int body = physics::bodyNamed(simulation.assetOf(pull.doll).profile, pull.body);
    if (body < 0) return std::nullopt;
    return physics::Drag{simulation.dollId(pull.doll), body, pull.bodyPoint, pull.target, kMaxForceN};
}

}  // namespace

void Pulls::set(physics::World& world, Applied& pull, const std::optional<physics::Drag>& wanted) {
    // A world made anew knows the id as nothing, or as a pull of its own.
    const bool known = world.has(pull.id) && world.dragOf(pull.id) == pull.drag;
    if (!wanted) {
        if (known) world.removeDrag(pull.id);
        pull = {};
        return;
    }
    if (known)
        world.setDrag(pull.id, *wanted);
    else
        pull.id = world.addDrag(*wanted);
    pull.drag = *wanted;
}

void Pulls::applyTo(scene::Simulation& simulation) {
    physics::World& world = simulation.world();
    set(world, appliedMouse_, mouse ? dragOf(*mouse, simulation) : std::nullopt);
    if (appliedPins_.size() < pins.size()) appliedPins_.resize(pins.size());
    for (std::size_t i = 0; i < appliedPins_.size(); ++i)
        set(world, appliedPins_[i], i < pins.size() ? dragOf(pins[i], simulation) : std::nullopt);
    appliedPins_.resize(pins.size());
}

std::vector<Pull>::iterator Pulls::findPin(int doll, std::string_view body) {
    return std::find_if(pins.begin(), pins.end(),
                        [&](const Pull& pin) { return pin.doll == doll && pin.body == body; });
}

}  // namespace lutka::editor
