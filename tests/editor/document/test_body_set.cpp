#include "editor/sessions.hpp"
#include "physics/profile/profile_io.hpp"
#include "support/command.hpp"

using namespace lutka;
using namespace lutka::editor;
using animation::Role;
using test::makeEditor;
using test::send;

namespace {

std::unique_ptr<Editor> tailedEditor() {
    auto asset = scene::makeRagdoll(test::makeBipedWithAppendages());
    REQUIRE(asset.ok());
    EditorOptions options;
    options.playing = false;
    auto made = Editor::create(std::make_unique<EditorDocument>(std::move(asset).value()), options);
    REQUIRE(made.ok());
    return std::move(made).value();
}

int tailStart(const Editor& editor) {
    const auto& names = editor.document().character().skeleton.names;
    for (std::size_t joint = 0; joint < names.size(); ++joint) {
        if (names[joint].find("ail") != std::string::npos) return static_cast<int>(joint);
    }
    FAIL("there is no tail");
    return -1;
}

}  // namespace

TEST_CASE("a body is added, split, merged and removed in the view, each undone at once") {
    const auto editor = tailedEditor();
    const auto count = [&] { return editor->document().profile().bodies.size(); };
    const std::size_t fitted = count();
    const int joint = tailStart(*editor);
    editor->addBody(joint);
    REQUIRE(count() == fitted + 1);
    const std::string tail = editor->document().character().skeleton.names[joint];
    REQUIRE(editor->workspace().selectedBodies().size() == 1);
    CHECK(editor->document().profile().bodies[editor->workspace().selectedBodies().front()].name == tail);
    send(*editor, keyPressed(Key::k, {false, true, false}));
    CHECK(count() == fitted + 2);
    // The selection means the same body, whatever its place in the list is now.
    CHECK(editor->document().profile().bodies[editor->workspace().selectedBodies().front()].name == tail);
    send(*editor, keyPressed(Key::j, {false, true, false}));
    CHECK(count() == fitted + 1);
    editor->perform(Action::undo);
    CHECK(count() == fitted + 2);
    editor->select(Item{Item::Kind::body, 0, physics::bodyNamed(editor->document().profile(), tail)});
    send(*editor, keyPressed(Key::x));
    CHECK(editor->state() == State::remove);
    send(*editor, keyPressed(Key::enter));
    CHECK(count() == fitted + 1);
    CHECK(editor->workspace().selection.empty());
    editor->travel(-3);
    CHECK(count() == fitted);
    for (int i = 0; i < 30; ++i)
        editor->update(test::kFrame);
}

TEST_CASE("the root keeps its body, and says so") {
    const auto editor = tailedEditor();
    const std::size_t before = editor->document().profile().bodies.size();
    editor->select(Item{Item::Kind::body, 0, 0});
    send(*editor, keyPressed(Key::x));
    CHECK(editor->state() == State::selected);
    editor->perform(Action::removeBodies);
    CHECK(editor->document().profile().bodies.size() == before);
    REQUIRE_FALSE(editor->workspace().toasts.empty());
}

TEST_CASE("a joint that is clicked after Ctrl+B gets a body") {
    const auto editor = tailedEditor();
    const std::size_t before = editor->document().profile().bodies.size();
    send(*editor, keyPressed(Key::digit3));
    send(*editor, keyPressed(Key::b, {false, true, false}));
    REQUIRE(editor->state() == State::pickJoint);
    const vec3 place = editor->workspace().worldOfJoints(0)[tailStart(*editor)];
    const auto seen = render::project(editor->workspace().camera, place, editor->workspace().window);
    REQUIRE(seen.has_value());
    test::click(*editor, vec2(*seen));
    CHECK(editor->document().profile().bodies.size() == before + 1);
    CHECK(editor->state() == State::selected);
}

TEST_CASE("bodies that were added or removed by hand are there after another fit and in the saved file") {
    const auto editor = tailedEditor();
    EditorDocument& document = editor->document();
    editor->addBody(tailStart(*editor));
    const std::string tail = document.character().skeleton.names[tailStart(*editor)];
    editor->select(Item{Item::Kind::body, 0, physics::bodyOf(document.profile(), Role::leftHand)});
    editor->perform(Action::removeBodies);
    REQUIRE(physics::bodyOf(document.profile(), Role::leftHand) < 0);
    physics::FitOptions fit = document.state().fit;
    fit.neckBody = true;
    REQUIRE(document.setFit(fit).ok());
    CHECK(physics::bodyOf(document.profile(), Role::neck) > 0);
    CHECK(physics::bodyNamed(document.profile(), tail) > 0);
    CHECK(physics::bodyOf(document.profile(), Role::leftHand) < 0);
    const test::ScratchFolder folder;
    REQUIRE(document.save(folder.path / "hand.ragdoll.json").ok());
    REQUIRE(document.useProfile(folder.path / "hand.ragdoll.json").ok());
    CHECK(physics::bodyNamed(document.profile(), tail) > 0);
    fit.neckBody = false;
    REQUIRE(document.setFit(fit).ok());
    CHECK(physics::bodyNamed(document.profile(), tail) > 0);
    CHECK(physics::bodyOf(document.profile(), Role::leftHand) < 0);
}

