#include "animation/import/assimp/collada_tags.hpp"

#include <algorithm>
#include <utility>

#include "animation/import/assimp/collada_text.hpp"

namespace lutka::animation::rig_import {

bool ColladaTag::opens(std::string_view name) const {
    return text.size() > name.size() + 1 && text.substr(1).starts_with(name) &&
           std::string_view(" \t\r\n/>").find(text[name.size() + 1]) != std::string_view::npos;
}

bool ColladaTag::closes(std::string_view name) const {
    return text.starts_with("</") && text.substr(2).starts_with(name) &&
           std::string_view(" \t\r\n>").find(text[std::min(name.size() + 2, text.size() - 1)]) !=
               std::string_view::npos;
}

std::string ColladaTag::target(std::string_view attribute) const {
    const std::string_view value = colladaAttribute(text, attribute);
    return value.starts_with('#') ? std::string(value.substr(1)) : std::string();
}

std::vector<ColladaTag> colladaTags(std::string_view text) {
    std::vector<ColladaTag> tags;
    for (std::size_t at = text.find('<'); at < text.size(); at = text.find('<', at)) {
        const std::size_t end = endOfColladaMarkup(text, at);
        const std::string_view tag = text.substr(at, end - at);
        if (!tag.starts_with("<!") && !tag.starts_with("<?")) tags.push_back({at, end, tag});
        at = end;
    }
    return tags;
}

std::optional<std::size_t> pastColladaElement(const std::vector<ColladaTag>& tags, std::size_t first,
                                              std::string_view name) {
    int depth = 0;
    for (std::size_t i = first; i < tags.size(); ++i) {
        if (tags[i].opens(name) && !tags[i].isEmpty()) ++depth;
        if (tags[i].closes(name)) --depth;
        if (depth == 0) return i + 1;
    }
    return std::nullopt;
}

void ColladaEdits::replace(std::size_t start, std::size_t end, std::string_view with) {
    out_ += std::string_view(text_).substr(at_, start - at_);
    out_ += with;
    at_ = end;
}

std::string ColladaEdits::take() {
    out_ += std::string_view(text_).substr(at_);
    return std::move(out_);
}

}  // namespace lutka::animation::rig_import
