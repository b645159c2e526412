#pragma once

#include "editor/document/document_state.hpp"

namespace lutka::editor {

/// Fixes the roles of one side as they are, and those of the other at the joints opposite, by position across the
/// figure. Fails with ErrorCode::input when a joint has none opposite to it.
[[nodiscard]] Result<void> mirrorFixed(DocumentState& state, const animation::Character& character,
                                       animation::Side from);

}  // namespace lutka::editor
