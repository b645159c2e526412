/// Scripts that go through the panels of the shipped program as a user would, and what they leave in its files.

#include <fstream>

#include "animation/export/write_glb.hpp"
#include "editor/scripts.hpp"

using namespace lutka;
using namespace lutka::editor;
using namespace lutka::test;
using animation::Role;

TEST_CASE("a script makes a box of a capsule and types a mass by a double click, which counts when the field is left") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    script.key(Key::space).click(612, 370);                    // the left lower leg
    script.click(1130, 183).wait(2).click(1080, 231).wait(2);  // its shape: Box
    script.click(1130, 209).press().release().wait(2);         // its mass
    type(script, "7.5").click(640, 640).wait(2);               // beside everything
    script.key(Key::s, kControl).wait(2);
    const Outcome outcome = play(scratch, script);
    NEEDS_DISPLAY_OF(outcome);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    const physics::RagdollProfile now = saved(scratch);
    const physics::RagdollProfile was = fitted(scratch);
    const int leg = physics::bodyOf(now, Role::leftLowerLeg);
    const physics::BodyShape& box = now.bodies[leg].shape;
    const physics::BodyShape& capsule = was.bodies[leg].shape;
    REQUIRE(box.kind == physics::BodyShape::Kind::box);
    CHECK(box.halfExtents.x == Approx(capsule.radius));
    CHECK(box.halfExtents.y == Approx(capsule.radius + capsule.halfLength));
    CHECK(now.bodies[leg].massKg == Approx(7.5F));
}

TEST_CASE("a script makes a lower leg the hull of its skin and scales it, and Refit makes the hull of the skin anew") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    physics::BodyProfile leg;
    const auto hullAfter = [&](bool scales, bool refits) {
        const Scratch scratch;
        Script script;
        script.key(Key::space).click(612, 370);                    // the left lower leg
        script.click(1130, 183).wait(2).click(1080, 265).wait(2);  // its shape: Hull
        if (scales) {
            script.move(640, 640).key(Key::s).key(Key::digit1).key(Key::period).key(Key::digit5).key(Key::enter);
        }
        if (refits) script.click(1212, 111).wait(2);  // Refit
        script.move(640, 640).key(Key::s, kControl).wait(2);
        const Outcome outcome = play(scratch, script);
        if (outcome.code == kNoDisplay) return outcome;
        INFO(outcome.output);
        REQUIRE(outcome.code == 0);
        const physics::RagdollProfile now = saved(scratch);
        leg = now.bodies[physics::bodyOf(now, Role::leftLowerLeg)];
        REQUIRE(leg.shape.kind == physics::BodyShape::Kind::hull);
        CHECK(physics::validate(now).empty());
        return outcome;
    };
    const auto volume = [](const physics::BodyProfile& body) { return body.shape.hull->volume(); };
    const Outcome first = hullAfter(false, false);
    NEEDS_DISPLAY_OF(first);
    const physics::BodyProfile ofSkin = leg;
    hullAfter(true, false);
    CHECK(volume(leg) == Approx(1.5F * 1.5F * 1.5F * volume(ofSkin)).epsilon(0.02));
    hullAfter(true, true);
    CHECK(volume(leg) == Approx(volume(ofSkin)).epsilon(1e-4));
    CHECK(leg.shape.hull->points().size() == ofSkin.shape.hull->points().size());
    CHECK(glm::distance(leg.jointFromBody.translation, ofSkin.jointFromBody.translation) < 1e-5F);
    CHECK(leg.massKg == Approx(ofSkin.massKg));
}

TEST_CASE("a value typed after a double click is one entry of undo, whatever its first click did to the knob") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    script.key(Key::space).click(612, 370);
    script.click(1130, 183).wait(2).click(1080, 231).wait(2);  // its shape: Box
    script.click(1070, 209).press().release().wait(40);        // its mass, far from the knob; some time goes by
    type(script, "7.5").key(Key::enter).wait(40);
    script.move(640, 640).key(Key::z, kControl).key(Key::z, kControl).wait(2).key(Key::s, kControl).wait(2);
    const Outcome outcome = play(scratch, script);
    NEEDS_DISPLAY_OF(outcome);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    const physics::RagdollProfile now = saved(scratch);
    const int leg = physics::bodyOf(now, Role::leftLowerLeg);
    CHECK(now.bodies[leg].massKg == Approx(fitted(scratch).bodies[leg].massKg));
    CHECK(now.bodies[leg].shape.kind == physics::BodyShape::Kind::capsule);
}

