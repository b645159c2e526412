#include "animation/clip_reference.hpp"

#include <algorithm>
#include <charconv>

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

}  // namespace

int clipMeant(std::span<const Clip> clips, std::string_view reference) {
    if (reference.empty()) return -1;
    const int numbered = clipOfNumber(clips, reference);
    return numbered >= 0 ? numbered : firstNamed(clips, reference);
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

std::string clipReferences(std::span<const Clip> clips) {
    std::string all;
    for (std::size_t clip = 0; clip < clips.size(); ++clip)
        all += (all.empty() ? "" : ", ") + clipReference(clips, clip);
    return all;
}

}  // namespace lutka::animation
