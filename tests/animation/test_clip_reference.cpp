#include "animation/clip_reference.hpp"

#include "support/catch.hpp"

using namespace lutka::animation;

namespace {

std::vector<Clip> clipsNamed(std::initializer_list<const char*> names) {
    std::vector<Clip> clips;
    for (const char* name : names)
        clips.emplace_back().name = name;
    return clips;
}

}  // namespace

TEST_CASE("every clip can be asked for, whether names are missing or shared") {
    const auto clips = clipsNamed({"walk", "", "walk", "idle", ""});
    for (std::size_t i = 0; i < clips.size(); ++i)
        CHECK(clipMeant(clips, clipReference(clips, i)) == static_cast<int>(i));
    CHECK(clipReference(clips, 0) == "walk");
    CHECK(clipReference(clips, 1) == "#2");
    CHECK(clipLabel(clips, 1) == "#2");
    CHECK(clipLabel(clips, 2) == "walk (#3)");
    CHECK(clipLabel(clips, 3) == "idle");
    CHECK(clipReferences(clips) == "walk, #2, #3, idle, #5");
    const auto numbers = clipsNamed({"#2", "", "#3", "#9"});
    for (std::size_t i = 0; i < numbers.size(); ++i)
        CHECK(clipMeant(numbers, clipReference(numbers, i)) == static_cast<int>(i));
    CHECK(clipReferences(numbers) == "#1, #2, #3, #9");
}

TEST_CASE("what means no clip means none, and a number goes before a name") {
    const auto clips = clipsNamed({"a", "#1"});
    CHECK(clipMeant(clips, "#1") == 0);
    CHECK(clipMeant(clips, "#2") == 1);
    for (const char* text : {"", "b", "#", "#0", "#3", "#-1", "#1x", "# 1", "#99999999999999999999"})
        CHECK(clipMeant(clips, text) == -1);
    CHECK(clipMeant({}, "#1") == -1);
}
