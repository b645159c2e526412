#include "animation/import/assimp/collada_links.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "animation/import/assimp/collada_text.hpp"

namespace lutka::animation::rig_import {
namespace {

constexpr int kMostNested = 64;  // of library nodes in library nodes, of controllers over controllers

// Controllers by their ids: what each deforms, and whether as a morph.
struct Controller {
    std::string source;
    bool isMorph = false;
};

std::map<std::string, Controller> controllersOf(const std::vector<ColladaTag>& tags) {
    std::map<std::string, Controller> controllers;
    std::string id;
    for (const ColladaTag& tag : tags) {
        if (tag.opens("controller")) id = colladaAttribute(tag.text, "id");
        if (tag.closes("controller")) id.clear();
        const bool isMorph = tag.opens("morph");
        if (!id.empty() && (isMorph || tag.opens("skin"))) controllers[id] = {tag.target("source"), isMorph};
    }
    return controllers;
}

// What a link is to lead to, past all morph controllers, whose ids go to `passed`; empty where it may stay.
std::string pastMorphs(const std::map<std::string, Controller>& controllers, const std::string& first,
                       std::set<std::string>& passed) {
    std::string at = first;
    std::vector<std::string> morphs;
    for (int i = 0; i < kMostNested; ++i) {
        const auto found = controllers.find(at);
        if (found == controllers.end() || !found->second.isMorph) break;
        morphs.push_back(at);
        at = found->second.source;
    }
    const auto end = controllers.find(at);
    const bool isController = end != controllers.end();
    // A ring of morphs, or too long a row of them, ends at a morph still.
    if (at == first || at.empty() || (isController && end->second.isMorph)) return {};
    passed.insert(morphs.begin(), morphs.end());
    return at;
}

std::string withoutMorphs(const std::string& text) {
    const std::vector<ColladaTag> tags = colladaTags(text);
    const std::map<std::string, Controller> controllers = controllersOf(tags);
    std::map<std::size_t, std::string> links;  // tag → what it leads to
    std::set<std::string> passed;
    std::vector<std::string> kept;  // what links lead to that stay
    for (std::size_t i = 0; i < tags.size(); ++i) {
        const bool isSkin = tags[i].opens("skin");
        if (!isSkin && !tags[i].opens("instance_controller")) continue;
        const std::string target = tags[i].target(isSkin ? "source" : "url");
        const std::string past = pastMorphs(controllers, target, passed);
        if (past.empty()) kept.push_back(target);
        if (!past.empty()) links[i] = past;
    }
    // Those stay that something still leads to, and what they are over.
    for (std::string at : kept) {
        while (passed.erase(at) > 0)
            at = controllers.at(at).source;
    }
    // Assimp gives no mesh to what shows a morph over a geometry: it shows the geometry.
    constexpr std::string_view kController = "instance_controller";
    std::set<std::size_t> renamed;  // tags
    std::size_t next = 0;           // past the element before: none stands in another
    for (const auto& [tag, past] : links) {
        if (tag < next || tags[tag].opens("skin") || controllers.count(past) > 0) continue;
        const std::optional<std::size_t> end = pastColladaElement(tags, tag, kController);
        if (!end) break;
        next = *end;
        renamed.insert(tag);
        renamed.insert(next - 1);
    }
    ColladaEdits edits(text);
    for (std::size_t i = 0; i < tags.size(); ++i) {
        if (renamed.count(i) > 0) {
            const std::size_t name = tags[i].start + tags[i].text.find(kController);
            edits.replace(name, name + kController.size(), "instance_geometry");
        }
        if (tags[i].opens("controller") && passed.count(std::string(colladaAttribute(tags[i].text, "id"))) > 0) {
            const std::optional<std::size_t> past = pastColladaElement(tags, i, "controller");
            if (!past) break;
            edits.replace(tags[i].start, tags[*past - 1].end, "");
            i = *past - 1;
        } else if (const auto link = links.find(i); link != links.end()) {
            const std::string target = tags[i].target(tags[i].opens("skin") ? "source" : "url");
            const std::size_t place = tags[i].start + tags[i].text.find('#' + target) + 1;
            edits.replace(place, place + target.size(), link->second);
        }
    }
    return edits.take();
}

// Nodes of the libraries that are shown once, and where.
class LibraryNodes {
  public:
    explicit LibraryNodes(const std::string& text) : text_(text), tags_(colladaTags(text)) {
        std::map<std::string, int> uses;
        for (const ColladaTag& tag : tags_) {
            if (tag.opens("instance_node")) ++uses[tag.target("url")];
        }
        bool inLibrary = false;
        for (std::size_t i = 0; i < tags_.size(); ++i) {
            if (tags_[i].opens("library_nodes")) inLibrary = !tags_[i].isEmpty();
            if (tags_[i].closes("library_nodes")) inLibrary = false;
            if (!inLibrary || !tags_[i].opens("node")) continue;
            const std::optional<std::size_t> past = pastColladaElement(tags_, i, "node");
            if (!past) break;
            const std::string id(colladaAttribute(tags_[i].text, "id"));
            if (!id.empty() && uses[id] == 1) moved_[id] = {i, *past};
            i = *past - 1;  // those below it come along
        }
    }

