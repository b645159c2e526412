#include "animation/import/assimp/collada_clips.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "animation/import/assimp/collada_tags.hpp"
#include "animation/import/assimp/collada_text.hpp"

namespace lutka::animation::rig_import {
namespace {

struct AnimationClip {
    std::string name;
    std::vector<std::string> animations;
};

struct Animations {
    std::vector<AnimationClip> clips;
    std::map<std::string, std::pair<std::size_t, std::size_t>> places;  // id → its first tag, and the one past it
    std::size_t library = 0;                                            // the tag that opens it
};

Animations animationsOf(const std::vector<ColladaTag>& tags) {
    Animations found;
    bool hasLibrary = false;
    for (std::size_t i = 0; i < tags.size(); ++i) {
        const ColladaTag& tag = tags[i];
        if (tag.opens("library_animations") && !hasLibrary) {
            found.library = i;
            hasLibrary = true;
        }
        if (tag.opens("animation")) {
            const auto past = pastColladaElement(tags, i, "animation");
            const std::string id(colladaAttribute(tag.text, "id"));
            if (past && !id.empty()) found.places[id] = {i, *past};
        }
        if (tag.opens("animation_clip")) {
            const std::string_view name = colladaAttribute(tag.text, "name");
            found.clips.push_back({std::string(name.empty() ? colladaAttribute(tag.text, "id") : name), {}});
        }
        if (tag.opens("instance_animation") && !found.clips.empty())
            found.clips.back().animations.push_back(tag.target("url"));
    }
    return found;
}

bool shareAnimations(const std::vector<AnimationClip>& clips) {
    std::set<std::string> known;
    for (const AnimationClip& clip : clips) {
        for (const std::string& animation : clip.animations) {
            if (!known.insert(animation).second) return true;
        }
    }
    return false;
}

// What is in an animation, without the tags of animations in it.
std::string contentOf(const std::string& text, const std::vector<ColladaTag>& tags,
                      const std::pair<std::size_t, std::size_t>& place) {
    std::string content;
    for (std::size_t i = place.first; i + 1 < place.second; ++i) {
        if (!tags[i].opens("animation") && !tags[i].closes("animation")) content += tags[i].text;
        content += std::string_view(text).substr(tags[i].end, tags[i + 1].start - tags[i].end);
    }
    return content;
}

// All animations as one; the text as it is where they are one, or where two move the same thing.
std::string inOneAnimation(const std::string& text, const std::vector<ColladaTag>& tags) {
    std::set<std::string_view> targets;
    std::size_t animations = 0;
    std::optional<std::size_t> first;
    std::size_t last = 0;
    std::set<std::string_view> names;
    for (std::size_t i = 0; i < tags.size(); ++i) {
        if (tags[i].opens("channel") && !targets.insert(colladaAttribute(tags[i].text, "target")).second) return text;
        if (!tags[i].opens("animation")) continue;
        ++animations;
        names.insert(colladaAttribute(tags[i].text, "name"));
        const auto past = pastColladaElement(tags, i, "animation");
        if (!past) return text;
        if (!first) first = i;
        last = std::max(last, *past);
    }
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

}  // namespace

void settleColladaClips(std::string_view document, SourceScene& scene) {
    const std::vector<AnimationClip> named = animationsOf(colladaTags(document)).clips;
    const std::string prefix = named.empty() ? std::string() : named.front().name + "_";
    for (SourceClip& clip : scene.clips) {
        const std::size_t half = clip.name.size() / 2;
        const bool isTwice = clip.name.size() % 2 == 1 && clip.name[half] == '_' &&
                             clip.name.substr(0, half) == clip.name.substr(half + 1);
        const std::string rest = isTwice                         ? clip.name.substr(0, half)
                                 : clip.name.starts_with(prefix) ? clip.name.substr(prefix.size())
                                                                 : std::string();
        const auto isRest = [&](const AnimationClip& one) { return one.name == rest; };
        if (isTwice || std::any_of(named.begin(), named.end(), isRest)) clip.name = rest;
    }
}

std::string gatheredCollada(std::string text) {
    if (text.find("<channel") == std::string::npos) return text;
    const std::vector<ColladaTag> tags = colladaTags(text);
    const Animations found = animationsOf(tags);
    if (found.clips.empty()) return inOneAnimation(text, tags);
    std::map<std::size_t, std::size_t> moved;  // tags of animations that stand in a clip's: the first, and the one past
    std::string clips;
    for (const AnimationClip& clip : found.clips) {
        if (shareAnimations(found.clips)) break;
        std::string content;
        for (const std::string& id : clip.animations) {
            const auto place = found.places.find(id);
            if (place == found.places.end()) continue;
            content += contentOf(text, tags, place->second);
            moved.insert(place->second);
        }
        if (!content.empty()) clips += fmt::format("<animation name=\"{}\">{}</animation>", clip.name, content);
    }
    ColladaEdits edits(text);
    for (std::size_t i = 0; i < tags.size(); ++i) {
        if (i == found.library && !clips.empty()) edits.replace(tags[i].end, tags[i].end, clips);
        const auto animation = moved.find(i);
        const auto past = tags[i].opens("library_animation_clips")
                              ? pastColladaElement(tags, i, "library_animation_clips")
                          : animation != moved.end() ? std::optional<std::size_t>(animation->second)
                                                     : std::nullopt;
        if (!past || *past <= i) continue;
        edits.replace(tags[i].start, tags[*past - 1].end, "");
        i = *past - 1;
    }
    std::string out = edits.take();
    return clips.empty() ? inOneAnimation(out, colladaTags(out)) : out;
}

}  // namespace lutka::animation::rig_import