TEST_CASE("a field that is left by Esc, or with what stood in it, changes nothing") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    script.key(Key::space).click(612, 370);  // the left lower leg
    // Its mass and its radius, which show fewer digits than there are; then a change that is one to be undone.
    type(script.click(1130, 209).press().release().wait(2), "9.5").key(Key::escape).wait(40);
    script.click(1130, 235).press().release().wait(2).key(Key::enter).wait(40);
    type(script.click(1130, 261).press().release().wait(2), "50").key(Key::enter).wait(40);  // its length
    script.move(640, 640).key(Key::z, kControl).wait(2).key(Key::s, kControl).wait(2);
    const Outcome outcome = play(scratch, script);
    NEEDS_DISPLAY_OF(outcome);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    CHECK(physics::profileToJson(saved(scratch)) == physics::profileToJson(fitted(scratch)));
}

TEST_CASE("a script gives a thigh a second shape, whose fields come into sight, and types its width") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    // The left thigh, in the tree, which stays where it is seen: a second click meets it as well.
    script.key(Key::space).click(112, 572).wait(40).click(112, 572).wait(2);
    script.click(960, 640).wait(2).click(1172, 657).wait(4);                               // More shapes, Add Box
    type(script.click(1100, 547).press().release().wait(2), "9").key(Key::enter).wait(2);  // its half width
    script.move(640, 640).key(Key::s, kControl).wait(2);
    const Outcome outcome = play(scratch, script);
    NEEDS_DISPLAY_OF(outcome);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    const physics::RagdollProfile now = saved(scratch);
    const auto& shape = now.bodies[physics::bodyOf(now, Role::leftUpperLeg)].shape;
    REQUIRE(shape.more.size() == 1);
    CHECK(shape.more.front().kind == physics::BodyShape::Kind::box);
    CHECK(shape.more.front().halfExtents.x == Approx(0.09F));
}

TEST_CASE("a script changes two measures of a fitted second shape and takes one back by a click on what it was") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    script.key(Key::space).click(88, 158).wait(2).move(1100, 450);  // the spine, in the tree
    for (int notch = 0; notch < 12; ++notch)
        script.add(wheelTurned(-1.0F));
    script.wait(3);
    type(script.click(1140, 429).press().release().wait(2), "5").key(Key::enter).wait(30);   // its radius
    type(script.click(1140, 455).press().release().wait(2), "30").key(Key::enter).wait(30);  // its length
    script.click(1222, 429).wait(2).move(640, 640).key(Key::s, kControl).wait(2);            // "6.8 cm"
    const Outcome outcome = play(scratch, script, " --shapes 3");
    NEEDS_DISPLAY_OF(outcome);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    scene::LoadOptions options;
    options.fit.mostShapes = 3;
    const auto asset = scene::loadRagdoll(scratch.model(), options);
    REQUIRE(asset.ok());
    const auto second = [](const physics::RagdollProfile& profile) {
        const auto& more = profile.bodies[physics::bodyOf(profile, Role::spine)].shape.more;
        REQUIRE(more.size() == 2);
        return more.front();
    };
    CHECK(second(saved(scratch)).radius == Approx(second(asset.value()->profile).radius));
    const auto now = second(saved(scratch));
    CHECK(2.0F * (now.halfLength + now.radius) == Approx(0.3F).margin(0.04));
    CHECK(now.halfLength != Approx(second(asset.value()->profile).halfLength).margin(0.01));
}

TEST_CASE("a script locks a knee by the menu of its turn") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    script.key(Key::space).click(612, 370);                   // the left lower leg
    script.click(980, 478).wait(2).click(1010, 534).wait(2);  // Flexion: Locked
    script.move(640, 640).key(Key::s, kControl).wait(2);
    const Outcome outcome = play(scratch, script);
    NEEDS_DISPLAY_OF(outcome);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    const physics::RagdollProfile now = saved(scratch);
    const physics::ConstraintProfile& knee = now.constraints[physics::bodyOf(now, Role::leftLowerLeg) - 1];
    CHECK(degrees(knee.hinge.upper - knee.hinge.lower) < 6.0F);
}

