#pragma once

#include <string>

#include "physics/crowd/crowd_world.hpp"

namespace lutka::bench {

/// Sets one value of the tuning by its name: "name=value", or "baseline" and "avx2" for the instruction set. Tells of a
/// name that is not known on stderr.
void apply(physics::crowd::CrowdTuning& tuning, const std::string& setting);

}  // namespace lutka::bench
