#include <algorithm>
#include <array>
#include <filesystem>

#include "editor/document/open_document.hpp"
#include "editor/sessions.hpp"
#include "physics/profile/profile_io.hpp"
#include "support/command.hpp"

using namespace lutka;
using namespace lutka::editor;
using animation::Role;
using test::makeDocument;

namespace {

int constraintIndexOf(const EditorDocument& document, Role role) {
    return physics::bodyOf(document.profile(), role) - 1;
}

physics::HingeLimits kneeLimits(const EditorDocument& document) {
    return document.profile().constraints[constraintIndexOf(document, Role::leftLowerLeg)].hinge;
}

}  // namespace

TEST_CASE("a limit is set, undone and redone") {
    const auto document = makeDocument();
    const int knee = constraintIndexOf(*document, Role::leftLowerLeg);
    const physics::HingeLimits before = kneeLimits(*document);
    REQUIRE(document->setHinge(knee, {-0.5F, 0.6F}).ok());
    CHECK(kneeLimits(*document).upper == 0.6F);
    CHECK(document->unsaved());
    CHECK_THAT(document->undoLabel(), Catch::Contains("leftLowerLeg"));
    document->undo();
    CHECK(kneeLimits(*document).lower == before.lower);
    CHECK(kneeLimits(*document).upper == before.upper);
    CHECK_FALSE(document->unsaved());
    CHECK_FALSE(document->canUndo());
    document->redo();
    CHECK(kneeLimits(*document).upper == 0.6F);
    CHECK_FALSE(document->canRedo());
}

TEST_CASE("changes of one drag are one entry of undo and the next drag is another") {
    const auto document = makeDocument();
    const int knee = constraintIndexOf(*document, Role::leftLowerLeg);
    const float before = kneeLimits(*document).upper;
    for (const float upper : {0.9F, 0.8F, 0.7F})
        REQUIRE(document->setHinge(knee, {-0.1F, upper}, "hinge").ok());
    document->endGroup();
    REQUIRE(document->setHinge(knee, {-0.1F, 0.5F}, "hinge").ok());
    document->undo();
    CHECK(kneeLimits(*document).upper == 0.7F);
    document->undo();
    CHECK(kneeLimits(*document).upper == before);
    CHECK_FALSE(document->canUndo());
}

TEST_CASE("changes that end as they began leave no entry of undo") {
    const auto document = makeDocument();
    const int knee = constraintIndexOf(*document, Role::leftLowerLeg);
    const physics::HingeLimits before = kneeLimits(*document);
    REQUIRE(document->setHinge(knee, {-0.1F, 0.9F}, "hinge").ok());
    REQUIRE(document->setHinge(knee, before, "hinge").ok());
    document->endGroup();
    CHECK_FALSE(document->canUndo());
    CHECK_FALSE(document->unsaved());
    REQUIRE(document->setHinge(knee, {-0.1F, 0.9F}, "hinge").ok());
    document->endGroup();
    CHECK(document->canUndo());
}

TEST_CASE("a mass that is dragged away and back follows the total as if it had not been touched") {
    const auto document = makeDocument();
    const int left = physics::bodyOf(document->profile(), Role::leftUpperLeg);
    const int right = physics::bodyOf(document->profile(), Role::rightUpperLeg);
    const float before = document->profile().bodies[left].massKg;
    REQUIRE(document->setMass(left, before + 1.0F, "mass").ok());
    REQUIRE(document->setMass(left, before, "mass").ok());
    document->endGroup();
    CHECK_FALSE(document->canUndo());
    physics::FitOptions fit = document->state().fit;
    fit.totalMassKg = 150.0F;
    REQUIRE(document->setFit(fit).ok());
    CHECK(document->profile().bodies[left].massKg == Approx(document->profile().bodies[right].massKg));
    CHECK(document->profile().bodies[left].massKg > before * 1.2F);
}