TEST_CASE("a script adds a body to a finger by the tree's menu, splits it, and Esc closes a menu without losing it") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    script.key(Key::space);
    rightClick(script, 204, 337).wait(2).key(Key::escape).wait(2);  // a finger's menu, opened and closed
    rightClick(script, 204, 337).wait(2).click(267, 353).wait(2);   // Add a body here
    script.move(640, 640).key(Key::k, kControl).wait(2).key(Key::s, kControl).wait(2);
    const Outcome outcome = play(scratch, script);
    NEEDS_DISPLAY_OF(outcome);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    const physics::RagdollProfile now = saved(scratch);
    CHECK(now.bodies.size() == fitted(scratch).bodies.size() + 2);
    const int finger = physics::bodyNamed(now, "leftIndexProximal");
    REQUIRE(finger > 0);
    CHECK(now.constraints[finger - 1].parent == physics::bodyOf(now, Role::leftHand));
}

TEST_CASE("a script maps a thigh to a foot, and one Fix mends the mapping") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    script.key(Key::space).click(122, 43).click(190, 353);  // the tab Mapping, the left thigh's joint
    type(script, "leftFoot").wait(2).click(190, 404).wait(2);
    script.click(1134, 43).move(640, 640).wait(3);  // the tab Doctor
    const int wrong = script.frame();
    script.wait(1).click(958, 213).wait(2).move(640, 640).key(Key::s, kControl).wait(3);  // Fix of the thigh's joint
    const std::string picture = (scratch / "wrong.png").string();
    const Outcome outcome = play(scratch, script, " --screenshot-at " + std::to_string(wrong) + ":" + picture);
    NEEDS_DISPLAY_OF(outcome);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    const auto seen = render::loadPng(picture);
    REQUIRE(seen.ok());
    // The tab tells the number of errors, and the mapping how sure it is.
    checkGolden(cropped(seen.value(), 937, 24, 343, 300), "editor_wrong_mapping", kPanel);
    const physics::RagdollProfile now = saved(scratch);
    for (const Role role : {Role::leftUpperLeg, Role::leftLowerLeg, Role::leftFoot}) {
        const int body = physics::bodyOf(now, role);
        REQUIRE(body > 0);
        CHECK(now.bodies[body].joint == animation::roleName(role));
    }
    const Outcome check = run(scratch, std::string(LUTKA_BINARY) + " check " + scratch.model().string() +
                                           " --profile " + (scratch / "mannequin.ragdoll.json").string());
    INFO(check.output);
    CHECK(check.output.find("limit-impossible") == std::string::npos);
    CHECK(check.output.find("joint-not-below") == std::string::npos);
}

TEST_CASE("a script chooses a character's model with Browse and saves the scene that names it") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    fs::copy_file(scratch.model(), scratch / "other.glb");
    Script script;
    script.key(Key::space).click(190, 43).click(60, 150).wait(2);  // the tab Scene, the character
    script.click(274, 615).wait(3);                                // … beside its model
    script.key(Key::down).key(Key::down).key(Key::enter).wait(3);
    script.move(640, 640).key(Key::s, {false, true, true}).wait(3);
    const Outcome outcome = play(scratch, script);
    NEEDS_DISPLAY_OF(outcome);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    REQUIRE(fs::exists(scratch / "drop.scene.json"));
    CHECK_THAT(fileText(scratch / "drop.scene.json"), Catch::Contains("other.glb"));
}

