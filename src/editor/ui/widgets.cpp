#include "editor/ui/widgets.hpp"

#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "core/letter_case.hpp"
#include "editor/ui/style.hpp"

namespace lutka::editor {

void caption(const char* text) {
    ImGui::Spacing();
    ImGui::TextColored(mutedColor(), "%s", text);
}

void drawLegend(std::span<const render::LegendEntry> entries) {
    ImGui::Indent();
    for (const render::LegendEntry& entry : entries) {
        const ImVec4 color(static_cast<float>(entry.color.r) / 255.0F, static_cast<float>(entry.color.g) / 255.0F,
                           static_cast<float>(entry.color.b) / 255.0F, 1.0F);
        const float side = ImGui::GetTextLineHeight();
        ImGui::ColorButton(entry.text.data(), color, ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop,
                           {side, side});
        ImGui::SameLine();
        mutedText(std::string(entry.text));
    }
    ImGui::Unindent();
}

void mutedText(const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, mutedColor());
    ImGui::PushTextWrapPos(0.0F);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

void labelled(const char* label, float labelWidth) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(label);
    ImGui::SameLine(labelWidth);
    ImGui::SetNextItemWidth(-1.0F);
}

void tooltip(const std::string& text) {
    if (!ImGui::IsItemHovered() || ImGui::IsMouseDown(ImGuiMouseButton_Left)) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24.0F);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

// ASCII letters without their case; others as they are.
bool containsText(std::string_view text, std::string_view part) {
    return std::search(text.begin(), text.end(), part.begin(), part.end(),
                       [](char a, char b) { return lowerCased(a) == lowerCased(b); }) != text.end();
}