TEST_CASE("a drag that ends as it began or is cancelled leaves what can be redone, one that changes something not") {
    const auto document = makeDocument();
    const int hand = physics::bodyOf(document->profile(), Role::leftHand);
    const float before = document->profile().bodies[hand].massKg;
    REQUIRE(document->setMass(hand, before * 2.0F).ok());
    document->undo();
    REQUIRE(document->setMass(hand, before * 3.0F, "mass").ok());
    CHECK_FALSE(document->canRedo());
    REQUIRE(document->setMass(hand, before, "mass").ok());
    document->endGroup();
    CHECK(document->canRedo());
    REQUIRE(document->setMass(hand, before * 3.0F, "mass").ok());
    document->cancelGroup();
    REQUIRE(document->canRedo());
    document->redo();
    CHECK(document->profile().bodies[hand].massKg == Approx(before * 2.0F));
    document->undo();
    REQUIRE(document->setMass(hand, before * 3.0F, "mass").ok());
    document->endGroup();
    CHECK_FALSE(document->canRedo());
    document->endGroup();
    CHECK_FALSE(document->canRedo());
}

TEST_CASE("a cancelled drag leaves neither a change nor an entry") {
    const auto document = makeDocument();
    const float before = kneeLimits(*document).upper;
    REQUIRE(document->setHinge(constraintIndexOf(*document, Role::leftLowerLeg), {-0.1F, 0.5F}, "hinge").ok());
    document->cancelGroup();
    CHECK(kneeLimits(*document).upper == before);
    CHECK_FALSE(document->canUndo());
    CHECK_FALSE(document->canRedo());
    document->cancelGroup();  // nothing is open: nothing happens
    CHECK(kneeLimits(*document).upper == before);
}

TEST_CASE("a value out of range is refused and nothing changes") {
    const auto document = makeDocument();
    const int knee = constraintIndexOf(*document, Role::leftLowerLeg);
    const std::uint64_t revision = document->revision();
    const auto hinge = document->setHinge(knee, {0.4F, 0.6F});
    REQUIRE_FALSE(hinge.ok());
    CHECK(hinge.error().code == ErrorCode::usage);
    CHECK_FALSE(document->setMass(0, -1.0F).ok());
    CHECK_FALSE(document->setCone(constraintIndexOf(*document, Role::head), {NAN, 1, 1}).ok());
    physics::BodyShape flat;
    flat.radius = 0.0F;
    CHECK_FALSE(document->setShape(0, flat).ok());
    CHECK(document->revision() == revision);
    CHECK_FALSE(document->canUndo());
}

TEST_CASE("a body's mass counts in the total and its inertia grows with it") {
    const auto document = makeDocument();
    const int hand = physics::bodyOf(document->profile(), Role::leftHand);
    const physics::BodyProfile before = document->profile().bodies[hand];
    const float total = document->profile().totalMassKg;
    REQUIRE(document->setMass(hand, before.massKg * 2.0F).ok());
    const physics::BodyProfile& after = document->profile().bodies[hand];
    CHECK(document->profile().totalMassKg == Approx(total + before.massKg).epsilon(1e-5));
    CHECK(after.inertia.x > before.inertia.x * 1.5F);
}

TEST_CASE("a role is given to another joint and the user's edits outlive the new fit") {
    const auto document = makeDocument();
    const int knee = constraintIndexOf(*document, Role::leftLowerLeg);
    REQUIRE(document->setHinge(knee, {-0.5F, 0.6F}).ok());
    const int spine = animation::findJoint(document->character().skeleton, "spine");
    const int chest = animation::findJoint(document->character().skeleton, "chest");
    REQUIRE(document->state().map.jointOf(Role::spine) == spine);
    REQUIRE(document->assignRole(Role::spine, chest).ok());
    CHECK(document->state().map.jointOf(Role::spine) == chest);
    CHECK(document->state().map[Role::spine]->joint != spine);
    CHECK(kneeLimits(*document).upper == 0.6F);
    const int body = physics::bodyOf(document->profile(), Role::spine);
    CHECK(document->profile().bodies[body].joint == "chest");
    document->undo();
    CHECK(document->state().map.jointOf(Role::spine) == spine);
}