TEST_CASE("a script saves the scene, then the ragdoll that is offered, then the scene anew, which names the ragdoll") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    script.key(Key::space).click(612, 370);             // the left lower leg
    script.click(1130, 209).press().release().wait(2);  // its mass
    type(script, "7.5").key(Key::enter).move(640, 640).wait(2);
    script.key(Key::s, {false, true, true}).wait(3);
    const auto playOn = [&](int offers) {
        fs::remove(scratch / "drop.scene.json");
        fs::remove(scratch / "mannequin.ragdoll.json");
        Script more = script;
        for (int i = 0; i < offers; ++i)
            more.click(540, 140).wait(3);  // "Save the ragdoll too", then "Save the scene too"
        return play(scratch, more);
    };
    const Outcome scene = playOn(0);
    NEEDS_DISPLAY_OF(scene);
    INFO(scene.output);
    REQUIRE(scene.code == 0);
    REQUIRE(fs::exists(scratch / "drop.scene.json"));
    CHECK_FALSE(fs::exists(scratch / "mannequin.ragdoll.json"));
    REQUIRE(playOn(1).code == 0);
    const physics::RagdollProfile now = saved(scratch);
    CHECK(now.bodies[physics::bodyOf(now, Role::leftLowerLeg)].massKg == Approx(7.5F));
    CHECK(fileText(scratch / "drop.scene.json").find("mannequin.ragdoll.json") == std::string::npos);
    REQUIRE(playOn(2).code == 0);
    CHECK_THAT(fileText(scratch / "drop.scene.json"), Catch::Contains("mannequin.ragdoll.json"));
}

TEST_CASE("a script types limits beside the bind pose, and the mark is red from one degree past them on") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    Pictures pictures{scratch, script, {}, {640, 640}};
    script.key(Key::space).click(612, 370);  // the left lower leg
    const std::pair<const char*, const char*> extensions[] = {
        {"20", "green.png"}, {"3", "near.png"}, {"-0.5", "within.png"}, {"-1.5", "red.png"}};
    for (const auto& [typed, picture] : extensions) {
        script.wait(30).click(1118, 456).press().release().wait(2);
        type(script, typed).key(Key::enter);
        pictures.take(picture);
    }
    const Outcome outcome = play(scratch, script, pictures.arguments);
    NEEDS_DISPLAY_OF(outcome);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    const auto mark = [&](const char* name) {
        // Where the lower limit and so the mark is; the widest range has the bind pose a little to the right of that.
        const bool wide = std::string(name) == "green.png";
        return pictures.at(name, wide ? 1074 : (std::string(name) == "near.png" ? 1057 : 1054), 481);
    };
    const auto red = [](const render::Color& color) { return color.r > 200 && color.g < 140; };
    const auto yellow = [](const render::Color& color) { return color.r > 200 && color.g > 150 && color.b < 140; };
    const auto green = [](const render::Color& color) { return color.g > color.r; };
    CHECK(green(mark("green.png")));
    CHECK(yellow(mark("near.png")));
    CHECK(yellow(mark("within.png")));
    CHECK(red(mark("red.png")));
}

TEST_CASE("a script chooses a panorama in the view, which lights and then is seen, and goes back to the plain sky") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    // Red above, dark below.
    constexpr int width = 16;
    constexpr int height = 8;
    std::ofstream panorama(scratch / "dusk.hdr", std::ios::binary);
    panorama << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " << height << " +X " << width << "\n";
    for (int texel = 0; texel < width * height; ++texel)
        panorama << (texel < width * height / 2 ? "\xfa\x14\x14\x81" : "\x14\x14\x14\x81");
    panorama.close();
    Script script;
    Pictures pictures{scratch, script, {}, {640, 640}};
    script.key(Key::space).click(1086, 43);  // the tab View
    pictures.take("plain.png");
    script.click(1260, 569).wait(3).key(Key::down).key(Key::enter);  // … beside Sky, the only panorama
    pictures.take("lit.png");
    script.click(957, 597);  // Show it behind the scene
    pictures.take("seen.png");
    script.click(1176, 597);  // Plain sky
    pictures.take("again.png");
    const Outcome outcome = play(scratch, script, pictures.arguments);
    NEEDS_DISPLAY_OF(outcome);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    const auto redder = [](const render::Color& color) { return color.r > color.b + 20; };
    const auto ground = [&](const char* name) { return pictures.at(name, 420, 600); };
    const auto above = [&](const char* name) { return pictures.at(name, 860, 60); };
    CHECK_FALSE(redder(ground("plain.png")));
    CHECK(redder(ground("lit.png")));
    CHECK_FALSE(redder(above("lit.png")));
    CHECK(redder(above("seen.png")));
    CHECK_FALSE(redder(ground("again.png")));
    CHECK_FALSE(redder(above("again.png")));
}

