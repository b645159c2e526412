#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

namespace lutka::animation::rig_import {

/// A document's text as UTF-8, be it in that or in UTF-16. In its tags a blank stands before each attribute, however
/// many blanks and line breaks there were, and the attribute's value in double quotes.
[[nodiscard]] std::string decodedCollada(std::string_view bytes);

/// Whether a file that starts with these bytes is Collada, as UTF-8 or UTF-16.
[[nodiscard]] bool isCollada(std::string_view start);

/// A Collada document as Assimp 5.2.5 takes it, which refuses numbers with blanks before them and UTF-16: UTF-8, each
/// element's text without blanks at its ends, and blanks, tabs and line breaks within it as one blank. A
/// polylist's count is that of its vcount, a colour of three numbers gets its fourth, a skin without a bind shape
/// matrix the identity, and its weights stand as pairs of joint and weight. Tags as decodedCollada() writes them;
/// comments and character data stay as they are.
[[nodiscard]] std::string tidyCollada(std::string_view bytes);

/// Where the tag, comment or section of character data that starts at `start` ends; the end of the text when it does
/// not.
[[nodiscard]] std::size_t endOfColladaMarkup(std::string_view text, std::size_t start);

/// The value of an attribute in a tag; empty where it has none, or one with entities.
[[nodiscard]] std::string_view colladaAttribute(std::string_view tag, std::string_view name);

/// The names of a document's nodes by their ids. Only nodes whose id does not hold the name are in it, such as
/// "id-bone-4" for "pelvis", which Godot writes. Names that two nodes share are left out. `document` is the file's text
/// as UTF-8.
[[nodiscard]] std::map<std::string, std::string> colladaNodeNames(std::string_view document);

}  // namespace lutka::animation::rig_import
