/// Scripts of whole errands in the shipped program: a pose and its undo, a take with what comes in midway, a panel that
/// is widened, a machine that hardly draws.

#include "editor/scripts.hpp"
#include "editor/view/describe_frame.hpp"
#include "scene/run/recording.hpp"

using namespace lutka;
using namespace lutka::editor;
using namespace lutka::test;
using animation::Role;

TEST_CASE("a script poses an arm, Esc puts it back, the release keeps it, and undo and redo go both ways") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    Pictures pictures{scratch, script, ""};
    script.click(686, 247);  // the left hand
    pictures.take("before.png");
    script.drag(686, 247, 686, 130).key(Key::escape).release();
    pictures.take("cancelled.png");
    script.drag(686, 247, 686, 130).wait(10).release();
    pictures.take("posed.png");
    script.key(Key::z, kControl);
    pictures.take("undone.png");
    script.key(Key::z, {true, true, false});
    pictures.take("again.png");
    const Outcome outcome = play(scratch, script, " --paused" + pictures.arguments);
    NEEDS_DISPLAY_OF(outcome);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    const auto arm = [&](const char* a, const char* b) { return pictures.apart(a, b, 620, 90, 120, 200); };
    CHECK(arm("before.png", "cancelled.png") < 0.002F);
    CHECK(arm("before.png", "posed.png") > 0.05F);
    CHECK(arm("before.png", "undone.png") < 0.002F);
    CHECK(arm("posed.png", "again.png") < 0.002F);
}

TEST_CASE("a script records while a ball and copies come in, and the question at the end saves the take") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    script.click(1024, 43).wait(2).click(1101, 482).wait(20);  // the tab Physics, Record
    script.move(595, 250).key(Key::b).wait(10);
    script.click(1160, 320).wait(30).move(640, 640).key(Key::q, kControl).wait(4);  // Drop copies
    // Save; how high it lies follows from the length of the path above it.
    for (const float y : {362.0F, 376.0F, 390.0F, 404.0F})
        script.click(508, y).wait(2);
    const Outcome outcome = play(scratch, script);
    NEEDS_DISPLAY_OF(outcome);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    const auto take = scene::loadRecording(scratch / "mannequin.Take_1.recording");
    REQUIRE(take.ok());
    CHECK(take.value().dolls == 9);
    CHECK(take.value().props == 1);
    CHECK(take.value().steps() > 60);
}

TEST_CASE("a script spoils a shape, and Refit gives it its fitted measures while its mass stays changed") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    script.key(Key::space).click(612, 370);                                                   // the left lower leg
    type(script.click(1130, 209).press().release().wait(2), "7.5").key(Key::enter).wait(40);  // its mass
    type(script.click(1130, 235).press().release().wait(2), "11").key(Key::enter).wait(40);   // its radius
    script.move(640, 640).key(Key::s, kControl).wait(3);
    const Outcome spoilt = play(scratch, script);
    NEEDS_DISPLAY_OF(spoilt);
    INFO(spoilt.output);
    REQUIRE(spoilt.code == 0);
    const physics::RagdollProfile was = fitted(scratch);
    const int leg = physics::bodyOf(was, Role::leftLowerLeg);
    const physics::BodyShape& own = was.bodies[leg].shape;
    const physics::RagdollProfile wide = saved(scratch);
    CHECK(wide.bodies[leg].shape.radius == Approx(0.11F));
    // Its length is another value: from end to end it is as it was.
    CHECK(wide.bodies[leg].shape.radius + wide.bodies[leg].shape.halfLength == Approx(own.radius + own.halfLength));
    fs::remove(scratch / "mannequin.ragdoll.json");
    script.click(1212, 111).move(640, 640).key(Key::s, kControl).wait(3);  // Refit
    const Outcome outcome = play(scratch, script);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    const physics::RagdollProfile now = saved(scratch);
    CHECK(now.bodies[leg].shape.radius == Approx(own.radius));
    CHECK(now.bodies[leg].shape.halfLength == Approx(own.halfLength));
    CHECK(now.bodies[leg].massKg == Approx(7.5F));
}

TEST_CASE("a script widens a panel by its edge, and a double click there gives it its own width back") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    Pictures pictures{scratch, script, ""};
    script.key(Key::space);
    pictures.take("before.png");
    script.drag(310, 500, 410, 500).release();
    pictures.take("wide.png");
    script.wait(40).click(410, 500).press().release();
    pictures.take("again.png");
    const Outcome outcome = play(scratch, script, pictures.arguments);
    NEEDS_DISPLAY_OF(outcome);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    const auto strip = [&](const char* a, const char* b) { return pictures.apart(a, b, 330, 600, 60, 60); };
    CHECK(strip("before.png", "wide.png") > 0.9F);
    CHECK(strip("before.png", "again.png") < 0.01F);
}

TEST_CASE("a script whose clicks and keys all come in one frame does what it does at leisure") {
    const Scratch scratch;
    Script script;
    script.setSize({640, 480});
    script.key(Key::tab).wait(2).atOnce();
    {
        EditorOptions options;
        options.model = scratch.model();
        options.playing = false;
        options.window = {640, 480};
        const auto editor = Editor::create(options);
        REQUIRE(editor.ok());
        send(*editor.value(), keyPressed(Key::tab));
        const vec2 hips = seenAt(*editor.value(), Role::hips);
        script.click(hips.x, hips.y);
    }
    script.key(Key::s).key(Key::digit1).key(Key::period).key(Key::digit5).key(Key::enter);
    script.key(Key::s).key(Key::digit2).key(Key::enter).key(Key::z, kControl).key(Key::s, kControl);
    script.leisurely().wait(2).move(10, 10);
    const Outcome outcome = play(scratch, script, " --paused");
    NEEDS_DISPLAY_OF(outcome);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    const physics::RagdollProfile was = fitted(scratch);
    const int hips = physics::bodyOf(was, Role::hips);
    CHECK(saved(scratch).bodies[hips].shape.radius == Approx(was.bodies[hips].shape.radius * 1.5F));
}

