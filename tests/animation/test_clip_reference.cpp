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

TEST_CASE("a clip is found by what people call it, where only one can be meant") {
    const auto clips = clipsNamed({"HumanArmature|Man_Walk", "HumanArmature|Man_RunJump", "Rig|Idle", "Sleepwalk",
                                   "take 01", "Hero_SwordSlash", "Hero_PunchLeft", "Hero_PunchRight"});
    CHECK(clipMeant(clips, "walk") == 0);
    CHECK(clipMeant(clips, "Man_Walk") == 0);
    CHECK(clipMeant(clips, "man_walk") == 0);
    CHECK(clipMeant(clips, "jump") == 1);
    CHECK(clipMeant(clips, "idle") == 2);
    CHECK(clipMeant(clips, "sleepwalk") == 3);
    CHECK(clipMeant(clips, "Take 01") == 4);
    CHECK(clipMeant(clips, "sword slash") == -1);
    CHECK(clipMeant(clips, "swordslash") == 5);
    for (const char* text : {"punch", "hero", "unjump", "|", "alk", "1", "Man"})
        CHECK(clipMeant(clips, text) == -1);
}

TEST_CASE("the nearer meaning of a clip's name goes before the farther one") {
    const auto clips = clipsNamed({"Rig|Old_Walk", "Rig|Walk", "WALK", "walk back", "Fox_Run", "Cow_Run"});
    CHECK(clipMeant(clips, "Rig|Walk") == 1);
    CHECK(clipMeant(clips, "walk") == 2);
    CHECK(clipMeant(clips, "back") == 3);
    CHECK(clipMeant(clips, "run") == -1);
    for (std::size_t i = 0; i < clips.size(); ++i)
        CHECK(clipMeant(clips, clipReference(clips, i)) == static_cast<int>(i));
    const auto armatures = clipsNamed({"A|walk", "B|walk", "Man_Walk"});
    CHECK(clipMeant(armatures, "walk") == -1);
}

TEST_CASE("a text that means no clip is told why, and what to write in its place") {
    const auto clips = clipsNamed({"Rig|Idle", "Hero_Punch", "Old_Punch", "walk@1", ""});
    CHECK(clipDoubt({}, "walk").mend == "the file has no clips");
    CHECK(clipDoubt(clips, "#9").message == "there is no clip #9");
    CHECK(clipDoubt(clips, "#9").mend == "the file has 5, from #1 to #5");
    CHECK(clipDoubt(clipsNamed({"walk"}), "#2").mend == "the file has one: walk");
    CHECK(clipDoubt(clips, "2").mend == "#2 is the clip of that number");
    CHECK(clipDoubt(clips, "idle@half").message == "'half' is no time in the clip 'idle'");
    CHECK(clipDoubt(clips, "idle@half").mend == "give seconds, as in idle@0.5");
    CHECK(clipDoubt(clips, "punch").message == "'punch' may be any of 2 clips");
    CHECK(clipDoubt(clips, "punch").mend == "name one of Hero_Punch, Old_Punch");
    CHECK(clipDoubt(clips, "unc").mend == "clips that hold this are Hero_Punch, Old_Punch");
    CHECK(clipDoubt(clips, "run").message == "there is no clip named 'run'");
    CHECK(clipDoubt(clips, "run").mend == "the clips are Rig|Idle, Hero_Punch, Old_Punch, walk@1, #5");
    // Nobody reads a hundred names in a terminal.
    std::vector<Clip> many(40);
    for (std::size_t i = 0; i < many.size(); ++i)
        many[i].name = "take " + std::to_string(i);
    const std::string mend = clipDoubt(many, "run").mend;
    CHECK(mend.find("take 11 and 28 more (`lutka inspect` lists all)") != std::string::npos);
    CHECK(mend.find("take 12") == std::string::npos);
}
