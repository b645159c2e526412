#pragma once

#include <string>
#include <string_view>

namespace lutka::editor {

/// A muted caption over a group of fields.
void caption(const char* text);
/// A line of text that is wrapped at the panel's edge and muted.
void mutedText(const std::string& text);
/// A label at the left and the next widget at the right, filling the rest of the line.
void labelled(const char* label, float labelWidth);
/// Shows `text` when the last widget is hovered, and not while something is dragged.
void tooltip(const std::string& text);
/// Whether a text holds another, whatever the case of its ASCII letters.
[[nodiscard]] bool containsText(std::string_view text, std::string_view part);
/// A small coloured word in a rounded box.
void chip(const std::string& text, unsigned int color);

/// A slider on which a double click types the value.
[[nodiscard]] bool slider(const char* id, float& value, float low, float high, const char* format,
                          bool logarithmic = false);
/// A line of text that counts at Enter or when it is left, and not at Esc; whether it was changed for good.
[[nodiscard]] bool textLine(const char* id, std::string& value);

}  // namespace lutka::editor
