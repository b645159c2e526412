#include "editor/play/pulls.hpp"

#include <algorithm>

namespace lutka::editor {
namespace {

// Enough to lift a whole adult by a hand; the constraint's damping keeps it from whipping.
constexpr float kMaxForceN = 1500.0F;

std::optional<physics::Drag> dragOf(const Pull& pull, const physics::World& world) {
    if (pull.doll >= world.dollCount()) return std::nullopt;
    const int body = physics::bodyOf(world.profileOf(pull.doll), pull.role);
    if (body < 0) return std::nullopt;
    return physics::Drag{pull.doll, body, pull.bodyPoint, pull.target, kMaxForceN};
}

void set(physics::World& world, int id, const std::optional<physics::Drag>& drag) {
    if (drag) {
        world.setDrag(id, *drag);
    } else {
        world.removeDrag(id);
    }
}

}  // namespace

void Pulls::applyTo(physics::World& world) {
    set(world, kMouseId, mouse ? dragOf(*mouse, world) : std::nullopt);
    const int count = std::min(static_cast<int>(pins.size()), kMaxPins);
    for (int i = 0; i < count; ++i)
        set(world, kFirstPinId + i, dragOf(pins[i], world));
    for (int i = count; i < applied_; ++i)
        world.removeDrag(kFirstPinId + i);
    applied_ = count;
}

std::vector<Pull>::iterator Pulls::findPin(int doll, animation::Role role) {
    return std::find_if(pins.begin(), pins.end(),
                        [&](const Pull& pin) { return pin.doll == doll && pin.role == role; });
}

}  // namespace lutka::editor
