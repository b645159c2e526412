#pragma once

#include <span>
#include <string>

#include "report/drop_trace.hpp"
#include "scene/measure/checkup.hpp"

namespace lutka::reporting {

/// Four charts of the drops, each a figure element with its caption: energy, joint separation, limit violation, and the
/// time to rest. As many traces as the checkup has drops; empty without drops.
[[nodiscard]] std::string dropChartsHtml(const scene::Checkup& checkup, std::span<const DropTrace> drops);

}  // namespace lutka::reporting