TEST_CASE("mapping again keeps what the user fixed until it is told to forget") {
    const auto document = makeDocument();
    const int chest = animation::findJoint(document->character().skeleton, "chest");
    const int spine = document->state().map.jointOf(Role::spine);
    REQUIRE(document->assignRole(Role::spine, chest).ok());
    REQUIRE(document->mapAgain(false).ok());
    CHECK(document->state().map.jointOf(Role::spine) == chest);
    REQUIRE(document->mapAgain(true).ok());
    CHECK(document->state().map.jointOf(Role::spine) == spine);
}

TEST_CASE("an optional role can be unmapped and a required one cannot") {
    const auto document = makeDocument();
    REQUIRE(document->state().map.jointOf(Role::neck) >= 0);
    REQUIRE(document->unmapRole(Role::neck).ok());
    CHECK(document->state().map.jointOf(Role::neck) == animation::kNoJoint);
    const auto refused = document->unmapRole(Role::hips);
    REQUIRE_FALSE(refused.ok());
    CHECK(refused.error().code == ErrorCode::input);
    CHECK(document->state().map.jointOf(Role::hips) >= 0);
}

TEST_CASE("mirroring the mapping gives the other side the joints opposite") {
    const auto document = makeDocument();
    REQUIRE(document->mirrorRoles(animation::Side::left).ok());
    const auto& skeleton = document->character().skeleton;
    const int hand = document->state().map.jointOf(Role::rightHand);
    REQUIRE(hand >= 0);
    CHECK(skeleton.names[hand] == "rightHand");
    CHECK(document->state().fixed[animation::indexOf(Role::rightHand)] == hand);
}

TEST_CASE("mirroring a part gives the other side its values") {
    const auto document = makeDocument();
    const int left = physics::bodyOf(document->profile(), Role::leftLowerLeg);
    REQUIRE(document->setHinge(left - 1, {-0.3F, 0.4F}).ok());
    REQUIRE(document->mirrorParts(std::span(&left, 1)).ok());
    const int right = physics::bodyOf(document->profile(), Role::rightLowerLeg);
    CHECK(document->profile().constraints[right - 1].hinge.upper == 0.4F);
    CHECK_FALSE(document->mirrorParts(std::array{physics::bodyOf(document->profile(), Role::head)}).ok());
}

TEST_CASE("a part that is reset is as fitted again") {
    const auto document = makeDocument();
    const int knee = physics::bodyOf(document->profile(), Role::leftLowerLeg);
    const auto fitted = physics::profileToJson(document->profile());
    REQUIRE(document->setMass(knee, 9.0F).ok());
    REQUIRE(document->setHinge(knee - 1, {-0.3F, 0.4F}).ok());
    REQUIRE(document->resetParts(std::span(&knee, 1)).ok());
    CHECK(physics::profileToJson(document->profile()) == fitted);
}

TEST_CASE("what is saved is what is loaded and the mark of unsaved changes goes") {
    const auto document = makeDocument();
    const test::ScratchFolder folder;
    const std::filesystem::path file = folder / "biped.ragdoll.json";
    REQUIRE(document->setHinge(constraintIndexOf(*document, Role::leftLowerLeg), {-0.5F, 0.6F}).ok());
    REQUIRE(document->save(file).ok());
    CHECK_FALSE(document->unsaved());
    CHECK(document->profileFile() == file);
    const auto loaded = physics::loadProfile(file);
    REQUIRE(loaded.ok());
    CHECK(physics::profileToJson(loaded.value()) == physics::profileToJson(document->profile()));
    document->undo();
    CHECK(document->unsaved());
    REQUIRE(document->useProfile(file).ok());
    CHECK(kneeLimits(*document).upper == 0.6F);
    std::filesystem::remove(file);
    CHECK_FALSE(document->useProfile(file).ok());
}

