#include "animation/import/assimp/collada_skins.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "animation/import/assimp/collada_text.hpp"

namespace lutka::animation::rig_import {
namespace {

constexpr std::size_t kMostOfCopies = std::size_t{16} << 20U;  // bytes of copies of skins
constexpr std::string_view kListBlanks = " \t\r\n";

// A skin's controller, with the list of its joints.
struct SkinController {
    std::size_t first = 0;  // tag
    std::size_t past = 0;
    std::size_t listStart = 0;  // in the text
    std::size_t listEnd = 0;
    std::size_t count = 0;  // of joints, as the file states it
    bool areIds = false;    // else sids
};

// Where a skin is shown: the tag that shows it, and the tops of its skeleton.
struct ShownSkin {
    std::size_t tag = 0;
    std::vector<std::size_t> roots;
};

std::vector<std::string_view> listed(std::string_view text) {
    std::vector<std::string_view> words;
    for (std::size_t at = text.find_first_not_of(kListBlanks); at != std::string_view::npos;) {
        const std::size_t end = std::min(text.find_first_of(kListBlanks, at), text.size());
        words.push_back(text.substr(at, end - at));
        at = text.find_first_not_of(kListBlanks, end);
    }
    return words;
}

std::map<std::string, SkinController> skinControllersOf(const ColladaDocument& document) {
    const std::vector<ColladaTag>& tags = document.tags;
    std::map<std::string, SkinController> controllers;
    for (std::size_t i = 0; i < tags.size(); ++i) {
        if (!tags[i].opens("controller")) continue;
        const std::optional<std::size_t> past = pastColladaElement(tags, i, "controller");
        if (!past) break;
        SkinController controller;
        controller.first = i;
        controller.past = *past;
        std::string joints;  // the source that lists them
        bool inJoints = false;
        for (std::size_t at = i; at < *past; ++at) {
            if (tags[at].opens("joints")) inJoints = true;
            if (tags[at].closes("joints")) inJoints = false;
            if (inJoints && tags[at].opens("input") && colladaAttribute(tags[at].text, "semantic") == "JOINT")
                joints = tags[at].target("source");
        }
        std::string source;
        for (std::size_t at = i; at + 1 < *past; ++at) {
            if (tags[at].opens("source")) source = colladaAttribute(tags[at].text, "id");
            const bool areIds = tags[at].opens("IDREF_array");
            if (joints.empty() || source != joints || (!areIds && !tags[at].opens("Name_array"))) continue;
            controller.areIds = areIds;
            controller.listStart = tags[at].end;
            controller.listEnd = tags[at].isEmpty() ? tags[at].end : tags[at + 1].start;
            const std::string_view count = colladaAttribute(tags[at].text, "count");
            std::from_chars(count.data(), count.data() + count.size(), controller.count);
        }
        const std::string id(colladaAttribute(tags[i].text, "id"));
        if (!id.empty() && controller.listEnd > controller.listStart) controllers.emplace(id, controller);
        i = *past - 1;
    }
    return controllers;
}

std::map<std::string, std::vector<ShownSkin>> instancesOf(const ColladaDocument& document, const ColladaNodes& nodes) {
    std::map<std::string, std::vector<ShownSkin>> shown;
    std::vector<ShownSkin>* open = nullptr;
    for (std::size_t i = 0; i + 1 < document.tags.size(); ++i) {
        const ColladaTag& tag = document.tags[i];
        if (tag.opens("instance_controller")) {
            open = &shown[tag.target("url")];
            open->push_back({i, {}});
        }
        if (tag.closes("instance_controller")) open = nullptr;
        constexpr std::size_t kMostRoots = 256;
        if (open == nullptr || !tag.opens("skeleton") || open->back().roots.size() >= kMostRoots) continue;
        const auto link = listed(document.text.substr(tag.end, document.tags[i + 1].start - tag.end));
        if (link.empty() || !link[0].starts_with('#')) continue;
        if (const std::optional<std::size_t> root = nodes.withId(link[0].substr(1)))
            open->back().roots.push_back(*root);
    }
    return shown;
}

std::optional<std::size_t> jointCalled(std::string_view word, const ColladaNodes& nodes, bool isId,
                                       const std::vector<std::size_t>& roots) {
    std::optional<std::size_t> joint = isId ? nodes.withId(word) : nodes.withSid(word, roots);
    if (!joint) joint = isId ? nodes.withSid(word, roots) : nodes.withId(word);
    if (!joint) joint = nodes.withSid(word, {});
    return joint ? joint : nodes.withName(word);
}

// The ids of a skin's joints; words that call no node stay. Exporters exist that write names with blanks: where the
// list has more words than the file states joints, as many of them as call a node are one.
std::vector<std::string> jointIds(std::string_view list, const SkinController& controller, const ColladaNodes& nodes,
                                  const std::vector<std::size_t>& roots) {
    constexpr std::size_t kMostWords = 8;  // of a name
    const std::vector<std::string_view> words = listed(list);
    const bool haveBlanks = controller.count > 0 && words.size() > controller.count;
    std::vector<std::string> ids;
    for (std::size_t at = 0; at < words.size();) {
        std::optional<std::size_t> joint;
        std::size_t taken = haveBlanks ? std::min(kMostWords, words.size() - at) : 1;
        for (; taken > 0 && !joint; taken -= joint ? 0 : 1) {
            const char* const end = words[at + taken - 1].data() + words[at + taken - 1].size();
            joint = jointCalled({words[at].data(), static_cast<std::size_t>(end - words[at].data())}, nodes,
                                controller.areIds, roots);
        }
        ids.push_back(joint && !nodes.all()[*joint].ownId.empty() ? nodes.all()[*joint].ownId : std::string(words[at]));
        at += std::max<std::size_t>(taken, 1);
    }
    return ids;
}

// A controller once more, with other ids for all that is in it, and that list of joints.
std::string skinCopy(const ColladaDocument& document, const SkinController& controller, const std::string& suffix,
                     const std::string& list) {
    std::set<std::string_view> own;
    for (std::size_t i = controller.first; i < controller.past; ++i)
        own.insert(colladaAttribute(document.tags[i].text, "id"));
    own.erase("");
    std::string copy;
    std::size_t at = document.tags[controller.first].start;
    for (std::size_t i = controller.first; i < controller.past; ++i) {
        const ColladaTag& tag = document.tags[i];
        std::vector<std::size_t> ends;  // of names that are the controller's own
        for (const char* attribute : {"id", "source"}) {
            std::string_view value = colladaAttribute(tag.text, attribute);
            if (value.starts_with('#')) value.remove_prefix(1);
            if (own.count(value) == 0) continue;
            ends.push_back(tag.start + static_cast<std::size_t>(value.data() - tag.text.data()) + value.size());
        }
        std::sort(ends.begin(), ends.end());
        for (const std::size_t end : ends) {
            copy += document.text.substr(at, end - at);
            copy += suffix;
            at = end;
        }
        if (tag.end == controller.listStart) {
            copy += document.text.substr(at, tag.end - at);
            copy += list;
            at = controller.listEnd;
        }
    }
    copy += document.text.substr(at, document.tags[controller.past - 1].end - at);
    return copy;
}

}  // namespace

void settleSkins(const ColladaDocument& document, const ColladaNodes& nodes, ColladaChanges& changes,
                 std::vector<std::string>& warnings) {
    const std::map<std::string, SkinController> controllers = skinControllersOf(document);
    if (controllers.empty()) return;
    std::size_t copied = 0;
    bool shares = false;
    for (const auto& [id, shown] : instancesOf(document, nodes)) {
        const auto found = controllers.find(id);
        if (found == controllers.end()) continue;
        const SkinController& controller = found->second;
        const std::string_view list =
            document.text.substr(controller.listStart, controller.listEnd - controller.listStart);
        const std::size_t end = document.tags[controller.past - 1].end;
        std::vector<std::string> lists;  // of which the first stands in the controller itself
        for (const ShownSkin& instance : shown) {
            if (!lists.empty()) copied += list.size();  // which is looked through once more
            shares = shares || copied > kMostOfCopies;
            if (copied > kMostOfCopies) break;
            const std::string own =
                fmt::format("{}", fmt::join(jointIds(list, controller, nodes, instance.roots), " "));
            const auto known = std::find(lists.begin(), lists.end(), own);
            std::size_t copy = static_cast<std::size_t>(known - lists.begin());
            if (known == lists.end()) {
                if (copy > 0) copied += end - document.tags[controller.first].start;
                shares = shares || copied > kMostOfCopies;
                if (copied > kMostOfCopies) continue;
                lists.push_back(own);
                if (copy == 0 && own != list) changes.push_back({controller.listStart, controller.listEnd, own});
                if (copy > 0)
                    changes.push_back({end, end, skinCopy(document, controller, fmt::format("-own-{}", copy), own)});
            }
            if (copy == 0) continue;
            const ColladaTag& tag = document.tags[instance.tag];
            const std::size_t place = tag.start + tag.text.find('#' + id) + 1 + id.size();
            changes.push_back({place, place, fmt::format("-own-{}", copy)});
        }
    }
    if (shares) warnings.emplace_back("one skin is shown with several skeletons: all of its meshes follow the first");
}

}  // namespace lutka::animation::rig_import
