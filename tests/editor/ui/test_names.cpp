/// Names in the panels: whole where that can be, in a panel as wide as they need.

#include <cstring>
#include <fstream>

#include "editor/scripts.hpp"
#include "editor/ui/widgets.hpp"

using namespace lutka;
using namespace lutka::editor;
using namespace lutka::test;

namespace {

// The scratch mannequin with joints whose names begin so.
void renameJoints(const Scratch& scratch, const std::string& prefix) {
    const std::string glb = fileText(scratch.model());
    const auto word = [&](std::size_t at) {
        std::uint32_t value = 0;
        std::memcpy(&value, glb.data() + at, sizeof value);
        return value;
    };
    constexpr std::size_t header = 20;  // of the file and of its first chunk
    std::string json = glb.substr(header, word(12));
    for (const std::string side : {"left", "right"}) {
        const std::string name = "\"name\":\"" + side;
        std::size_t at = 0;
        while ((at = json.find(name, at)) != std::string::npos) {
            json.insert(at + name.size() - side.size(), prefix);
            at += name.size() + prefix.size();
        }
    }
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::string rest = glb.substr(header + word(12));
    std::string made = glb.substr(0, header);
    const auto put = [&](std::size_t at, std::size_t size) {
        const auto value = static_cast<std::uint32_t>(size);
        std::memcpy(made.data() + at, &value, sizeof value);
    };
    put(8, header + json.size() + rest.size());
    put(12, json.size());
    std::ofstream(scratch.model(), std::ios::binary) << made << json << rest;
}

// Where the view begins beside the left panel.
int panelWidth(const render::Image& picture) {
    for (int x = 100; x < picture.width; ++x) {
        if (picture.at(x, 688).g > 120) return x;
    }
    return picture.width;
}

// Pixels of the tree's role words and of joints' names left of `right`.
int lettersIn(const render::Image& picture, int right, bool roles) {
    int count = 0;
    for (int y = 96; y < 660; ++y) {
        for (int x = 12; x < right; ++x) {
            const render::Color color = picture.at(x, y);
            count += static_cast<int>(color.r > 150 && (color.b < 100) == roles);
        }
    }
    return count;
}

struct Panels {
    int width = 0;              // of the left panel by itself
    render::Image tree;         // in it
    render::Image wideTree;     // 150 px wider
    render::Image mapping;      // in it
    render::Image wideMapping;  // 150 px wider
};

constexpr int kWidened = 150;

// What came of the program, which may have had no display.
Outcome lookAt(const Scratch& scratch, Panels& seen) {
    const auto pictures = [&](int widen, render::Image& tree, render::Image& mapping) {
        Script script;
        Pictures taken{scratch, script, {}, {800, 640}};
        script.key(Key::space).wait(2);
        if (widen > 0) script.drag(static_cast<float>(widen), 500, static_cast<float>(widen + kWidened), 500).release();
        taken.take("tree.png");
        script.click(122, 43);  // the tab Mapping
        taken.take("mapping.png");
        const Outcome outcome = play(scratch, script, taken.arguments);
        if (outcome.code == kNoDisplay) return outcome;
        INFO(outcome.output);
        REQUIRE(outcome.code == 0);
        tree = taken.load("tree.png");
        mapping = taken.load("mapping.png");
        return outcome;
    };
    const Outcome first = pictures(0, seen.tree, seen.mapping);
    if (first.code == kNoDisplay) return first;
    seen.width = panelWidth(seen.tree);
    return pictures(seen.width, seen.wideTree, seen.wideMapping);
}

}  // namespace

TEST_CASE("a name that has no room keeps its beginning and end, in whole letters") {
    const auto width = [](std::string_view text) {  // a letter is 1 wide
        float count = 0.0F;
        for (const char c : text)
            count += (static_cast<unsigned char>(c) & 0xC0U) == 0x80U ? 0.0F : 1.0F;
        return count;
    };
    CHECK(cutInTheMiddle("leftHand", 8.0F, width) == "leftHand");
    CHECK(cutInTheMiddle("leftHand", 7.0F, width) == "lef…and");
    CHECK(cutInTheMiddle("leftHand", 6.0F, width) == "le…and");
    CHECK(cutInTheMiddle("左手首ボーン", 5.0F, width) == "左手…ーン");
    CHECK(cutInTheMiddle("leftHand", 0.0F, width) == "…d");
    CHECK(cutInTheMiddle("a", 0.0F, width) == "a");
    CHECK(cutInTheMiddle("", 0.0F, width).empty());
    for (int room = 2; room < 12; ++room)
        CHECK(width(cutInTheMiddle("左Oberschenkel", static_cast<float>(room), width)) <= static_cast<float>(room));
}

TEST_CASE("a rig of long names has a panel that shows them and their roles whole") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    renameJoints(scratch, "human:");
    Panels seen;
    const Outcome outcome = lookAt(scratch, seen);
    NEEDS_DISPLAY_OF(outcome);
    CHECK(seen.width > 320);
    CHECK(seen.width <= 423);
    // A wider one has no more to show.
    for (const bool roles : {false, true}) {
        CHECK(lettersIn(seen.tree, seen.width - 26, roles) > 500);
        CHECK(lettersIn(seen.tree, seen.width - 26, roles) ==
              lettersIn(seen.wideTree, seen.width + kWidened - 26, roles));
    }
    CHECK(lettersIn(seen.mapping, seen.width - 4, false) ==
          Approx(lettersIn(seen.wideMapping, seen.width + kWidened - 4, false)).epsilon(0.02));
}

TEST_CASE("names that no panel has room for are cut in the middle, and roles behind them stay whole") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    renameJoints(scratch, "CharacterOfASecondAct_Armature:");
    Panels seen;
    const Outcome outcome = lookAt(scratch, seen);
    NEEDS_DISPLAY_OF(outcome);
    CHECK(seen.width > 415);
    CHECK(seen.width <= 423);
    CHECK(lettersIn(seen.tree, seen.width - 26, true) ==
          Approx(lettersIn(seen.wideTree, seen.width + kWidened - 26, true)).epsilon(0.05));
    CHECK(lettersIn(seen.tree, seen.width - 26, false) < lettersIn(seen.wideTree, seen.width + kWidened - 26, false));
}
