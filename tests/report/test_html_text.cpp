#include "report/html_text.hpp"

#include <nlohmann/json.hpp>

#include "core/base64.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::reporting;

TEST_CASE("what a message has between grave accents is code, and nothing else is markup") {
    CHECK(htmlOfMessage("`lutka inspect` shows <it>; `--rig any`") ==
          "<code>lutka inspect</code> shows &lt;it&gt;; <code>--rig any</code>");
    CHECK(htmlOfMessage("one ` alone, and `<b>`") == "one <code> alone, and </code>&lt;b&gt;`");
    CHECK(htmlOfMessage("") == "");
}

TEST_CASE("JSON in a script element holds nothing that could end it, and reads back the same") {
    const nlohmann::ordered_json json = {{"name", "</script><!--<script>"}, {"bytes", "\xFF"}};
    const std::string text = scriptJson(json);
    CHECK(text.find('<') == std::string::npos);
    CHECK(nlohmann::json::parse(text)["name"] == "</script><!--<script>");
}

TEST_CASE("a closing tag in a script's own strings is written so that it closes nothing") {
    CHECK(scriptSource("a = '</script>' + '</ScRiPt >' + '</b>'") == "a = '<\\/script>' + '<\\/ScRiPt >' + '</b>'");
}

TEST_CASE("base64 gives the vectors of RFC 4648") {
    const std::pair<const char*, const char*> vectors[] = {{"", ""},
                                                           {"f", "Zg=="},
                                                           {"fo", "Zm8="},
                                                           {"foo", "Zm9v"},
                                                           {"foob", "Zm9vYg=="},
                                                           {"fooba", "Zm9vYmE="},
                                                           {"foobar", "Zm9vYmFy"}};
    for (const auto& [bytes, text] : vectors)
        CHECK(base64(bytes) == text);
    CHECK(base64("\xFF\xFE\xFD") == "//79");
}
