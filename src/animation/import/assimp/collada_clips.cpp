#include "animation/import/assimp/collada_clips.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "animation/import/assimp/collada_sources.hpp"
#include "animation/import/assimp/collada_text.hpp"
#include "animation/import/channel_values.hpp"
#include "animation/import/clip_sampling.hpp"

namespace lutka::animation::rig_import {
namespace {

struct AnimationClip {
    std::string name;
    std::vector<std::string> animations;
    double start = 0.0;  // seconds
    double end = 0.0;    // not beyond the start where the file does not say
};

using Place = std::pair<std::size_t, std::size_t>;  // of an element: its first tag, and the one past it

struct Animations {
    std::vector<AnimationClip> clips;
    std::map<std::string, Place> places;  // by their ids
    std::set<std::string> names;          // that animations have
    std::size_t library = 0;              // the tag that opens it
};

double secondsIn(const ColladaTag& tag, std::string_view attribute) {
    const std::vector<double> numbers = colladaNumbers(colladaAttribute(tag.text, attribute));
    return numbers.empty() ? 0.0 : numbers.front();
}

Animations animationsOf(const std::vector<ColladaTag>& tags) {
    Animations found;
    bool hasLibrary = false;
    std::vector<std::size_t> open;  // animations
    for (std::size_t i = 0; i < tags.size(); ++i) {
        const ColladaTag& tag = tags[i];
        if (tag.opens("library_animations") && !tag.isEmpty() && !hasLibrary) {
            found.library = i;
            hasLibrary = true;
        }
        if (tag.opens("animation")) found.names.emplace(colladaAttribute(tag.text, "name"));
        if (tag.opens("animation") && !tag.isEmpty()) open.push_back(i);
        if (tag.closes("animation") && !open.empty()) {
            const std::string id(colladaAttribute(tags[open.back()].text, "id"));
            if (!id.empty()) found.places[id] = {open.back(), i + 1};
            open.pop_back();
        }
        if (tag.opens("animation_clip")) {
            const std::string_view name = colladaAttribute(tag.text, "name");
            found.clips.push_back({std::string(name.empty() ? colladaAttribute(tag.text, "id") : name),
                                   {},
                                   secondsIn(tag, "start"),
                                   secondsIn(tag, "end")});
        }
        if (tag.opens("instance_animation") && !found.clips.empty())
            found.clips.back().animations.push_back(tag.target("url"));
    }
    return found;
}

// Where the animations of a clip stand, in the document's order, without those in another of them.
std::vector<Place> placesOf(const AnimationClip& clip, const Animations& found) {
    std::set<Place> all;
    for (const std::string& id : clip.animations) {
        const auto place = found.places.find(id);
        if (place != found.places.end()) all.insert(place->second);
    }
    std::vector<Place> places;
    for (const Place& place : all) {
        if (places.empty() || place.first >= places.back().second) places.push_back(place);
    }
    return places;
}

// Whether an animation is, or stands in one, of two clips.
bool shareAnimations(const std::vector<std::vector<Place>>& placesByClip) {
    std::vector<Place> all;
    for (const std::vector<Place>& places : placesByClip)
        all.insert(all.end(), places.begin(), places.end());
    std::sort(all.begin(), all.end());
    const auto overlap = [](const Place& a, const Place& b) { return b.first < a.second; };
    return std::adjacent_find(all.begin(), all.end(), overlap) != all.end();
}

// What is in an animation, without the tags of animations in it.
std::string contentOf(const std::string& text, const std::vector<ColladaTag>& tags, const Place& place) {
    std::string content;
    for (std::size_t i = place.first; i + 1 < place.second; ++i) {
        if (!tags[i].opens("animation") && !tags[i].closes("animation")) content += tags[i].text;
        content += std::string_view(text).substr(tags[i].end, tags[i + 1].start - tags[i].end);
    }
    return content;
}

// All animations as one. The text stays as it is if there is one already, if they stand in several libraries, or if two
// move the same thing.
std::string inOneAnimation(const std::string& text, const std::vector<ColladaTag>& tags) {
    std::set<std::string_view> targets;
    std::set<std::string_view> names;
    std::size_t libraries = 0;
    std::size_t animations = 0;
    std::size_t depth = 0;
    std::optional<std::size_t> first;
    std::size_t last = 0;
    for (std::size_t i = 0; i < tags.size(); ++i) {
        const ColladaTag& tag = tags[i];
        if (tag.opens("channel") && !targets.insert(colladaAttribute(tag.text, "target")).second) return text;
        if (tag.opens("library_animations") && !tag.isEmpty() && ++libraries > 1) return text;
        if (tag.closes("animation") && depth-- == 0) return text;
        if (tag.opens("animation")) {
            ++animations;
            names.insert(colladaAttribute(tag.text, "name"));
            if (!first) first = i;
            if (!tag.isEmpty()) ++depth;
        }
        if (tag.opens("animation") || tag.closes("animation")) last = i + 1;
    }
    if (depth > 0) return text;
    if (animations < 2) return text;
    names.erase("");
    const std::string opening =
        names.size() == 1 ? fmt::format("<animation name=\"{}\">", *names.begin()) : std::string("<animation>");
    ColladaEdits edits(text);
    for (std::size_t i = *first; i < last; ++i) {
        const bool isAnimation = tags[i].opens("animation") || tags[i].closes("animation");
        const bool isEdge = i == *first || i + 1 == last;
        if (!isAnimation) continue;
        edits.replace(tags[i].start, tags[i].end, !isEdge ? "" : i == *first ? opening : "</animation>");
    }
    return edits.take();
}

// The part of a clip that the file calls by a name; nothing where that is all of it, or none of it.
std::optional<SourceClip> partOf(const SourceClip& whole, const AnimationClip& clip) {
    constexpr double kRounding = 1e-3;
    const auto [first, last] = spanOf(whole);
    const double end = std::min(clip.end, last);
    if (!(end > clip.start + kRounding) || (clip.start <= first + kRounding && end >= last - kRounding))
        return std::nullopt;
    SourceClip part = cutClip(whole, clip.start, end);
    part.name = clip.name;
    return part;
}

// The clips as the file states their beginnings and ends. Where they share a time line they become parts of it.
void cutColladaClips(const std::vector<AnimationClip>& named, bool share, std::vector<SourceClip>& clips) {
    constexpr std::size_t kMostKeys = 20'000'000;
    if (share && clips.size() == 1) {
        std::vector<SourceClip> parts;
        std::size_t keys = 0;
        for (const AnimationClip& clip : named) {
            std::optional<SourceClip> part = partOf(clips[0], clip);
            if (!part || keys > kMostKeys) return;
            for (const SourceChannel& channel : part->channels)
                keys += channel.times.size();
            parts.push_back(*std::move(part));
        }
        clips = std::move(parts);
        return;
    }
    for (SourceClip& clip : clips) {
        const auto own =
            std::find_if(named.begin(), named.end(), [&](const AnimationClip& one) { return one.name == clip.name; });
        if (own == named.end() && (named.size() != 1 || clips.size() != 1)) continue;
        if (std::optional<SourceClip> part = partOf(clip, own == named.end() ? named[0] : *own))
            clip = *std::move(part);
    }
}

}  // namespace

void settleColladaClips(const ColladaDocument& document, SourceScene& scene) {
    const Animations found = animationsOf(document.tags);
    std::set<std::string> names = found.names;
    names.erase("");
    for (const AnimationClip& clip : found.clips)
        names.insert(clip.name);
    std::string prefix;  // the name of the first, and "_"
    for (SourceClip& clip : scene.clips) {
        const std::size_t half = clip.name.size() / 2;
        const bool isTwice = clip.name.size() % 2 == 1 && clip.name[half] == '_' &&
                             clip.name.substr(0, half) == clip.name.substr(half + 1);
        const bool isSecond = !prefix.empty() && clip.name.starts_with(prefix);
        const std::string rest = isTwice    ? clip.name.substr(0, half)
                                 : isSecond ? clip.name.substr(prefix.size())
                                            : std::string();
        if (isTwice || names.count(rest) > 0) clip.name = rest;
        if (prefix.empty()) prefix = clip.name + "_";
    }
    std::vector<std::vector<Place>> places;
    for (const AnimationClip& clip : found.clips)
        places.push_back(placesOf(clip, found));
    cutColladaClips(found.clips, shareAnimations(places), scene.clips);
}

std::string gatheredCollada(std::string text) {
    if (text.find("<channel") == std::string::npos) return text;
    const std::vector<ColladaTag> tags = colladaTags(text);
    const Animations found = animationsOf(tags);
    if (found.clips.empty()) return inOneAnimation(text, tags);
    std::vector<std::vector<Place>> places;
    for (const AnimationClip& clip : found.clips)
        places.push_back(placesOf(clip, found));
    const bool shares = shareAnimations(places);
    std::map<std::size_t, std::size_t> moved;  // tags of animations that stand in a clip's: the first, and the one past
    std::string clips;
    for (std::size_t clip = 0; clip < places.size() && !shares; ++clip) {
        std::string content;
        for (const Place& place : places[clip]) {
            content += contentOf(text, tags, place);
            moved.insert(place);
        }
        if (!content.empty())
            clips += fmt::format("<animation name=\"{}\">{}</animation>", found.clips[clip].name, content);
    }
    ColladaEdits edits(text);
    for (std::size_t i = 0; i < tags.size(); ++i) {
        if (i == found.library && !clips.empty()) edits.replace(tags[i].end, tags[i].end, clips);
        const auto animation = moved.find(i);
        const bool isClips = tags[i].opens("library_animation_clips");
        if (!isClips && animation == moved.end()) continue;
        const std::optional<std::size_t> past =
            isClips ? pastColladaElement(tags, i, "library_animation_clips") : animation->second;
        if (!past) return text;
        edits.replace(tags[i].start, tags[*past - 1].end, "");
        i = *past - 1;
    }
    std::string out = edits.take();
    return clips.empty() ? inOneAnimation(out, colladaTags(out)) : out;
}

}  // namespace lutka::animation::rig_import