    [[nodiscard]] std::string moved() {
        if (moved_.empty()) return text_;
        std::string out;
        write(0, tags_.size(), 0, true, out);
        return out;
    }

  private:
    [[nodiscard]] std::size_t startOf(std::size_t tag) const {
        return tag < tags_.size() ? tags_[tag].start : text_.size();
    }

    // The tags from `first` to `last` and the text between them.
    void write(std::size_t first, std::size_t last, int depth, bool whole, std::string& out) {
        std::size_t at = whole ? 0 : startOf(first);
        const auto copyTo = [&](std::size_t end) { out += std::string_view(text_).substr(at, end - at); };
        for (std::size_t i = first; i < last; ++i) {
            const ColladaTag& tag = tags_[i];
            const auto own =
                tag.opens("node") ? moved_.find(std::string(colladaAttribute(tag.text, "id"))) : moved_.end();
            if (own != moved_.end() && own->second.first == i && (i != first || whole)) {
                copyTo(tag.start);  // it stands elsewhere
                i = own->second.second - 1;
                at = tags_[i].end;
                continue;
            }
            const auto shown = tag.opens("instance_node") ? moved_.find(tag.target("url")) : moved_.end();
            if (shown == moved_.end() || depth >= kMostNested) continue;
            copyTo(tag.start);
            write(shown->second.first, shown->second.second, depth + 1, false, out);
            if (!tag.isEmpty() && !broken_) {
                const std::optional<std::size_t> past = pastColladaElement(tags_, i, "instance_node");
                broken_ = !past;
                i = past.value_or(i + 1) - 1;
            }
            at = tags_[i].end;
        }
        copyTo(whole ? text_.size() : tags_[last - 1].end);
    }

    const std::string& text_;
    std::vector<ColladaTag> tags_;
    bool broken_ = false;  // an element has no end, which is looked for once
    std::map<std::string, std::pair<std::size_t, std::size_t>> moved_;  // id → its first tag, and the one past it
};

bool mentions(std::string_view text, std::string_view what) {
    return text.find(what) != std::string_view::npos;
}

}  // namespace

bool holdsMorphs(const ColladaDocument& document) {
    const std::vector<ColladaTag>& tags = document.tags;
    bool inMorph = false;
    for (std::size_t i = 0; i + 1 < tags.size(); ++i) {
        if (tags[i].opens("morph")) inMorph = true;
        if (tags[i].closes("morph")) inMorph = false;
        if (!inMorph || !tags[i].opens("float_array")) continue;  // the weights: targets are names
        const std::string_view numbers = document.text.substr(tags[i].end, tags[i + 1].start - tags[i].end);
        if (numbers.find_first_of("123456789") != std::string_view::npos) return true;
    }
    return false;
}

ShownCollada shownCollada(std::string text) {
    const std::vector<ColladaTag> tags = colladaTags(text);
    std::vector<std::size_t> scenes;
    bool names = false;  // the document one that is there
    std::string shown;
    std::size_t end = std::string::npos;
    ColladaChanges changes;
    for (std::size_t i = 0; i < tags.size(); ++i) {
        if (tags[i].opens("visual_scene")) scenes.push_back(i);
        if (tags[i].opens("instance_visual_scene")) {
            shown = tags[i].target("url");
            changes.push_back({tags[i].start, tags[i].end, tags[i].isEmpty() ? "" : "<extra>"});
        }
        if (tags[i].closes("instance_visual_scene")) changes.push_back({tags[i].start, tags[i].end, "</extra>"});
        if (tags[i].closes("COLLADA")) end = tags[i].start;
    }
    for (const std::size_t scene : scenes)
        names = names || (!shown.empty() && colladaAttribute(tags[scene].text, "id") == shown);
    if (names || scenes.empty() || end == std::string::npos) return {std::move(text), {}};
    const ColladaTag& first = tags[scenes.front()];
    std::string id(colladaAttribute(first.text, "id"));
    if (id.empty()) {
        id = "own-scene";
        const std::size_t place = first.start + std::string_view("<visual_scene").size();
        changes.push_back({place, place, " id=\"" + id + "\""});
    }
    changes.push_back({end, end, "<scene><instance_visual_scene url=\"#" + id + "\"/></scene>"});
    std::sort(changes.begin(), changes.end(),
              [](const ColladaChange& a, const ColladaChange& b) { return a.start < b.start; });
    ColladaEdits edits(text);
    for (const ColladaChange& change : changes)
        edits.replace(change.start, change.end, change.with);
    ShownCollada out{edits.take(), {}};
    if (scenes.size() > 1) out.warning = "the file does not say which of its scenes it shows: took the first";
    return out;
}

std::string linkedCollada(std::string text) {
    if (mentions(text, "<morph")) text = withoutMorphs(text);
    if (mentions(text, "<library_nodes") && mentions(text, "<channel")) text = LibraryNodes(text).moved();
    return text;
}

}  // namespace lutka::animation::rig_import
