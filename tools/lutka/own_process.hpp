#pragma once

#include <functional>
#include <string>

#include "core/result.hpp"

namespace lutka::cli {

/// Runs `work` in a process of its own, a fork of this one, and returns what it returns, so that no run inherits the
/// heap, the caches or the graphics context of the one before. This process must have one thread yet. Leaves, and ends
/// the other, when a signal comes. Fails with ErrorCode::internal when it ends otherwise than by returning.
[[nodiscard]] Result<std::string> inOwnProcess(const std::function<std::string()>& work);

}  // namespace lutka::cli
