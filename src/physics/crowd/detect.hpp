#pragma once

#include "physics/crowd/state.hpp"

namespace lutka::physics::crowd {

/// Bounds of all awake dolls for a step of `dt` s.
void findBounds(CrowdState& state, float dt);
/// The same of one batch, from where its dolls are now.
void findBounds(CrowdState& state, Batch& batch, const Topology& topology, float dt);

/// Pairs of dolls whose bounds meet, at least one of them awake, by index: a sweep along x.
void sweepDolls(CrowdState& state, float dt);

/// Wakes the sleeping dolls that an awake one is about to push, and brings bounds and pairs up to date.
void wakeTouched(CrowdState& state, float dt);

/// The static contacts of one batch for the next `dt` s, with the impulses that its dolls' contacts were kept with.
void findStatics(CrowdState& state, Batch& batch, const Topology& topology, float dt);

/// The step's contacts: static ones into the batches, those between bodies into `touches`, all with the impulses that
/// they had in the last step.
void findContacts(CrowdState& state, float dt);

}  // namespace lutka::physics::crowd