TEST_CASE("a script moves a tab below the view, which is framed above it") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    script.key(Key::space).wait(1);
    rightClick(script, 1247, 43).wait(2).click(1150, 100).wait(2).move(640, 300).wait(3);
    const std::string picture = (scratch / "bottom.png").string();
    const Outcome outcome = play(scratch, script, " --screenshot-at " + std::to_string(script.frame()) + ":" + picture);
    NEEDS_DISPLAY_OF(outcome);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    const auto seen = render::loadPng(picture);
    REQUIRE(seen.ok());
    checkGolden(cropped(seen.value(), 310, 464, 626, 225), "editor_bottom", kPanel);
}

TEST_CASE("a script exports the ragdoll for an engine by the keyboard alone") {
    const Scratch scratch;
    Script script;
    script.key(Key::space).move(640, 640).key(Key::e, {true, true, false}).wait(4).key(Key::enter).wait(4);
    const Outcome outcome = play(scratch, script);
    NEEDS_DISPLAY_OF(outcome);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    REQUIRE(fs::exists(scratch / "mannequin_ragdoll.xml"));
    CHECK_THAT(fileText(scratch / "mannequin_ragdoll.xml"), Catch::StartsWith("<mujoco"));
}

TEST_CASE("Esc in a list of a dialog closes the list alone") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    script.key(Key::space).move(640, 640).key(Key::e, {true, true, false}).wait(4);
    script.click(640, 461).wait(3).key(Key::escape).wait(3);  // the list of formats
    script.click(434, 529).wait(4);                           // Save
    const Outcome outcome = play(scratch, script);
    NEEDS_DISPLAY_OF(outcome);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    CHECK(fs::exists(scratch / "mannequin_ragdoll.xml"));
}

TEST_CASE("a path that is typed takes the place of the one in the dialog, also when it opens again") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    script.key(Key::space).move(640, 640);
    for (const char* name : {"first.ragdoll.json", "second.ragdoll.json"}) {
        script.key(Key::s, {true, true, false}).wait(4);
        type(script, (scratch / name).string()).key(Key::enter).wait(8);
    }
    script.key(Key::s, {true, true, false}).wait(4).key(Key::escape).wait(4);
    script.key(Key::s, {true, true, false}).wait(4);
    type(script, (scratch / "third.ragdoll.json").string()).key(Key::enter).wait(8);
    const Outcome outcome = play(scratch, script);
    NEEDS_DISPLAY_OF(outcome);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    for (const char* name : {"first.ragdoll.json", "second.ragdoll.json", "third.ragdoll.json"})
        CHECK(fs::exists(scratch / name));
}

TEST_CASE("Enter saves where unsaved changes are asked about, Esc goes back") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    script.key(Key::space).click(612, 370).key(Key::del).key(Key::enter).wait(4);  // without the left lower leg
    script.key(Key::q, {false, true, false}).wait(4).key(Key::escape).wait(4);
    script.key(Key::z, {false, true, false}).wait(4).key(Key::z, {true, true, false}).wait(4);  // it goes on
    script.key(Key::q, {false, true, false}).wait(4).key(Key::enter).wait(4);
    const Outcome outcome = play(scratch, script);
    NEEDS_DISPLAY_OF(outcome);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    CHECK(physics::bodyOf(saved(scratch), Role::leftLowerLeg) < 0);
}

TEST_CASE("Enter takes the offer of a ragdoll of any skeleton, but not the Enter that opened the model") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    const fs::path animal = scratch / "animal.glb";
    REQUIRE(animation::writeGlb(animal, makeQuadruped(), {}).ok());
    const auto opened = [&](bool enter) {
        Script script;
        script.key(Key::space).move(640, 640).key(Key::o, {false, true, false}).wait(4);
        type(script, animal.string()).key(Key::enter).wait(8);
        if (enter) script.key(Key::enter).wait(8);
        script.key(Key::s, {false, true, false}).wait(8);
        return play(scratch, script);
    };
    const Outcome left = opened(false);
    NEEDS_DISPLAY_OF(left);
    INFO(left.output);
    REQUIRE(left.code == 0);
    CHECK_FALSE(fs::exists(scratch / "animal.ragdoll.json"));
    REQUIRE(opened(true).code == 0);
    CHECK(fs::exists(scratch / "animal.ragdoll.json"));
}
