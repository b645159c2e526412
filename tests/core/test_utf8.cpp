#include "core/utf8.hpp"
#include "support/catch.hpp"

using namespace lutka;

TEST_CASE("control characters go, all others stay") {
    CHECK(withoutControls("\x1b[31mred\x7f\n", '_') == "_[31mred__");
    CHECK(withoutControls("\xC2\x9B"
                          "31m caf\xC3\xA9 \xC2\xA0 \xE2\x82\xAC",
                          '_') == "_31m caf\xC3\xA9 \xC2\xA0 \xE2\x82\xAC");
    CHECK(withoutControls(std::string_view("a\0b", 3), '?') == "a?b");
    CHECK(withoutControls("\xC2", '?') == "\xC2");  // cut off: no control
}