TEST_CASE("a script selects a body, types its mass and saves it, all in one frame") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    script.key(Key::space).wait(2).atOnce();
    script.click(612, 370).click(1130, 209).press().release();  // the left lower leg, its mass
    type(script, "7.5").key(Key::enter).move(640, 640).key(Key::s, kControl).leisurely().wait(2);
    const Outcome outcome = play(scratch, script);
    NEEDS_DISPLAY_OF(outcome);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    const physics::RagdollProfile now = saved(scratch);
    CHECK(now.bodies[physics::bodyOf(now, Role::leftLowerLeg)].massKg == Approx(7.5F));
}

TEST_CASE("a tab opens though the mouse comes to it from another and presses in one frame") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    Pictures pictures{scratch, script, ""};
    script.key(Key::space).wait(2);
    pictures.take("skeleton.png");
    script.move(44, 43).wait(1);                 // over the tab Skeleton
    script.atOnce().click(190, 43).leisurely();  // the tab Scene
    pictures.take("at_once.png");
    script.click(190, 43);
    pictures.take("at_leisure.png");
    const Outcome outcome = play(scratch, script, pictures.arguments);
    NEEDS_DISPLAY_OF(outcome);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    const auto panel = [&](const char* a, const char* b) { return pictures.apart(a, b, 10, 90, 290, 570); };
    CHECK(panel("skeleton.png", "at_once.png") > 0.03F);
    CHECK(panel("at_once.png", "at_leisure.png") < 0.002F);
}

TEST_CASE("the list of joints begins where the joint of the role is, and takes its neighbour by a click") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    script.key(Key::space).click(122, 43).click(190, 353).wait(3);  // the tab Mapping, the left thigh's joint
    script.click(190, 584).wait(2);                                 // below it in the list: leftLowerLeg
    script.move(640, 640).key(Key::s, kControl).wait(3);
    const Outcome outcome = play(scratch, script);
    NEEDS_DISPLAY_OF(outcome);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    const physics::RagdollProfile now = saved(scratch);
    CHECK(now.bodies[physics::bodyOf(now, Role::leftUpperLeg)].joint == "leftLowerLeg");
}

TEST_CASE("a scene among the recent files is opened by a click on its card") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    for (const char* name : {"drop", "stairs"}) {
        Script script;
        script.key(Key::space).move(640, 640).key(Key::s, {false, true, true}).wait(3);
        const Outcome outcome = play(scratch, script, std::string(" --scene ") + name);
        NEEDS_DISPLAY_OF(outcome);
        INFO(outcome.output);
        REQUIRE(fs::exists(scratch / (std::string(name) + ".scene.json").c_str()));
    }
    Script script;
    Pictures pictures{scratch, script, ""};
    pictures.take("stairs.png");
    script.add(filesDropped({scratch / "drop.scene.json"})).wait(3);
    pictures.take("drop.png");
    script.key(Key::o, {true, true, false}).wait(3);
    script.click(604, 156).wait(3);  // the second card: the last scene but one
    pictures.take("again.png");
    script.save(scratch / "script.jsonl");
    const Outcome outcome =
        run(scratch, std::string(LUTKA_BINARY) + " edit " + (scratch / "stairs.scene.json").string() +
                         " --paused --headless --input " + (scratch / "script.jsonl").string() + pictures.arguments);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    // The view above what is told of the files that were opened.
    const auto view = [&](const char* a, const char* b) { return pictures.apart(a, b, 400, 70, 520, 500); };
    CHECK(view("stairs.png", "drop.png") > 0.2F);
    CHECK(view("stairs.png", "again.png") < 0.001F);
}

TEST_CASE("a script shows puppets' target and strength, whose colours are told with words") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    Pictures pictures{scratch, script, {}, {640, 640}};
    script.key(Key::space).click(1024, 43).wait(3).move(1100, 500);  // the tab Physics
    for (int notch = 0; notch < 9; ++notch)
        script.add(wheelTurned(-1.0F));
    script.wait(3).click(957, 93).wait(3);  // Characters have muscles
    pictures.take("off.png");
    script.click(957, 289).wait(2).click(1107, 289).wait(2);  // Target, Strength as a colour
    pictures.take("on.png");
    const Outcome outcome = play(scratch, script, pictures.arguments);
    NEEDS_DISPLAY_OF(outcome);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    const render::Image on = pictures.load("on.png");
    int line = 0;
    for (const auto& legend : {targetLegend(), strengthLegend()}) {
        for (const render::LegendEntry& entry : legend) {
            INFO(entry.text);
            const int y = 314 + 20 * line++;
            const render::Color shown = on.at(967, y);
            CHECK(std::abs(shown.r - entry.color.r) + std::abs(shown.g - entry.color.g) +
                      std::abs(shown.b - entry.color.b) <
                  12);
            int bright = 0;  // letters behind the colour
            for (int x = 980; x < 1130; ++x)
                bright += static_cast<int>(on.at(x, y).g > 100);
            CHECK(bright > 5);
        }
    }
    checkGolden(cropped(on, 937, 280, 343, 110), "editor_puppet_legend", kPanel);
}
