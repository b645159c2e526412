#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "animation/humanoid/roles.hpp"

namespace lutka::animation {

/// A joint's name taken apart: "mixamorig:LeftForeArm" → left, {fore, arm}; "DEF-thigh.L.001_24" → left, {def, thigh},
/// {1, 24}; "左足首" → left, {ankle}.
struct NameTokens {
    std::vector<std::string> words;  ///< Lower-case ASCII, in order, without the word of the side.
    std::vector<int> numbers;        ///< In order of appearance.
    Side side = Side::center;        ///< center: the name says no side.
};

/// Takes a name apart: namespaces (up to the last ':' or '|') are dropped, the rest is split at separators, at changes
/// of case and between letters and digits; glued words are cut by the lexicon ("luparm" → left, {up, arm}). Full-width
/// characters and accents are folded, Chinese and Japanese body words are translated. Characters that FBX wrote as
/// numbers ("FBXASC032" for a blank) are those characters.
[[nodiscard]] NameTokens tokenise(std::string_view escaped);

}  // namespace lutka::animation
