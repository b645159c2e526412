#include "animation/clip_reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <vector>

#include "core/letter_case.hpp"

namespace lutka::animation {
namespace {

int firstNamed(std::span<const Clip> clips, std::string_view name) {
    const auto at = std::find_if(clips.begin(), clips.end(), [&](const Clip& clip) { return clip.name == name; });
    return at != clips.end() ? static_cast<int>(at - clips.begin()) : -1;
}

int clipOfNumber(std::span<const Clip> clips, std::string_view reference) {
    if (!reference.starts_with('#')) return -1;
    std::size_t number = 0;
    const char* end = reference.data() + reference.size();
    const auto [stop, failed] = std::from_chars(reference.data() + 1, end, number);
    const bool whole = failed == std::errc() && stop == end;
    return whole && number >= 1 && number <= clips.size() ? static_cast<int>(number) - 1 : -1;
}

// Exporters put the armature's name before that of the action, which is what people know: "Armature|Walk".
bool isAction(std::string_view name, std::string_view reference) {
    const std::size_t bar = name.rfind('|');
    return bar != std::string_view::npos && sameButCase(name.substr(bar + 1), reference);
}

bool endsInWords(std::string_view name, std::string_view reference) {
    if (name.size() <= reference.size()) return false;
    const std::size_t first = name.size() - reference.size();
    if (!sameButCase(name.substr(first), reference)) return false;
    const auto before = static_cast<unsigned char>(name[first - 1]);
    const auto start = static_cast<unsigned char>(name[first]);
    return std::isalnum(before) == 0 || std::isalnum(start) == 0 || std::isdigit(before) != std::isdigit(start) ||
           (std::islower(before) != 0 && std::isupper(start) != 0);
}

template <typename Matches>
int onlyOne(std::span<const Clip> clips, const Matches& matches) {
    int only = -1;
    for (std::size_t clip = 0; clip < clips.size(); ++clip) {
        if (!matches(clips[clip].name)) continue;
        if (only >= 0) return -1;
        only = static_cast<int>(clip);
    }
    return only;
}

}  // namespace

int clipMeant(std::span<const Clip> clips, std::string_view reference) {
    if (reference.empty()) return -1;
    if (const int numbered = clipOfNumber(clips, reference); numbered >= 0) return numbered;
    if (const int named = firstNamed(clips, reference); named >= 0) return named;
    for (bool (*meant)(std::string_view, std::string_view) : {sameButCase, isAction, endsInWords}) {
        const int only = onlyOne(clips, [&](std::string_view name) { return meant(name, reference); });
        if (only >= 0) return only;
    }
    return -1;
}

std::string clipReference(std::span<const Clip> clips, std::size_t clip) {
    const std::string& name = clips[clip].name;
    if (!name.empty() && clipMeant(clips, name) == static_cast<int>(clip)) return name;
    return "#" + std::to_string(clip + 1);
}

std::string clipLabel(std::span<const Clip> clips, std::size_t clip) {
    const std::string& name = clips[clip].name;
    const std::string reference = clipReference(clips, clip);
    return name.empty() || reference == name ? reference : name + " (" + reference + ")";
}

namespace {

// As many of them as a person reads.
std::string listed(std::span<const Clip> clips, const std::vector<std::size_t>& which) {
    constexpr std::size_t most = 12;
    std::string all;
    for (std::size_t i = 0; i < std::min(which.size(), most); ++i)
        all += (all.empty() ? "" : ", ") + clipReference(clips, which[i]);
    if (which.size() > most) all += fmt::format(" and {} more (`lutka inspect` lists all)", which.size() - most);
    return all;
}

template <typename Has>
std::vector<std::size_t> clipsWhere(std::span<const Clip> clips, const Has& has) {
    std::vector<std::size_t> found;
    for (std::size_t clip = 0; clip < clips.size(); ++clip)
        if (has(clips[clip].name)) found.push_back(clip);
    return found;
}

bool isWholeNumber(std::string_view text) {
    return !text.empty() &&
           std::all_of(text.begin(), text.end(), [](char letter) { return letter >= '0' && letter <= '9'; });
}

}  // namespace

ClipDoubt clipDoubt(std::span<const Clip> clips, std::string_view reference) {
    const std::string none = fmt::format("there is no clip named '{}'", reference);
    if (clips.empty()) return {none, "the file has no clips"};
    const bool byNumber = reference.starts_with('#');
    if (isWholeNumber(reference.substr(byNumber ? 1 : 0))) {
        if (byNumber || clips.size() == 1)
            return {byNumber ? fmt::format("there is no clip {}", reference) : none,
                    clips.size() == 1 ? "the file has one: " + clipReference(clips, 0)
                                      : fmt::format("the file has {}, from #1 to #{}", clips.size(), clips.size())};
        if (clipOfNumber(clips, fmt::format("#{}", reference)) >= 0)
            return {none, fmt::format("#{} is the clip of that number", reference)};
    }
    if (const std::size_t at = reference.rfind('@'); at != std::string_view::npos) {
        const std::string_view name = reference.substr(0, at);
        if (clipMeant(clips, name) >= 0)
            return {fmt::format("'{}' is no time in the clip '{}'", reference.substr(at + 1), name),
                    fmt::format("give seconds, as in {}@0.5", name)};
    }
    const auto alike = clipsWhere(clips, [&](std::string_view name) {
        return sameButCase(name, reference) || isAction(name, reference) || endsInWords(name, reference);
    });
    if (alike.size() > 1)
        return {fmt::format("'{}' may be any of {} clips", reference, alike.size()),
                "name one of " + listed(clips, alike)};
    const std::string word = lowerCased(reference);
    const auto holding = clipsWhere(clips, [&](std::string_view name) {
        return !word.empty() && lowerCased(name).find(word) != std::string::npos;
    });
    if (!holding.empty()) return {none, "clips that hold this are " + listed(clips, holding)};
    return {none, "the clips are " + listed(clips, clipsWhere(clips, [](std::string_view) { return true; }))};
}

std::string clipReferences(std::span<const Clip> clips) {
    std::string all;
    for (std::size_t clip = 0; clip < clips.size(); ++clip)
        all += (all.empty() ? "" : ", ") + clipReference(clips, clip);
    return all;
}

}  // namespace lutka::animation
