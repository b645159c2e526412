#include "animation/import/assimp/collada_targets.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <vector>

#include "animation/import/assimp/collada_tags.hpp"
#include "animation/import/assimp/collada_text.hpp"
#include "core/letter_case.hpp"

namespace lutka::animation::rig_import {
namespace {

// The names by which channels call rotations, but for those that name something else, too.
std::set<std::string_view> rotationSids(const std::vector<ColladaTag>& tags) {
    std::set<std::string_view> rotations;
    std::set<std::string_view> others;
    for (const ColladaTag& tag : tags) {
        constexpr std::array<const char*, 4> kOthers = {"matrix", "translate", "scale", "lookat"};
        const bool isOther =
            std::any_of(kOthers.begin(), kOthers.end(), [&](const char* name) { return tag.opens(name); });
        if (tag.opens("rotate")) rotations.insert(colladaAttribute(tag.text, "sid"));
        if (isOther) others.insert(colladaAttribute(tag.text, "sid"));
    }
    for (const std::string_view other : others)
        rotations.erase(other);
    return rotations;
}

// What stands in place of a target; the target itself where it may stay.
std::string plainTarget(std::string_view target, const std::set<std::string_view>& rotations) {
    constexpr std::string_view kFourth = "(3)";
    const std::size_t slash = target.rfind('/');
    if (slash == std::string_view::npos) return std::string(target);
    const std::string_view part = target.substr(slash + 1);
    if (part.ends_with(kFourth) && rotations.count(part.substr(0, part.size() - kFourth.size())) > 0)
        return std::string(target.substr(0, target.size() - kFourth.size())) + ".ANGLE";
    const std::size_t dot = target.rfind('.');
    if (dot == std::string_view::npos || dot < slash) return std::string(target);
    const std::string member = lowerCased(std::string(target.substr(dot + 1)));
    for (const char* known : {"X", "Y", "Z", "ANGLE"})
        if (member == lowerCased(known)) return std::string(target.substr(0, dot + 1)) + known;
    return std::string(target);
}

}  // namespace

std::string withPlainTargets(const std::string& document) {
    const std::vector<ColladaTag> tags = colladaTags(document);
    const std::set<std::string_view> rotations = rotationSids(tags);
    ColladaEdits edits(document);
    for (const ColladaTag& tag : tags) {
        if (!tag.opens("channel")) continue;
        const std::string_view target = colladaAttribute(tag.text, "target");
        const std::string plain = plainTarget(target, rotations);
        if (plain == target) continue;
        const std::size_t start = tag.start + static_cast<std::size_t>(target.data() - tag.text.data());
        edits.replace(start, start + target.size(), plain);
    }
    return edits.take();
}

}  // namespace lutka::animation::rig_import
