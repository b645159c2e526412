#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace lutka::test {

/// An element of an XML document of the plain kind that we write: no text, comments or CDATA.
struct XmlTag {
    std::string name;
    std::map<std::string, std::string> attributes;
    int parent = -1;  ///< Index of the element around it.

    [[nodiscard]] const std::string& operator[](const std::string& key) const { return attributes.at(key); }
    /// The attribute's numbers.
    [[nodiscard]] std::vector<float> numbers(const std::string& key) const;
};

/// The elements in the order of their beginnings. Fails the test when tags don't nest.
[[nodiscard]] std::vector<XmlTag> xmlTags(std::string_view document);

}  // namespace lutka::test
