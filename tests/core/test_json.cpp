#include "core/json/json_cursor.hpp"
#include "core/json/json_text.hpp"
#include "support/catch.hpp"

using namespace lutka;

namespace {

std::string failureOf(const std::string& text) {
    std::vector<std::string> duplicates;
    const auto parsed = parseJson(text, "test.json", duplicates);
    return parsed ? std::string() : parsed.error().text();
}

}  // namespace

TEST_CASE("a document comes back as it was written") {
    std::vector<std::string> duplicates;
    const std::string text = R"({"a":[1,-2,2.5,true,null,"x",{"b":[]}],"c":{"d":[[1],[2,[3]]]}})";
    const auto parsed = parseJson(text, "test.json", duplicates);
    REQUIRE(parsed);
    CHECK(parsed.value().dump() == text);
    CHECK(duplicates.empty());
}

TEST_CASE("what no JSON reader can take is refused with its pointer") {
    CHECK_THAT(failureOf(R"({"bodies":[{"m":1},{"m":1e999}]})"), Catch::Contains("test.json: /bodies/1/m: not JSON"));
    CHECK_THAT(failureOf(R"({"bodies":[1,2,)"), Catch::Contains("/bodies/2"));
    CHECK_THAT(failureOf(R"([[1],[2],oops])"), Catch::Contains("/2"));
    CHECK_THAT(failureOf(""), Catch::Contains("not JSON"));
}

TEST_CASE("a key that stands twice is told with its pointer") {
    std::vector<std::string> duplicates;
    REQUIRE(parseJson(R"({"list":[{"a/b":1},{"a/b":1,"a/b":2}]})", "test.json", duplicates));
    REQUIRE(duplicates.size() == 1);
    CHECK(duplicates[0] == "/list/1/a~1b: the key \"a/b\" stands twice in one object");
}

TEST_CASE("nesting without end is refused, whatever its length") {
    CHECK_THAT(failureOf(std::string(100'000, '[')), Catch::Contains("nested deeper than 64"));
    CHECK(failureOf(std::string(60, '[') + std::string(60, ']')).empty());
}

TEST_CASE("whole numbers are whole, and numbers fit a float") {
    std::vector<std::string> problems;
    const auto document = nlohmann::json::parse(R"({"a":1.9,"b":18446744073709551615,"c":3.5e38,"d":7,"e":70})");
    const JsonCursor at(document, problems);
    CHECK_FALSE(at["a"].wholeNumber().has_value());
    CHECK_FALSE(at["b"].wholeNumber().has_value());
    CHECK(at["c"].number(-1e9F, 1e9F) == 0.0F);
    CHECK(at["d"].wholeNumber(0, 10) == 7);
    CHECK_FALSE(at["e"].wholeNumber(0, 10).has_value());
    REQUIRE(problems.size() == 4);
    CHECK(problems[0] == "/a: expected a whole number, got 1.9");
    CHECK_THAT(problems[2], Catch::Contains("/c: expected a finite number"));
    CHECK(problems[3] == "/e: expected a whole number in [0, 10], got 70");
}
