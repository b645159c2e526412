#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lutka::animation::rig_import {

/// A tag of a Collada document with its place in the text, which it points into.
struct ColladaTag {
    std::size_t start = 0;
    std::size_t end = 0;  ///< One past its '>'.
    std::string_view text;

    [[nodiscard]] bool opens(std::string_view name) const;
    [[nodiscard]] bool closes(std::string_view name) const;
    [[nodiscard]] bool isEmpty() const { return text.ends_with("/>"); }
    /// The target of a link into this document; empty where it is none.
    [[nodiscard]] std::string target(std::string_view attribute) const;
};

/// All tags, in their order; comments, sections of character data and instructions are none.
[[nodiscard]] std::vector<ColladaTag> colladaTags(std::string_view text);

/// A document as UTF-8, which must outlive this, with all of its tags.
struct ColladaDocument {
    explicit ColladaDocument(std::string_view document) : text(document), tags(colladaTags(document)) {}

    std::string_view text;
    std::vector<ColladaTag> tags;
};

/// One past the tag that closes the element which tag `first` opens; nothing where none does.
[[nodiscard]] std::optional<std::size_t> pastColladaElement(const std::vector<ColladaTag>& tags, std::size_t first,
                                                            std::string_view name);

/// What comes in place of a part of a text; parts of no length are places.
struct ColladaChange {
    std::size_t start = 0;
    std::size_t end = 0;
    std::string with;
};
using ColladaChanges = std::vector<ColladaChange>;

/// Replaces parts of a text, in their order. Keeps a reference to it.
class ColladaEdits {
  public:
    explicit ColladaEdits(const std::string& text) : text_(text) {}

    void replace(std::size_t start, std::size_t end, std::string_view with);
    /// The whole text; called once.
    [[nodiscard]] std::string take();

  private:
    const std::string& text_;
    std::string out_;
    std::size_t at_ = 0;
};

}  // namespace lutka::animation::rig_import