TEST_CASE("a profile of another rig is bound by role, and its file is not written over") {
    const auto document = makeDocument();
    const test::ScratchFolder folder;
    const std::filesystem::path file = folder / "other.ragdoll.json";
    physics::RagdollProfile other = document->profile();
    for (physics::BodyProfile& body : other.bodies) {
        body.joint = "other " + body.joint;
        body.jointPath = "Other/" + body.joint;
    }
    const int knee = constraintIndexOf(*document, Role::leftLowerLeg);
    other.constraints[knee].frictionNm = 3.5F;
    REQUIRE(physics::saveProfile(file, other).ok());
    REQUIRE(document->useProfile(file).ok());
    CHECK(document->profile().bodies[1].joint.find("other") == std::string::npos);
    CHECK(document->profile().constraints[knee].frictionNm == 3.5F);
    CHECK(document->unsaved());
    CHECK(document->profileFile() != file);
    CHECK(profileNews(*document, file) == "other.ragdoll.json was made for another rig and is bound by role");
    document->undo();
    CHECK(document->profile().constraints[knee].frictionNm != 3.5F);
    // A few joints that are not there are typos.
    physics::RagdollProfile mistyped = document->profile();
    mistyped.bodies[3].joint = mistyped.bodies[3].jointPath = "nowhere";
    REQUIRE(physics::saveProfile(file, mistyped).ok());
    const Result<void> refused = document->useProfile(file);
    REQUIRE_FALSE(refused.ok());
    CHECK_THAT(refused.error().text(), Catch::Contains("nowhere") && Catch::Contains("other.ragdoll.json"));
}

TEST_CASE("the doctor finds a limit that excludes the bind pose and mending it is one undoable edit") {
    const auto document = makeDocument();
    const int knee = constraintIndexOf(*document, Role::leftLowerLeg);
    const auto has = [&](const char* code) {
        const auto& findings = document->diagnosis().findings;
        return std::any_of(findings.begin(), findings.end(),
                           [&](const physics::Finding& finding) { return finding.code == code; });
    };
    REQUIRE_FALSE(has("bind-outside-limits"));
    REQUIRE(document->setHinge(knee, {-0.05F, 0.6F}).ok());
    REQUIRE(has("bind-outside-limits"));
    REQUIRE(document->mend(document->diagnosis().findings).ok());
    CHECK_FALSE(has("bind-outside-limits"));
    document->undo();
    CHECK(has("bind-outside-limits"));
    CHECK(kneeLimits(*document).lower == -0.05F);
}

TEST_CASE("a scene that does not exist is refused") {
    const auto document = makeDocument();
    SceneSettings scene = document->sceneDocument().settings();
    scene.scenario = "moon";
    const auto refused = document->setScene(scene, "Scene");
    REQUIRE_FALSE(refused.ok());
    CHECK(refused.error().code == ErrorCode::usage);
    scene.scenario = "drop";
    scene.count = 0;
    CHECK_FALSE(document->setScene(scene, "Scene").ok());
    CHECK(document->sceneDocument().settings().count == 1);
}

TEST_CASE("the undo stack forgets its oldest entries and not its newest") {
    UndoStack<int> stack;
    const int most = static_cast<int>(UndoStack<int>::kMaxEntries);
    for (int i = 0; i < most + 50; ++i)
        stack.changed(i, "change", "");
    CHECK(stack.undoLabels().size() == UndoStack<int>::kMaxEntries);
    CHECK(stack.undo(999) == most + 49);
    CHECK(stack.redo(7) == 999);
}

TEST_CASE("what an opened profile holds outlives a change of the mapping, and it opens as saved") {
    const auto document = makeDocument();
    const test::ScratchFolder folder;
    const std::filesystem::path file = folder / "biped.ragdoll.json";
    REQUIRE(document->setHinge(constraintIndexOf(*document, Role::leftLowerLeg), {-0.5F, 0.6F}).ok());
    REQUIRE(document->save(file).ok());
    const auto again = makeDocument();
    REQUIRE(again->useProfile(file).ok());
    CHECK_FALSE(again->unsaved());
    const int chest = animation::findJoint(again->character().skeleton, "chest");
    REQUIRE(again->assignRole(Role::spine, chest).ok());
    CHECK(kneeLimits(*again).lower == -0.5F);
    CHECK(kneeLimits(*again).upper == 0.6F);
    again->undo();
    CHECK(kneeLimits(*again).upper == 0.6F);
}
