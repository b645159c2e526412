#pragma once

#include "physics/crowd/state.hpp"

namespace lutka::physics::crowd {

/// Notes how far each doll of a batch has moved since the last step began, and how far its bounds look ahead.
void takeWays(CrowdState& state, Batch& batch, const Topology& topology, float dt);

/// Brings CrowdState::nearBodies in step with the pairs of dolls: what is known of those that still meet stays.
void keepNearBodies(CrowdState& state);

/// Which bodies of two dolls may touch each other within the step: looked for in Doll::firstBox, or as `kept` has them
/// while neither doll can have come much nearer. Returns how many pairs of `near` there are; what lies behind them is
/// room that is not worth giving back.
[[nodiscard]] int findNearBodies(const CrowdState& state, NearBodies& kept, float dt, std::vector<BodyPair>& near);

}  // namespace lutka::physics::crowd
