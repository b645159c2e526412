#pragma once

#include "physics/crowd/state.hpp"

namespace lutka::physics::crowd {

/// Wakes the sleeping dolls that an awake one is about to push, and brings bounds and pairs up to date.
void wakeTouched(CrowdState& state, float dt);

/// The step's contacts: static ones into the batches, those between bodies into `touches`, all with the impulses that
/// they had in the last step.
void findContacts(CrowdState& state, float dt);

}  // namespace lutka::physics::crowd
