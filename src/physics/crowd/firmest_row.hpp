#pragma once

#include <algorithm>

#include "physics/crowd/topology.hpp"

namespace lutka::physics::crowd {

/// What a row that leads a body or drives a joint may answer a speed with. A kinematic body has it: so much that what
/// hangs on it moves it by some micrometres a substep, which the next one takes back, and so little that floats still
/// hold a hand beside it. A spring that asks for more is as good as rigid, and is given no more.
struct FirmestRow {
    float massKg = 0.0F;
    float moment = 0.0F;  ///< kg m²
};

[[nodiscard]] inline FirmestRow firmestRow(const Topology& topology) {
    constexpr float kDolls = 200.0F;  // times the doll's mass
    float massKg = 0.0F;
    float reach = 0.0F;  // of the longest body: the arm that its weight may turn a body at
    for (const BodyConstants& body : topology.bodies) {
        massKg += 1.0F / body.inverseMass;
        reach = std::max(reach, body.reach + body.radius);
    }
    return {kDolls * massKg, kDolls * massKg * reach * reach};
}

}  // namespace lutka::physics::crowd
