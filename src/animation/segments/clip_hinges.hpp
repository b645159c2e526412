#pragma once

#include <vector>

#include "animation/character.hpp"
#include "animation/segments/segment.hpp"

namespace lutka::animation {

/// Sets the hinges of segments of limbs whose joints bend in one plane in all clips, against the bind pose: by at least
/// 20 degrees in all, and aside by at most a fifth of that (root mean square) and 8 degrees; about an axis across the
/// segment. Tails, necks and trunks bend every way in the hand though a walk moves them in one plane. Counterparts both
/// have one or none, mirrored and with what either needs; `standardFromModel` is the creature's.
void findClipHinges(const Character& character, const quat& standardFromModel, std::vector<Segment>& segments);

}  // namespace lutka::animation
