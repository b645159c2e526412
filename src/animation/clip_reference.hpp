#pragma once

#include <span>
#include <string>
#include <string_view>

#include "animation/clip.hpp"

namespace lutka::animation {

/// The clip that a text means: for "#3" the third where there are so many, else the first of that name. Where none has
/// it, the only clip that has it without regard to case, else after its last '|' ("walk" for "Armature|Walk"), else as
/// the last whole words of its name ("walk" for "Armature|Man_Walk", not for "Sleepwalk"). -1: none, or several.
[[nodiscard]] int clipMeant(std::span<const Clip> clips, std::string_view reference);
/// The text that means a clip: its name, or, where it has none or one that means another, "#" with its number, counted
/// from 1.
[[nodiscard]] std::string clipReference(std::span<const Clip> clips, std::size_t clip);
/// For people: the name, with the number where the name does not tell it from the others.
[[nodiscard]] std::string clipLabel(std::span<const Clip> clips, std::size_t clip);
/// What all clips are asked for by, comma separated.
[[nodiscard]] std::string clipReferences(std::span<const Clip> clips);

/// Why a text means no clip (clipMeant() gives -1), and what to write in its place: for an error.
struct ClipDoubt {
    std::string message;
    std::string mend;
};
[[nodiscard]] ClipDoubt clipDoubt(std::span<const Clip> clips, std::string_view reference);

}  // namespace lutka::animation
