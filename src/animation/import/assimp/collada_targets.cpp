#include "animation/import/assimp/collada_targets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <set>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "animation/import/assimp/collada_text.hpp"
#include "animation/import/name_list.hpp"
#include "core/letter_case.hpp"

namespace lutka::animation::rig_import {
namespace {

// What a target leads to.
struct TargetPlace {
    std::size_t node = 0;
    const ColladaTransform* transform = nullptr;
    std::string_view member;  // ".X", "(3)", "(0)(3)"; empty: the whole
};

// The node that the first part of a target calls, and what follows it. Ids may hold slashes.
std::optional<std::pair<std::size_t, std::string_view>> nodeOfTarget(std::string_view target,
                                                                     const ColladaNodes& nodes) {
    for (std::size_t slash = target.rfind('/'); slash != std::string_view::npos && slash > 0;
         slash = target.rfind('/', slash - 1)) {
        if (const auto node = nodes.withId(target.substr(0, slash))) return std::pair(*node, target.substr(slash + 1));
    }
    const std::size_t slash = target.find('/');
    if (slash == std::string_view::npos) return std::nullopt;
    std::optional<std::size_t> node = nodes.withSid(target.substr(0, slash), {});
    if (!node) node = nodes.withName(target.substr(0, slash));
    return node ? std::optional(std::pair(*node, target.substr(slash + 1))) : std::nullopt;
}

const ColladaTransform* stepCalled(const ColladaNode& node, std::string_view sid) {
    const auto found = std::find_if(node.transforms.begin(), node.transforms.end(),
                                    [&](const ColladaTransform& transform) { return transform.sid == sid; });
    return sid.empty() || found == node.transforms.end() ? nullptr : &*found;
}

std::optional<TargetPlace> placeOfTarget(std::string_view target, const ColladaNodes& nodes) {
    constexpr std::size_t kLongest = 4096;  // many slashes are looked at one by one
    if (target.size() > kLongest) return std::nullopt;
    auto at = nodeOfTarget(target, nodes);
    // Nodes below it by their sids.
    for (std::size_t slash = 0; at && (slash = at->second.find('/')) != std::string_view::npos;) {
        const std::size_t root = at->first;
        const auto next = nodes.withSid(at->second.substr(0, slash), {&root, 1});
        at = next ? std::optional(std::pair(*next, at->second.substr(slash + 1))) : std::nullopt;
    }
    if (!at) return std::nullopt;
    const ColladaNode& node = nodes.all()[at->first];
    std::string_view sid = at->second;
    TargetPlace place{at->first, stepCalled(node, sid), {}};
    // A dot before the bracket belongs to the name: "rotate.x(3)".
    const std::size_t bracket = sid.find('(');
    const std::size_t member = bracket != std::string_view::npos ? bracket : sid.rfind('.');
    if (place.transform == nullptr && member != std::string_view::npos) {
        place.member = sid.substr(member);
        place.transform = stepCalled(node, sid.substr(0, member));
    }
    return place.transform == nullptr ? std::nullopt : std::optional(place);
}

bool isIndex(std::string_view member) {
    return member.size() >= 3 && member.front() == '(' && member.back() == ')' &&
           std::all_of(member.begin(), member.end(),
                       [](char c) { return c == '(' || c == ')' || std::isdigit(static_cast<unsigned char>(c)) != 0; });
}

// A member as Assimp calls it; nothing where there is no such member.
std::optional<std::string> plainMember(const TargetPlace& place) {
    const std::string_view kind = place.transform->kind;
    if (place.member.empty()) return std::string();
    if (kind == "matrix") return isIndex(place.member) ? std::optional(std::string(place.member)) : std::nullopt;
    if (kind == "lookat") return std::nullopt;
    const std::string member = lowerCased(std::string(place.member));
    const std::size_t known = kind == "rotate" ? 4 : 3;
    constexpr const char* kNames[] = {".X", ".Y", ".Z", ".ANGLE"};
    for (std::size_t i = 0; i < known; ++i) {
        if (member == lowerCased(kNames[i]) || member == fmt::format("({})", i)) return kNames[i];
    }
    return std::nullopt;
}

// What channels move that are no transforms of nodes.
class OtherTargets {
  public:
    explicit OtherTargets(const std::vector<ColladaTag>& tags) {
        bool inMorph = false;
        for (const ColladaTag& tag : tags) {
            if (tag.opens("morph")) inMorph = true;
            if (tag.closes("morph")) inMorph = false;
            const bool morphs = inMorph || tag.opens("controller");
            ids_.emplace(colladaAttribute(tag.text, "id"), morphs);
            sids_.insert(colladaAttribute(tag.text, "sid"));
        }
    }

    void add(std::string_view target, bool isTransform) {
        const auto element = ids_.find(target.substr(0, target.find_first_of("/(")));
        const std::string_view rest = target.substr(std::min(target.rfind('/'), target.size()));
        const std::string_view sid = rest.empty() ? rest : rest.substr(1, rest.find_first_of(".(") - 1);
        const bool isOther = !isTransform && element != ids_.end();
        if (isOther && element->second)
            morphs_ = true;
        else if (isOther && (sid.empty() || sids_.count(sid) > 0))
            others_ = true;
        else
            absent_.emplace_back(target);
    }

    void tell(std::vector<std::string>& warnings) const {
        if (morphs_) warnings.emplace_back("left out: animations of morph targets");
        if (others_) warnings.emplace_back("left out: animations of other things than nodes");
        if (!absent_.empty())
            warnings.push_back(fmt::format("left out: animations of what is not in the file: {}", firstOf(absent_)));
    }

  private:
    std::unordered_map<std::string_view, bool> ids_;  // → whether it is part of a morph
    std::set<std::string_view> sids_;
    bool morphs_ = false;
    bool others_ = false;
    std::vector<std::string> absent_;
};

}  // namespace

void settleTargets(const ColladaDocument& document, const ColladaNodes& nodes, ColladaChanges& changes,
                   std::vector<std::string>& warnings) {
    const std::vector<ColladaTag>& tags = document.tags;
    OtherTargets others(tags);
    for (std::size_t i = 0; i < tags.size(); ++i) {
        const ColladaTag& tag = tags[i];
        if (!tag.opens("channel")) continue;
        const std::string_view target = colladaAttribute(tag.text, "target");
        const std::optional<TargetPlace> place = placeOfTarget(target, nodes);
        const std::optional<std::string> member = place ? plainMember(*place) : std::nullopt;
        if (!member) {
            others.add(target, place.has_value());
            const bool closes = !tag.isEmpty() && i + 1 < tags.size() && tags[i + 1].closes("channel");
            if (tag.isEmpty() || closes) changes.push_back({tag.start, closes ? tags[i + 1].end : tag.end, ""});
            continue;
        }
        const ColladaNode& node = nodes.all()[place->node];
        const std::string plain = fmt::format("{}/{}{}", node.ownId, place->transform->ownSid, *member);
        if (plain == target) continue;
        const std::size_t start = tag.start + static_cast<std::size_t>(target.data() - tag.text.data());
        changes.push_back({start, start + target.size(), plain});
    }
    others.tell(warnings);
}

}  // namespace lutka::animation::rig_import
