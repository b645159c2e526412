#pragma once

#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

#include "render/legend.hpp"

namespace lutka::editor {

/// A muted caption over a group of fields.
void caption(const char* text);
/// A line of text that is wrapped at the panel's edge and muted.
void mutedText(const std::string& text);
/// What colours mean, a line each.
void drawLegend(std::span<const render::LegendEntry> entries);
/// A label at the left and the next widget at the right, filling the rest of the line.
void labelled(const char* label, float labelWidth);
/// Shows `text` when the last widget is hovered, and not while something is dragged.
void tooltip(const std::string& text);
/// Whether a text holds another, whatever the case of its ASCII letters.
[[nodiscard]] bool containsText(std::string_view text, std::string_view part);
/// A small coloured word in a rounded box.
void chip(const std::string& text, unsigned int color);

/// What widgets keep from one frame to the next: Dear ImGui's UserData while there is an ImguiHost.
struct WidgetMemory {
    unsigned int field = 0;   ///< The text field that is written in, 0: none …
    std::string text;         ///< … and what stands in it.
    unsigned int slider = 0;  ///< The slider that was pressed last …
    double before = 0.0;      ///< … and its value before that: a double click types, and does not drag.
};

/// A slider on which a double click types the value; its knob never lies over the digits.
[[nodiscard]] bool slider(const char* id, float& value, float low, float high, const char* format,
                          bool logarithmic = false);
[[nodiscard]] bool slider(const char* id, int& value, int low, int high, const char* format = "%d",
                          bool logarithmic = false);
/// A line of text that counts at Enter or when it is left, and not at Esc; whether it was changed for good.
[[nodiscard]] bool textLine(const char* id, std::string& value);
/// The same for a path, with a button behind it; `browse` is set when that was pressed.
[[nodiscard]] bool pathLine(const char* id, std::string& value, bool& browse);

/// The UTF-8 text, or as much of its beginning and end as has room beside an ellipsis between them, at least one letter
/// of its end; `widthOf` measures in the unit of `room`.
[[nodiscard]] std::string cutInTheMiddle(std::string_view text, float room,
                                         const std::function<float(std::string_view)>& widthOf);
/// A name in the present font, cut in the middle where it is wider than `room`, window units.
[[nodiscard]] std::string nameWithin(std::string_view name, float room);

/// The first of the texts that is no wider than `room` in the present font, window units; the last where none is. For
/// figures, which say something else when they are cut.
[[nodiscard]] std::string firstThatFits(std::initializer_list<std::string> texts, float room);

/// Where the text of a slider of that width stands, from its left edge, beside a knob whose middle is at `share` of the
/// way: in the middle where there is room, else at the side that has more.
[[nodiscard]] float sliderTextAt(float width, float textWidth, float knobWidth, float share, float gap);

}  // namespace lutka::editor