TEST_CASE("while both sides are changed at once, an edit of one is the other's as well") {
    const auto editor = makeEditor();
    EditorDocument& document = editor->document();
    const auto body = [&](Role role) -> const physics::BodyProfile& {
        return document.profile().bodies[physics::bodyOf(document.profile(), role)];
    };
    send(*editor, keyPressed(Key::m, {true, false, false}));
    REQUIRE(document.symmetric());
    const int left = physics::bodyOf(document.profile(), Role::leftUpperArm);
    physics::BodyShape shape = body(Role::leftUpperArm).shape;
    shape.radius *= 1.4F;
    REQUIRE(document.setShape(left, shape).ok());
    CHECK(body(Role::rightUpperArm).shape.radius == Approx(shape.radius));
    REQUIRE(document.resetParts(std::span(&left, 1)).ok());
    CHECK(body(Role::rightUpperArm).shape.radius != Approx(shape.radius));
    CHECK(body(Role::rightUpperArm).shape.radius == Approx(body(Role::leftUpperArm).shape.radius));
    send(*editor, keyPressed(Key::m, {true, false, false}));
    REQUIRE(document.setShape(left, shape).ok());
    CHECK(body(Role::rightUpperArm).shape.radius != Approx(shape.radius));
}

TEST_CASE("a thigh on the joint of its foot is questioned at once, and one Fix mends the mapping") {
    const auto editor = makeEditor();
    EditorDocument& document = editor->document();
    const int foot = document.state().map.jointOf(Role::leftFoot);
    const int thigh = document.state().map.jointOf(Role::leftUpperLeg);
    const float before = document.state().map.confidence;
    if (!editor->edit([&](EditorDocument& one) { return one.assignRole(Role::leftUpperLeg, foot); })) {
        SUCCEED("the mapper refuses it");  // which is a question as well
        return;
    }
    CHECK(document.state().map.confidence < std::min(before, 0.5F));
    const auto errors = [&] {
        std::vector<physics::Finding> all;
        for (const physics::Finding& finding : document.diagnosis().findings) {
            if (finding.severity == physics::Severity::error) all.push_back(finding);
        }
        return all;
    };
    const std::vector<physics::Finding> found = errors();
    REQUIRE_FALSE(found.empty());
    const auto wrong =
        std::find_if(found.begin(), found.end(), [](const auto& finding) { return finding.code == "joint-not-below"; });
    REQUIRE(wrong != found.end());
    CHECK(document.canMend(*wrong));
    REQUIRE(editor->edit([&](EditorDocument& one) { return one.mend(std::span(&*wrong, 1)); }));
    CHECK(document.state().map.jointOf(Role::leftUpperLeg) == thigh);
    for (const physics::Finding& finding : errors())
        CHECK(finding.code != "joint-not-below");
}

TEST_CASE("a forearm's role that was fixed on the hand is told by the doctor, and mended by mapping it anew") {
    auto opened = EditorDocument::open(LUTKA_ASSETS_DIR "/models/mannequin.glb");
    REQUIRE(opened);
    EditorDocument& document = *opened.value();
    const int elbow = document.state().map.jointOf(Role::leftLowerArm);
    REQUIRE(document.assignRole(Role::leftLowerArm, document.state().map.jointOf(Role::leftHand)));
    const std::vector<physics::Finding> found = document.diagnosis().findings;
    const auto uneven =
        std::find_if(found.begin(), found.end(), [](const auto& finding) { return finding.code == "limb-uneven"; });
    REQUIRE(uneven != found.end());
    REQUIRE(document.canMend(*uneven));
    REQUIRE(document.mend(std::span(&*uneven, 1)));
    CHECK(document.state().map.jointOf(Role::leftLowerArm) == elbow);
    for (const physics::Finding& finding : document.diagnosis().findings)
        CHECK(finding.code != "limb-uneven");
}
