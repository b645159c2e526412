#include "report/page.hpp"

#include <cstdlib>
#include <fstream>

#include "support/catch.hpp"
#include "support/command.hpp"
#include "support/skip.hpp"

using namespace lutka;
using namespace lutka::reporting;

namespace {

/// Names a three.js for as long as it lives.
class NamedThree {
  public:
    explicit NamedThree(const std::string& file) { ::setenv("LUTKA_THREE_JS", file.c_str(), 1); }
    ~NamedThree() { ::unsetenv("LUTKA_THREE_JS"); }
    NamedThree(const NamedThree&) = delete;
    NamedThree& operator=(const NamedThree&) = delete;
};

}  // namespace

TEST_CASE("a template is filled once: what is put in is not looked through again") {
    CHECK(filled("<p>{{a}} {{b}} {{a}}</p>", {{"a", "{{b}}"}, {"b", "2"}}) == "<p>{{b}} 2 {{b}}</p>");
    CHECK(filled("no names", {}) == "no names");
    CHECK(filled("open {{a", {{"a", "1"}}) == "open {{a");
}

TEST_CASE("without three.js a model's page can't be made, and the message says what mends it") {
    const NamedThree nowhere("/nowhere/three.min.js");
    const auto parts = loadPageParts(PageKind::model);
    REQUIRE_FALSE(parts);
    CHECK(parts.error().code == ErrorCode::input);
    CHECK(parts.error().location == "/nowhere/three.min.js");
    CHECK_THAT(parts.error().mend, Catch::Contains("libjs-three"));
}

TEST_CASE("a file that is no classic build of three.js is refused") {
    const test::ScratchFolder folder;
    const std::string module = folder / "three.module.min.js";
    std::ofstream(module) << "class SkinnedMesh {} export { SkinnedMesh };";
    const NamedThree named(module);
    const auto parts = loadPageParts(PageKind::model);
    REQUIRE_FALSE(parts);
    CHECK_THAT(parts.error().text(), Catch::Contains("global THREE") && Catch::Contains("libjs-three"));
}

TEST_CASE("a library's page needs no three.js") {
    const NamedThree nowhere("/nowhere/three.min.js");
    const auto parts = loadPageParts(PageKind::library);
    REQUIRE(parts);
    CHECK(parts.value().three.empty());
    CHECK_THAT(parts.value().library, Catch::Contains("{{table}}"));
}
