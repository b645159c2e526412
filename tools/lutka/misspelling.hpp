#pragma once

#include <span>
#include <string>
#include <string_view>

namespace lutka::cli {

/// The word that was likely meant: one that `given` needs a single change to become (a letter left out, added,
/// exchanged, or two swapped; capitals aside); else the first that it is short for, with the same first letter and
/// three or more behind the dashes ("--secs" for "--seconds"); else the one that needs the fewest changes, at most one
/// in three of the letters. Of equals the first. Empty where none comes near, and for a single letter.
[[nodiscard]] std::string likelyMeant(std::string_view given, std::span<const std::string> words);

}  // namespace lutka::cli
