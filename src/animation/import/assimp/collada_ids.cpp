#include "animation/import/assimp/collada_ids.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "animation/import/assimp/collada_tags.hpp"
#include "animation/import/assimp/collada_text.hpp"

namespace lutka::animation::rig_import {
namespace {

// Elements whose parts name each other by ids that mean nothing elsewhere.
bool isScope(const ColladaTag& tag) {
    return tag.opens("animation") || tag.opens("controller") || tag.opens("geometry");
}

bool endsScope(const ColladaTag& tag) {
    return tag.closes("animation") || tag.closes("controller") || tag.closes("geometry");
}

// Parts of them that others name by their ids.
bool isNamed(const ColladaTag& tag) {
    constexpr std::array<std::string_view, 6> kNamed = {"source",     "sampler",     "float_array",
                                                        "Name_array", "IDREF_array", "vertices"};
    return std::any_of(kNamed.begin(), kNamed.end(), [&](std::string_view name) { return tag.opens(name); });
}

// Ids that were taken already, and what the scopes that are open call them now.
class Ids {
  public:
    explicit Ids(const std::vector<ColladaTag>& tags) {
        int depth = 0;
        for (const ColladaTag& tag : tags) {
            if (endsScope(tag)) --depth;
            if (isScope(tag) && !tag.isEmpty()) ++depth;
            const std::string_view id = colladaAttribute(tag.text, "id");
            if (id.empty()) continue;
            all_.insert(id);
            if (depth <= 0 || !isNamed(tag)) taken_.insert(id);
        }
    }

    void open() { scopes_.emplace_back(); }
    void close() {
        if (scopes_.empty()) return;
        for (const std::string& id : scopes_.back())
            names_[id].pop_back();
        scopes_.pop_back();
    }
    [[nodiscard]] bool inScope() const { return !scopes_.empty(); }

    // What the element with this id is called from now on, in the innermost scope.
    std::string take(std::string_view id) {
        std::string own(id);
        if (!taken_.insert(id).second) {
            do {
                own = fmt::format("{}-{}", id, ++count_);
            } while (all_.count(own) > 0);
        }
        scopes_.back().emplace_back(id);
        names_[std::string(id)].push_back(own);
        return own;
    }

    [[nodiscard]] std::string find(const std::string& id) const {
        const auto found = names_.find(id);
        return found == names_.end() || found->second.empty() ? id : found->second.back();
    }

  private:
    std::unordered_set<std::string_view> all_;
    std::unordered_set<std::string_view> taken_;
    std::vector<std::vector<std::string>> scopes_;  // ids that each open scope took, the innermost last
    std::unordered_map<std::string, std::vector<std::string>> names_;  // what an id is called, the innermost last
    std::size_t count_ = 0;
};

// A sampler's element with another id.
std::string copyOf(std::string_view sampler, std::string_view id, const std::string& own) {
    const std::size_t place = sampler.find("\"" + std::string(id) + "\"") + 1;
    std::string copy(sampler);
    copy.replace(place, id.size(), own);
    return copy;
}

}  // namespace

std::string withOwnSamplers(std::string text) {
    constexpr std::size_t kMostCopied = std::size_t{16} << 20U;  // bytes
    if (text.find("<channel") == std::string::npos) return text;
    const std::vector<ColladaTag> tags = colladaTags(text);
    std::unordered_map<std::string, std::string_view> samplers;  // id → the whole element
    for (std::size_t i = 0; i < tags.size(); ++i) {
        if (!tags[i].opens("sampler")) continue;
        const std::optional<std::size_t> past = pastColladaElement(tags, i, "sampler");
        if (!past) break;  // nor does a later one end for sure: each would be looked for to the end of the document
        const std::string_view id = colladaAttribute(tags[i].text, "id");
        const std::size_t start = tags[i].start;
        i = *past - 1;
        if (!id.empty()) samplers[std::string(id)] = std::string_view(text).substr(start, tags[i].end - start);
    }
    std::unordered_map<std::string, std::size_t> uses;
    std::size_t copied = 0;
    ColladaEdits edits(text);
    for (const ColladaTag& tag : tags) {
        if (!tag.opens("channel")) continue;
        const std::string id = tag.target("source");
        const auto sampler = samplers.find(id);
        if (sampler == samplers.end()) continue;
        std::size_t& used = uses[id];
        std::string own = id;
        while (used > 0 && samplers.count(own) > 0)
            own = fmt::format("{}-{}", id, used++);
        used = std::max<std::size_t>(used, 1);
        if (own == id) continue;
        copied += sampler->second.size();
        if (copied > kMostCopied) break;
        edits.replace(tag.start, tag.start, copyOf(sampler->second, id, own));
        const std::size_t place = tag.start + tag.text.find('#' + id) + 1;
        edits.replace(place, place + id.size(), own);
    }
    return edits.take();
}

std::string withOwnIds(std::string text) {
    const std::vector<ColladaTag> tags = colladaTags(text);
    Ids ids(tags);
    ColladaEdits edits(text);
    const auto replace = [&](std::string_view old, const std::string& with) {
        if (old == with) return;
        const auto start = static_cast<std::size_t>(old.data() - text.data());
        edits.replace(start, start + old.size(), with);
    };
    for (const ColladaTag& tag : tags) {
        if (isScope(tag) && !tag.isEmpty()) ids.open();
        if (endsScope(tag)) ids.close();
        if (!ids.inScope()) continue;
        if (const std::string_view id = colladaAttribute(tag.text, "id"); !id.empty() && isNamed(tag)) {
            replace(id, ids.take(id));
            continue;
        }
        std::string_view link = colladaAttribute(tag.text, "source");
        if (!link.starts_with('#')) continue;
        link.remove_prefix(1);
        replace(link, ids.find(std::string(link)));
    }
    return edits.take();
}

}  // namespace lutka::animation::rig_import
