#pragma once

#include "physics/crowd/state.hpp"

namespace lutka::physics::crowd {

/// Exact mending of what lies deep within a limp doll, in jobs of a single batch with dolls. A hand that lies under the
/// body, between two contacts that ask against each other, is not freed by mending each of these as if the other did
/// not press: the tree's answer to both made one of them deeper, for as long as the doll lay. Here passes of the tree
/// find what a push at each of the doll's own contacts does to all of them, and the pushes are those with which all
/// part as they are to.
///
/// Looks for such contacts and takes them out of the sweeps that mend (PairKind::wedged) until endWedges().
void findWedges(CrowdState& state, Job& job, const SubstepParams& params);

/// Mends errors of position in a batch of the job, on top of the steady velocities. `pushed`: pair contacts have
/// changed velocities for it already. Where a doll has such contacts, each pass begins anew from those velocities.
void mendDolls(CrowdState& state, const Job& job, std::size_t batch, const SubstepParams& params, bool pushed);

void endWedges(Job& job);

}  // namespace lutka::physics::crowd
