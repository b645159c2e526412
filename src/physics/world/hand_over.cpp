#include "physics/world/hand_over.hpp"

namespace lutka::physics {

MovedDoll moveDoll(World& from, DollId doll, World& to) {
    if (!from.has(doll)) return {};
    const DollState state = from.dollState(doll);
    std::vector<Drag> drags;
    for (const DragId id : from.dragsOf(doll))
        drags.push_back(from.dragOf(id));
    const RagdollProfile& profile = from.profileOf(doll);
    from.removeDoll(doll);
    MovedDoll moved{to.addDoll(profile, state.bodies), {}};
    to.setDollState(moved.doll, state);
    for (Drag& drag : drags) {
        drag.doll = moved.doll;
        moved.drags.push_back(to.addDrag(drag));
    }
    return moved;
}

}  // namespace lutka::physics