std::string cutInTheMiddle(std::string_view text, float room, const std::function<float(std::string_view)>& widthOf) {
    if (widthOf(text) <= room) return std::string(text);
    std::vector<std::size_t> letters;  // where each begins
    for (std::size_t i = 0; i < text.size(); ++i) {
        if ((static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U) letters.push_back(i);
    }
    letters.push_back(text.size());
    const std::size_t count = letters.size() - 1;
    // The end tells more: names of a rig begin alike.
    const auto cut = [&](std::size_t kept) {
        const std::size_t first = kept / 2;
        std::string result(text.substr(0, letters[first]));
        return result.append("…").append(text.substr(letters[count - (kept - first)]));
    };
    std::size_t kept = std::max<std::size_t>(count, 2) - 1;
    while (kept > 1 && widthOf(cut(kept)) > room)
        --kept;
    return count < 2 ? std::string(text) : cut(kept);
}

std::string nameWithin(std::string_view name, float room) {
    return cutInTheMiddle(name, room, [](std::string_view text) {
        return ImGui::CalcTextSize(text.data(), text.data() + text.size()).x;
    });
}

std::string firstThatFits(std::initializer_list<std::string> texts, float room) {
    const auto fits = [&](const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x <= room; };
    const auto* const first = std::find_if(texts.begin(), texts.end(), fits);
    return first != texts.end() ? *first : *(texts.end() - 1);
}

void chip(const std::string& text, unsigned int color) {
    const ImVec2 padding(ImGui::GetStyle().FramePadding.x, 1.0F);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const ImVec2 end(at.x + size.x + 2 * padding.x, at.y + size.y + 2 * padding.y);
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddRectFilled(at, end, (color & 0x00FFFFFFU) | 0x38000000U, ImGui::GetStyle().FrameRounding);
    list->AddText({at.x + padding.x, at.y + padding.y}, color, text.c_str());
    ImGui::Dummy({end.x - at.x, end.y - at.y});
}

namespace {

constexpr float kGrabPadding = 2.0F;  // Dear ImGui's own, around a slider's knob

// Draws the slider by `draw` without its text, and the text beside the knob. Dear ImGui types on a click with Ctrl.
template <class Value, class Draw, class Format>
bool sliderBesideText(const char* id, Value& value, const Draw& draw, const Format& textAndShare) {
    ImGuiIO& io = ImGui::GetIO();
    auto& memory = *static_cast<WidgetMemory*>(io.UserData);
    const float width = ImGui::CalcItemWidth();
    const ImGuiID item = ImGui::GetID(id);
    const bool typing = ImGui::TempInputIsActive(item);
    const bool control = io.KeyCtrl;
    const unsigned int color = ImGui::GetColorU32(ImGuiCol_Text);
    const bool twice = ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const bool under = ImGui::IsMouseHoveringRect(at, {at.x + width, at.y + ImGui::GetFrameHeight()});
    // The first of two clicks has moved the knob.
    const bool back = twice && under && memory.slider == item && value != static_cast<Value>(memory.before);
    if (back) value = static_cast<Value>(memory.before);
    const Value before = value;
    io.KeyCtrl = control || twice;
    if (!typing) ImGui::PushStyleColor(ImGuiCol_Text, 0U);
    const bool changed = draw() || back;
    if (!typing) ImGui::PopStyleColor();
    io.KeyCtrl = control;
    if (ImGui::IsItemActivated() && !twice) {
        memory.slider = item;
        memory.before = static_cast<double>(before);
    }
    // A field shows a rounded value, and gives that back when nothing else was typed, or by Esc.
    if (typing && changed && memory.slider == item) {
        const Value typed = std::exchange(value, static_cast<Value>(memory.before));
        const std::string unchanged = textAndShare(width).text;
        value = typed;
        if (textAndShare(width).text == unchanged) value = static_cast<Value>(memory.before);
    }
    if (typing || ImGui::TempInputIsActive(item)) return changed;
    const auto [text, share, knob] = textAndShare(width - 2.0F * kGrabPadding);
    const ImVec2 low = ImGui::GetItemRectMin();
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x * 0.5F;
    const float left = sliderTextAt(width, size.x, knob + 2.0F * kGrabPadding, share, gap);
    ImGui::GetWindowDrawList()->AddText({low.x + left, low.y + ImGui::GetStyle().FramePadding.y}, color, text.c_str());
    return changed;
}

struct SliderText {
    std::string text;
    float share = 0.0F;  // of the way from low to high
    float knob = 0.0F;   // its width
};

template <class... Values>
std::string formatted(const char* format, Values... values) {
    std::array<char, 64> text{};
    ImFormatString(text.data(), text.size(), format, values...);
    // What is rounded to nothing has no sign.
    const bool nothing = text[0] == '-' && std::strpbrk(text.data(), "123456789") == nullptr;
    return text.data() + (nothing ? 1 : 0);
}

float shareOf(float value, float low, float high, bool logarithmic) {
    const float clamped = std::clamp(value, low, high);
    if (!logarithmic || low <= 0.0F) return high > low ? (clamped - low) / (high - low) : 0.0F;
    return std::log(clamped / low) / std::log(high / low);
}

}  // namespace

float sliderTextAt(float width, float textWidth, float knobWidth, float share, float gap) {
    const float middle = 0.5F * (width - textWidth);
    const float knob = share * (width - knobWidth);  // its left edge
    if (knob + knobWidth + gap <= middle || knob - gap >= middle + textWidth) return middle;
    const float left = knob - gap - textWidth;
    const float right = knob + knobWidth + gap;
    return knob > width - knob - knobWidth ? std::max(left, 0.0F) : std::min(right, width - textWidth);
}

bool slider(const char* id, float& value, float low, float high, const char* format, bool logarithmic) {
    return sliderBesideText(
        id, value,
        [&] {
            return ImGui::SliderFloat(id, &value, low, high, format,
                                      logarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None);
        },
        [&](float /*room*/) {
            return SliderText{formatted(format, static_cast<double>(value)), shareOf(value, low, high, logarithmic),
                              ImGui::GetStyle().GrabMinSize};
        });
}

bool slider(const char* id, int& value, int low, int high, const char* format, bool logarithmic) {
    return sliderBesideText(
        id, value,
        [&] {
            return ImGui::SliderInt(id, &value, low, high, format,
                                    logarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None);
        },
        [&](float room) {
            const float share =
                shareOf(static_cast<float>(value), static_cast<float>(low), static_cast<float>(high), logarithmic);
            const float knob = std::max(room / static_cast<float>(high - low + 1), ImGui::GetStyle().GrabMinSize);
            return SliderText{formatted(format, value), share, knob};
        });
}

// Another widget that takes the mouse ends the field before it is drawn: what stood in it is kept until then.
bool textLine(const char* id, std::string& value) {
    auto& memory = *static_cast<WidgetMemory*>(ImGui::GetIO().UserData);
    const ImGuiID item = ImGui::GetID(id);
    std::string text = memory.field == item ? memory.text : value;
    const bool entered = ImGui::InputText(id, &text, ImGuiInputTextFlags_EnterReturnsTrue);
    if (ImGui::IsItemActive()) {
        memory = {item, text};
        return false;
    }
    const bool left = memory.field == item && !ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
    if (memory.field == item) memory = {};
    if ((!entered && !left) || text == value) return false;
    value = std::move(text);
    return true;
}

bool pathLine(const char* id, std::string& value, bool& browse) {
    const float button = ImGui::CalcTextSize("…").x + 2.0F * ImGui::GetStyle().FramePadding.x;
    ImGui::SetNextItemWidth(-button - ImGui::GetStyle().ItemInnerSpacing.x);
    const bool changed = textLine(id, value);
    if (!value.empty()) tooltip(value);
    ImGui::SameLine(0.0F, ImGui::GetStyle().ItemInnerSpacing.x);
    ImGui::PushID(id);
    browse = ImGui::Button("…");
    tooltip("Choose the file");
    ImGui::PopID();
    return changed;
}

}  // namespace lutka::editor
