#include "physics/world/hand_over.hpp"

namespace lutka::physics {

int moveDoll(World& from, int doll, World& to) {
    const DollState state = from.dollState(doll);
    const auto drags = from.dragsOf(doll);
    const RagdollProfile& profile = from.profileOf(doll);
    from.removeDoll(doll);
    const int moved = to.addDoll(profile, state.bodies);
    to.setDollState(moved, state);
    for (auto [id, drag] : drags) {
        drag.doll = moved;
        to.setDrag(id, drag);
    }
    return moved;
}

}  // namespace lutka::physics
