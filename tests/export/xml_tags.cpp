#include "export/xml_tags.hpp"

#include <regex>
#include <sstream>

#include "support/catch.hpp"

namespace lutka::test {

std::vector<float> XmlTag::numbers(const std::string& key) const {
    std::istringstream in(attributes.at(key));
    std::vector<float> values;
    for (float value = 0; in >> value;)
        values.push_back(value);
    REQUIRE(in.eof());
    return values;
}

std::vector<XmlTag> xmlTags(std::string_view document) {
    static const std::regex kTag("<(/?)([A-Za-z_:]+)([^<>]*?)(/?)>");
    static const std::regex kAttribute("([A-Za-z_:0-9]+)=\"([^\"]*)\"");
    const std::string text(document);
    std::vector<XmlTag> tags;
    std::vector<int> open;
    for (auto tag = std::sregex_iterator(text.begin(), text.end(), kTag); tag != std::sregex_iterator(); ++tag) {
        if ((*tag)[1].length() > 0) {
            REQUIRE(!open.empty());
            REQUIRE(tags[open.back()].name == (*tag)[2]);
            open.pop_back();
            continue;
        }
        XmlTag made{(*tag)[2], {}, open.empty() ? -1 : open.back()};
        const std::string rest = (*tag)[3];
        for (auto a = std::sregex_iterator(rest.begin(), rest.end(), kAttribute); a != std::sregex_iterator(); ++a)
            made.attributes[(*a)[1]] = (*a)[2];
        tags.push_back(std::move(made));
        if ((*tag)[4].length() == 0) open.push_back(static_cast<int>(tags.size()) - 1);
    }
    REQUIRE(open.empty());
    return tags;
}

}  // namespace lutka::test
