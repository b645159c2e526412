#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "core/result.hpp"

/// Reports as HTML pages of one file: see docs/report.md.
namespace lutka::reporting {

/// The texts that pages are made of.
struct PageParts {
    std::string model;        ///< Template of a model's page.
    std::string library;      ///< Template of a library's page.
    std::string style;        ///< CSS of both.
    std::string modelView;    ///< JavaScript: the view of the falling doll.
    std::string libraryView;  ///< JavaScript: sorting and searching the table.
    std::string three;        ///< three.js, the build that gives a global THREE; of a model's page.
};

enum class PageKind { model, library };

/// Reads our own from assets/report and, for a model's page, three.js from the first of these that is there:
/// $LUTKA_THREE_JS, assets/report/three.min.js, and where Debian's libjs-three has it. Fails with ErrorCode::input when
/// a file is missing, or when what lies there is no classic build of three.js.
[[nodiscard]] Result<PageParts> loadPageParts(PageKind kind);

/// The template with each `{{name}}` replaced by the value of that name; what is put in is not looked through again.
/// A name without a value is a caller's bug, and becomes nothing.
[[nodiscard]] std::string filled(std::string_view text,
                                 std::initializer_list<std::pair<std::string_view, std::string_view>> values);

}  // namespace lutka::reporting
