/// Scripts that go through the panels of the shipped program as a user would, and what they leave in its files.

#include <fstream>

#include "editor/scripts.hpp"
#include "physics/profile/profile_io.hpp"

using namespace lutka;
using namespace lutka::editor;
using namespace lutka::test;
using animation::Role;

namespace {

physics::RagdollProfile fitted(const Scratch& scratch) {
    return scene::loadRagdoll(scratch.model()).value()->profile;
}

// Plays it without a window; whether there was a GL to do so.
Outcome play(const Scratch& scratch, const Script& script, const std::string& more = "") {
    script.save(scratch / "script.jsonl");
    return edit(scratch, "--headless --input " + (scratch / "script.jsonl").string() + more);
}

physics::RagdollProfile saved(const Scratch& scratch) {
    auto profile = physics::loadProfile(scratch / "mannequin.ragdoll.json");
    REQUIRE(profile.ok());
    return std::move(profile).value();
}

InputEvent rightButton(bool pressed) {
    return mouseButton(MouseButton::right, pressed);
}

Script& rightClick(Script& script, float x, float y) {
    return script.move(x, y).add(rightButton(true)).add(rightButton(false));
}

Script& type(Script& script, const std::string& text) {
    for (const char letter : text)
        script.add(textTyped(static_cast<std::uint32_t>(letter)));
    return script;
}

}  // namespace

TEST_CASE("a script makes a box of a capsule and types a mass by a double click, which counts when the field is left") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    script.key(Key::space).click(632, 393);                    // the left lower leg
    script.click(1130, 195).wait(2).click(1080, 243).wait(2);  // its shape: Box
    script.click(1130, 224).press().release().wait(2);         // its mass
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

TEST_CASE("a value typed after a double click is one entry of undo, whatever its first click did to the knob") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    script.key(Key::space).click(632, 393);
    script.click(1130, 195).wait(2).click(1080, 243).wait(2);  // its shape: Box
    script.click(1070, 224).press().release().wait(40);        // its mass, far from the knob; some time goes by
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

TEST_CASE("a script locks a knee by the menu of its turn") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    script.key(Key::space).click(632, 393);                   // the left lower leg
    script.click(980, 545).wait(2).click(1010, 601).wait(2);  // Flexion: Locked
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
    rightClick(script, 204, 337).wait(2).click(267, 283).wait(2);   // Add a body here
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
    type(script, "leftFoot").wait(2).click(190, 396).wait(2);
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
