#include "animation/import/assimp/collada_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <unordered_set>
#include <utility>

#include "animation/import/assimp/collada_skins.hpp"
#include "animation/import/assimp/collada_targets.hpp"
#include "animation/import/assimp/collada_text.hpp"

namespace lutka::animation::rig_import {
namespace {

// What Assimp takes for the end of a name in a target, or of a joint in a list.
constexpr std::string_view kEndsNames = " \t\r\n./()";

bool isPlain(std::string_view name) {
    return !name.empty() && name.find_first_of(kEndsNames) == std::string_view::npos;
}

std::string_view transformKind(const ColladaTag& tag) {
    constexpr std::array<std::string_view, 5> kKinds = {"translate", "rotate", "scale", "matrix", "lookat"};
    const auto kind =
        std::find_if(kKinds.begin(), kKinds.end(), [&](std::string_view name) { return tag.opens(name); });
    return kind == kKinds.end() ? std::string_view() : *kind;
}

// Puts `with` in place of an attribute's value, or the whole attribute in where the tag has none.
void writeAttribute(const ColladaTag& tag, std::string_view element, std::string_view attribute, std::string_view old,
                    const std::string& with, ColladaChanges& changes) {
    if (old == with) return;
    if (old.empty()) {
        const std::size_t place = tag.start + 1 + element.size();
        return changes.push_back({place, place, fmt::format(" {}=\"{}\"", attribute, with)});
    }
    const std::size_t start = tag.start + static_cast<std::size_t>(old.data() - tag.text.data());
    changes.push_back({start, start + old.size(), with});
}

void settleIds(const std::vector<ColladaTag>& tags, const ColladaNodes& nodes, ColladaChanges& changes,
               std::map<std::string, std::string>& names) {
    std::unordered_map<std::string_view, std::size_t> owners;
    for (std::size_t i = 0; i < nodes.all().size(); ++i)
        owners.emplace(nodes.all()[i].ownId, i);
    for (std::size_t i = 0; i < nodes.all().size(); ++i) {
        const ColladaNode& node = nodes.all()[i];
        if (node.ownId != node.id) {
            names[node.ownId] = !node.id.empty() ? node.id : !node.name.empty() ? node.name : node.sid;
            writeAttribute(tags[node.tag], "node", "id", node.id, node.ownId, changes);
        }
        // Assimp looks for ids among names, too, and takes the first that it meets.
        const auto owner = owners.find(node.name);
        if (!node.name.empty() && owner != owners.end() && owner->second != i)
            writeAttribute(tags[node.tag], "node", "name", node.name, "", changes);
        for (const ColladaTransform& transform : node.transforms)
            writeAttribute(tags[transform.tag], transform.kind, "sid", transform.sid, transform.ownSid, changes);
    }
    for (const ColladaTag& tag : tags) {
        const std::string target = tag.opens("instance_node") ? tag.target("url") : std::string();
        const std::optional<std::size_t> shown = nodes.withId(target);
        if (!shown || nodes.all()[*shown].ownId == target) continue;
        const std::string_view url = colladaAttribute(tag.text, "url");
        writeAttribute(tag, "instance_node", "url", url, '#' + nodes.all()[*shown].ownId, changes);
    }
}

}  // namespace

ColladaNodes::ColladaNodes(const std::vector<ColladaTag>& tags) {
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < tags.size(); ++i) {
        const ColladaTag& tag = tags[i];
        if (tag.opens("node")) {
            ColladaNode node;
            node.tag = i;
            node.id = colladaAttribute(tag.text, "id");
            node.sid = colladaAttribute(tag.text, "sid");
            node.name = colladaAttribute(tag.text, "name");
            node.end = nodes_.size() + 1;
            if (!tag.isEmpty()) open.push_back(nodes_.size());
            nodes_.push_back(std::move(node));
        } else if (tag.closes("node") && !open.empty()) {
            nodes_[open.back()].end = nodes_.size();
            open.pop_back();
        } else if (const std::string_view kind = transformKind(tag); !kind.empty() && !open.empty()) {
            nodes_[open.back()].transforms.push_back({kind, colladaAttribute(tag.text, "sid"), i, {}});
        }
    }
    for (const std::size_t unclosed : open)
        nodes_[unclosed].end = nodes_.size();
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        byId_[nodes_[i].id].push_back(i);
        bySid_[nodes_[i].sid].push_back(i);
        byName_[nodes_[i].name].push_back(i);
    }
    giveOwnIds(tags);
}

void ColladaNodes::giveOwnIds(const std::vector<ColladaTag>& tags) {
    std::unordered_set<std::string_view> taken;
    for (const ColladaTag& tag : tags)
        taken.insert(colladaAttribute(tag.text, "id"));
    std::size_t count = 0;
    for (ColladaNode& node : nodes_) {
        node.ownId = node.id;
        // An id with entities has no value that could be compared.
        const bool unread = node.id.empty() && tags[node.tag].text.find(" id=\"") != std::string_view::npos;
        while (!unread && (!isPlain(node.ownId) || (node.ownId != node.id && taken.count(node.ownId) > 0)))
            node.ownId = fmt::format("own-node-{}", count++);
        for (std::size_t i = 0; i < node.transforms.size(); ++i) {
            ColladaTransform& transform = node.transforms[i];
            transform.ownSid = transform.sid;
            if (!transform.sid.empty() && !isPlain(transform.sid)) transform.ownSid = fmt::format("own-step-{}", i);
        }
    }
}

std::optional<std::size_t> ColladaNodes::withId(std::string_view id) const {
    const auto found = byId_.find(id);
    return id.empty() || found == byId_.end() ? std::nullopt : std::optional(found->second.front());
}

std::optional<std::size_t> ColladaNodes::withSid(std::string_view sid, std::span<const std::size_t> roots) const {
    const auto found = bySid_.find(sid);
    if (sid.empty() || found == bySid_.end()) return std::nullopt;
    if (roots.empty()) return found->second.front();
    for (const std::size_t root : roots) {
        const auto first = std::lower_bound(found->second.begin(), found->second.end(), root);
        if (first != found->second.end() && *first < nodes_[root].end) return *first;
    }
    return std::nullopt;
}

std::optional<std::size_t> ColladaNodes::withName(std::string_view name) const {
    const auto found = byName_.find(name);
    return name.empty() || found == byName_.end() ? std::nullopt : std::optional(found->second.front());
}

SettledCollada settledCollada(const std::string& text) {
    SettledCollada out;
    const ColladaDocument document(text);
    const ColladaNodes nodes(document.tags);
    ColladaChanges changes;
    settleIds(document.tags, nodes, changes, out.names);
    settleSkins(document, nodes, changes, out.warnings);
    settleTargets(document, nodes, changes, out.warnings);
    std::stable_sort(changes.begin(), changes.end(),
                     [](const ColladaChange& a, const ColladaChange& b) { return a.start < b.start; });
    ColladaEdits edits(text);
    for (const ColladaChange& change : changes)
        edits.replace(change.start, change.end, change.with);
    out.text = edits.take();
    return out;
}

}  // namespace lutka::animation::rig_import
