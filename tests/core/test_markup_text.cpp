#include "core/markup_text.hpp"
#include "core/utf8.hpp"
#include "support/catch.hpp"

using namespace lutka;

TEST_CASE("text of files can't be markup in a page or a file of XML") {
    CHECK(markupEscaped("<b>\"a\" & 'b'</b>") == "&lt;b&gt;&quot;a&quot; &amp; &#39;b&#39;&lt;/b&gt;");
    CHECK(markupEscaped("Šime\ttab") == "Šime\ttab");
}

TEST_CASE("what is no UTF-8 and control characters become the replacement character") {
    const std::string bad = "\xEF\xBF\xBD";
    CHECK(markupEscaped("a\xFF z") == "a" + bad + " z");
    CHECK(markupEscaped(std::string("a\0b", 3)) == "a" + bad + "b");
    CHECK(markupEscaped("\x1B[1m") == bad + "[1m");
    CHECK(wellFormedUtf8("\xC3\xA9\xC3", "?") == "\xC3\xA9?");
}
