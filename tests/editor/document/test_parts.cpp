/// EditorDocument's edits of bodies and constraints.

#include <array>
#include <glm/geometric.hpp>

#include "editor/document/body_shape.hpp"
#include "editor/sessions.hpp"
#include "physics/profile/profile_io.hpp"
#include "physics/rig/rig.hpp"
#include "support/command.hpp"
#include "support/zoo.hpp"

using namespace lutka;
using namespace lutka::editor;
using animation::Role;
using physics::ConstraintProfile;
using test::makeDocument;
using Part = EditorDocument::Part;

namespace {

int bodyOf(const EditorDocument& document, Role role) {
    return physics::bodyOf(document.profile(), role);
}

const ConstraintProfile& constraintOf(const EditorDocument& document, Role role) {
    return document.profile().constraints[bodyOf(document, role) - 1];
}

physics::JointRange rangeOf(const EditorDocument& document, Role role) {
    return physics::jointRange(constraintOf(document, role), document.bindOf(bodyOf(document, role) - 1));
}

Result<void> widenFlexion(Part& part) {
    physics::JointRange range = physics::jointRange(*part.constraint, part.bind);
    range.flexion.high += radians(10.0F);
    physics::setJointRange(*part.constraint, range, part.bind);
    return {};
}

std::string text(const EditorDocument& document) {
    return physics::profileToJson(document.profile());
}

}  // namespace

TEST_CASE("several bodies take the same change as one entry of undo") {
    const auto document = makeDocument();
    const std::array bodies = {bodyOf(*document, Role::leftUpperLeg), bodyOf(*document, Role::rightUpperLeg)};
    const std::string before = text(*document);
    const float left = rangeOf(*document, Role::leftUpperLeg).flexion.high;
    const float right = rangeOf(*document, Role::rightUpperLeg).flexion.high;
    REQUIRE(document->changeParts(bodies, "Flexion", "", widenFlexion).ok());
    CHECK(rangeOf(*document, Role::leftUpperLeg).flexion.high == Approx(left + radians(10.0F)).margin(1e-4));
    CHECK(rangeOf(*document, Role::rightUpperLeg).flexion.high == Approx(right + radians(10.0F)).margin(1e-4));
    CHECK_THAT(document->undoLabel(), Catch::Contains("2 bodies"));
    document->undo();
    CHECK(text(*document) == before);
    CHECK_FALSE(document->canUndo());
}

TEST_CASE("a change that is taken back by hand is no edit any more") {
    const auto document = makeDocument();
    const std::array hand = {bodyOf(*document, Role::leftHand)};
    const float fitted = document->profile().bodies[hand[0]].massKg;
    const auto setMass = [&](float mass) {
        return document->changeParts(hand, "Mass", "", [&](Part& part) -> Result<void> {
            part.body.massKg = mass;
            return {};
        });
    };
    REQUIRE(setMass(2.0F).ok());
    CHECK(document->state().edits.at("leftHand").massKg == 2.0F);
    REQUIRE(setMass(fitted).ok());
    CHECK_FALSE(document->state().edits.at("leftHand").any());
}

TEST_CASE("a body's place in its joint is edited and its anchors stay") {
    const auto document = makeDocument();
    const int shin = bodyOf(*document, Role::leftLowerLeg);
    const auto anchor = [&] {
        const physics::BindFrames bind = document->bindOf(shin - 1);
        return bind.fromChild * document->profile().constraints[shin - 1].childFromFrame.translation;
    };
    const vec3 before = anchor();
    const vec3 was = document->profile().bodies[shin].jointFromBody.translation;
    REQUIRE(document
                ->changeParts(std::array{shin}, "Offset", "",
                              [](Part& part) -> Result<void> {
                                  part.body.jointFromBody.translation += vec3(0.03F, 0, 0);
                                  return {};
                              })
                .ok());
    CHECK(document->profile().bodies[shin].jointFromBody.translation.x == Approx(was.x + 0.03F));
    CHECK(glm::distance(anchor(), before) < 1e-5F);
    const PartEdits& edits = document->state().edits.at("leftLowerLeg");
    CHECK(edits.jointFromBody.has_value());
    CHECK_FALSE(edits.frames.has_value());
    REQUIRE(document->resetParts(std::span(&shin, 1)).ok());
    CHECK(document->profile().bodies[shin].jointFromBody.translation == was);
}

TEST_CASE("a knee becomes a cone, survives a new mapping, and is a hinge again when it is reset") {
    const auto document = makeDocument();
    const int knee = bodyOf(*document, Role::leftLowerLeg);
    REQUIRE(document
                ->changeParts(std::array{knee}, "Kind", "",
                              [](Part& part) -> Result<void> {
                                  physics::changeKind(*part.constraint, ConstraintProfile::Kind::coneTwist, part.bind);
                                  return {};
                              })
                .ok());
    CHECK(constraintOf(*document, Role::leftLowerLeg).kind == ConstraintProfile::Kind::coneTwist);
    const int chest = animation::findJoint(document->character().skeleton, "chest");
    REQUIRE(document->assignRole(Role::spine, chest).ok());
    CHECK(constraintOf(*document, Role::leftLowerLeg).kind == ConstraintProfile::Kind::coneTwist);
    REQUIRE(document->resetParts(std::array{bodyOf(*document, Role::leftLowerLeg)}).ok());
    CHECK(constraintOf(*document, Role::leftLowerLeg).kind == ConstraintProfile::Kind::hinge);
}

TEST_CASE("everything that was edited is in the saved file and outlives a new mapping of it") {
    const auto document = makeDocument();
    const test::ScratchFolder folder;
    const std::filesystem::path file = folder / "edited.ragdoll.json";
    const std::array hip = {bodyOf(*document, Role::leftUpperLeg)};
    REQUIRE(document
                ->changeParts(hip, "All", "",
                              [](Part& part) -> Result<void> {
                                  part.body.jointFromBody.translation.y += 0.02F;
                                  part.body.jointFromBody.rotation =
                                      glm::angleAxis(0.2F, vec3(1, 0, 0)) * part.body.jointFromBody.rotation;
                                  physics::turnFrames(*part.constraint, glm::angleAxis(0.3F, vec3(1, 0, 0)));
                                  return widenFlexion(part);
                              })
                .ok());
    const int leftHand = bodyOf(*document, Role::leftHand);
    const int head = bodyOf(*document, Role::head);
    const bool collided = document->collides(leftHand, head);
    REQUIRE(document->setCollision(leftHand, head, !collided).ok());
    REQUIRE(document->save(file).ok());
    const auto again = makeDocument();
    REQUIRE(again->useProfile(file).ok());
    CHECK(text(*again) == text(*document));
    REQUIRE(again->mapAgain(false).ok());
    const auto& before = document->profile();
    const auto& after = again->profile();
    const int body = hip[0];
    CHECK(glm::distance(after.bodies[body].jointFromBody.translation, before.bodies[body].jointFromBody.translation) <
          1e-5F);
    const auto& c = after.constraints[body - 1];
    const auto& d = before.constraints[body - 1];
    CHECK(std::abs(glm::dot(c.parentFromFrame.rotation, d.parentFromFrame.rotation)) > 0.99999F);
    CHECK(std::abs(glm::dot(c.childFromFrame.rotation, d.childFromFrame.rotation)) > 0.99999F);
    CHECK(c.cone.swingZ == Approx(d.cone.swingZ));
    CHECK(again->collides(leftHand, head) == !collided);
}

TEST_CASE("limits that are copied to the other side mean the same there") {
    const auto document = makeDocument();
    const std::array left = {bodyOf(*document, Role::leftUpperLeg)};
    REQUIRE(document
                ->changeParts(left, "Abduction", "",
                              [](Part& part) -> Result<void> {
                                  physics::JointRange range = physics::jointRange(*part.constraint, part.bind);
                                  range.side = {radians(-5.0F), radians(60.0F)};
                                  physics::setJointRange(*part.constraint, range, part.bind);
                                  part.constraint->frictionNm = 3.0F;
                                  return {};
                              })
                .ok());
    const auto values = document->copyPart(left[0]);
    const std::array right = {bodyOf(*document, Role::rightUpperLeg)};
    REQUIRE(document->pasteParts(right, values).ok());
    const physics::JointRange pasted = rangeOf(*document, Role::rightUpperLeg);
    CHECK(degrees(pasted.side.low) == Approx(-60.0F).margin(0.05));
    CHECK(degrees(pasted.side.high) == Approx(5.0F).margin(0.05));
    CHECK(constraintOf(*document, Role::rightUpperLeg).frictionNm == 3.0F);
    // On a hinge the kind comes along.
    REQUIRE(document->pasteParts(std::array{bodyOf(*document, Role::rightLowerLeg)}, values).ok());
    CHECK(constraintOf(*document, Role::rightLowerLeg).kind == ConstraintProfile::Kind::coneTwist);
    // The root has no joint; its body is pasted all the same.
    REQUIRE(document->pasteParts(std::array{0}, values).ok());
    CHECK(document->profile().bodies[0].massKg == values.massKg);
}

TEST_CASE("a joint's spring is an edit that is undone, copied, mirrored, saved and kept through new limits") {
    const auto document = makeDocument();
    const int left = bodyOf(*document, Role::leftUpperLeg);
    const int right = bodyOf(*document, Role::rightUpperLeg);
    const auto spring = [&](Role role) { return constraintOf(*document, role).spring; };
    const auto set = [&](float stiffness) {
        return document->changeParts(std::array{left}, "Stiffness", "", [&](Part& part) -> Result<void> {
            part.constraint->spring = {stiffness, 2.0F, physics::relativeFrame(*part.constraint, part.bind)};
            return {};
        });
    };
    REQUIRE(set(40.0F).ok());
    CHECK(spring(Role::leftUpperLeg).stiffness == 40.0F);
    document->undo();
    CHECK_FALSE(spring(Role::leftUpperLeg).works());
    document->redo();
    CHECK(spring(Role::leftUpperLeg).damping == 2.0F);
    // Another range moves what the joint calls 0; the spring rests in the bind pose all the same.
    REQUIRE(document
                ->changeParts(std::array{left}, "Flexion", "",
                              [](Part& part) -> Result<void> {
                                  physics::JointRange range = physics::jointRange(*part.constraint, part.bind);
                                  range.flexion = {radians(-5.0F), radians(90.0F)};
                                  physics::setJointRange(*part.constraint, range, part.bind);
                                  return {};
                              })
                .ok());
    const auto isBind = [&](int body) {
        const quat rest =
            physics::springFromBind(document->profile().constraints[body - 1], document->bindOf(body - 1)).rest;
        return std::abs(rest.w) > 0.99999F;
    };
    CHECK(isBind(left));
    REQUIRE(document->mirrorParts(std::span(&left, 1)).ok());
    CHECK(spring(Role::rightUpperLeg).stiffness == 40.0F);
    CHECK(isBind(right));
    REQUIRE(document->pasteParts(std::array{bodyOf(*document, Role::leftLowerLeg)}, document->copyPart(left)).ok());
    CHECK(spring(Role::leftLowerLeg).stiffness == 40.0F);
    CHECK(isBind(bodyOf(*document, Role::leftLowerLeg)));
    const auto saved = physics::profileFromJson(physics::profileToJson(document->profile()), "saved");
    REQUIRE(saved.ok());
    CHECK(saved.value().constraints[left - 1].spring.stiffness == 40.0F);
    CHECK_FALSE(set(-1.0F).ok());
    CHECK_FALSE(set(std::numeric_limits<float>::quiet_NaN()).ok());
    REQUIRE(document->resetParts(std::span(&left, 1)).ok());
    CHECK_FALSE(spring(Role::leftUpperLeg).works());
}

TEST_CASE("a further shape is an edit that is undone, mirrored, copied and saved") {
    const auto document = makeDocument();
    const std::array arm = {bodyOf(*document, Role::leftUpperArm)};
    const int other = bodyOf(*document, Role::rightUpperArm);
    const std::string before = text(*document);
    const float moment = document->profile().bodies[arm[0]].inertia.y;
    REQUIRE(document
                ->changeParts(arm, "Add a shape", "",
                              [](Part& part) {
                                  auto done = addShape(part.body.shape, physics::PrimitiveShape::Kind::sphere);
                                  part.body.shape.more.back().bodyFromShape.translation = {0.1F, 0.02F, 0.05F};
                                  return done;
                              })
                .ok());
    const auto added = [&](int body) { return document->profile().bodies[body].shape.more; };
    REQUIRE(added(arm[0]).size() == 1);
    CHECK(document->profile().bodies[arm[0]].inertia.y > moment);
    CHECK_FALSE(text(*document) == before);
    REQUIRE(document->mirrorParts(arm).ok());
    REQUIRE(added(other).size() == 1);
    CHECK(added(other)[0].bodyFromShape.translation == vec3(-0.1F, 0.02F, 0.05F));
    // Where both lie in the bind pose, they are mirror images.
    const auto& bind = document->asset().rig.bindModelFromBody;
    const vec3 left = bind[arm[0]] * added(arm[0])[0].bodyFromShape.translation;
    const vec3 right = bind[other] * added(other)[0].bodyFromShape.translation;
    CHECK(glm::distance(vec3(-left.x, left.y, left.z), right) < 1e-3F);
    document->undo();
    CHECK(added(other).empty());
    REQUIRE(document->pasteParts(std::array{other}, document->copyPart(arm[0])).ok());
    REQUIRE(added(other).size() == 1);
    CHECK(added(other)[0].bodyFromShape.translation.x == -0.1F);
    const auto back = physics::profileFromJson(text(*document), "memory");
    REQUIRE(back);
    CHECK(back.value().bodies[arm[0]].shape.more.size() == 1);
    document->undo();
    document->undo();
    CHECK(text(*document) == before);
}

TEST_CASE("a body's strength is an edit that is undone, copied, mirrored, saved and taken back") {
    const auto document = makeDocument();
    const int left = bodyOf(*document, Role::leftLowerArm);
    const auto strength = [&](Role role) {
        return document->profile().bodies[bodyOf(*document, role)].muscle.strength;
    };
    REQUIRE(document
                ->changeParts(std::array{left}, "Strength", "",
                              [](Part& part) -> Result<void> {
                                  part.body.muscle.strength = 0.25F;
                                  return {};
                              })
                .ok());
    CHECK(strength(Role::leftLowerArm) == 0.25F);
    document->undo();
    CHECK(strength(Role::leftLowerArm) == 1.0F);
    document->redo();
    REQUIRE(document->mirrorParts(std::span(&left, 1)).ok());
    CHECK(strength(Role::rightLowerArm) == 0.25F);
    REQUIRE(document->pasteParts(std::array{bodyOf(*document, Role::leftHand)}, document->copyPart(left)).ok());
    CHECK(strength(Role::leftHand) == 0.25F);
    const auto saved = physics::profileFromJson(physics::profileToJson(document->profile()), "saved");
    REQUIRE(saved.ok());
    CHECK(saved.value().bodies[left].muscle.strength == 0.25F);
    REQUIRE(document->resetParts(std::span(&left, 1)).ok());
    CHECK(strength(Role::leftLowerArm) == 1.0F);
}

TEST_CASE("mirroring takes range, axes and place across the figure") {
    const auto document = makeDocument();
    const int left = bodyOf(*document, Role::leftUpperLeg);
    REQUIRE(document
                ->changeParts(std::array{left}, "All", "",
                              [](Part& part) -> Result<void> {
                                  part.body.jointFromBody.translation += vec3(0.03F, 0.01F, 0.02F);
                                  physics::JointRange range = physics::jointRange(*part.constraint, part.bind);
                                  range.side = {radians(-5.0F), radians(60.0F)};
                                  range.twist = {radians(-10.0F), radians(30.0F)};
                                  physics::setJointRange(*part.constraint, range, part.bind);
                                  return {};
                              })
                .ok());
    REQUIRE(document->mirrorParts(std::span(&left, 1)).ok());
    const physics::JointRange mirrored = rangeOf(*document, Role::rightUpperLeg);
    CHECK(degrees(mirrored.side.low) == Approx(-60.0F).margin(0.5));
    CHECK(degrees(mirrored.side.high) == Approx(5.0F).margin(0.5));
    CHECK(degrees(mirrored.twist.low) == Approx(-30.0F).margin(0.5));
    CHECK(degrees(mirrored.flexion.high) ==
          Approx(degrees(rangeOf(*document, Role::leftUpperLeg).flexion.high)).margin(0.5));
    const int right = bodyOf(*document, Role::rightUpperLeg);
    const vec3 a = document->bindOf(left - 1).fromChild.translation;
    const vec3 b = document->bindOf(right - 1).fromChild.translation;
    CHECK(glm::distance(a, vec3(-b.x, b.y, b.z)) < 1e-3F);
    // Mirrored back, everything is where it was.
    const physics::JointRange own = rangeOf(*document, Role::leftUpperLeg);
    REQUIRE(document->mirrorParts(std::span(&right, 1)).ok());
    CHECK(rangeOf(*document, Role::leftUpperLeg).twist.high == Approx(own.twist.high).margin(1e-3));
}

TEST_CASE("pairs of the collision filter are toggled and linked bodies refuse it") {
    const auto document = makeDocument();
    const int hand = bodyOf(*document, Role::leftHand);
    const int head = bodyOf(*document, Role::head);
    const bool before = document->collides(hand, head);
    REQUIRE(document->setCollision(head, hand, !before).ok());
    CHECK(document->collides(hand, head) == !before);
    REQUIRE(document->setCollision(hand, head, before).ok());
    CHECK(document->collides(head, hand) == before);
    const auto refused = document->setCollision(hand, bodyOf(*document, Role::leftLowerArm), true);
    REQUIRE_FALSE(refused.ok());
    CHECK(refused.error().code == ErrorCode::usage);
    CHECK_FALSE(document->collides(hand, bodyOf(*document, Role::leftLowerArm)));
}

TEST_CASE("a preset is an edit of the whole ragdoll that keeps what was set by hand") {
    const auto document = makeDocument();
    const int knee = bodyOf(*document, Role::leftLowerLeg) - 1;
    REQUIRE(document->setFriction(knee, 7.0F).ok());
    const float hip = constraintOf(*document, Role::leftUpperLeg).frictionNm;
    physics::FitOptions fit = document->state().fit;
    fit.preset = physics::RagdollPreset::stiff;
    REQUIRE(document->setFit(fit).ok());
    CHECK(constraintOf(*document, Role::leftUpperLeg).frictionNm == Approx(hip * 8.0F));
    CHECK(constraintOf(*document, Role::leftLowerLeg).frictionNm == 7.0F);
    document->undo();
    CHECK(constraintOf(*document, Role::leftUpperLeg).frictionNm == hip);
}

TEST_CASE("a change without bodies or out of range is refused and leaves nothing behind") {
    const auto document = makeDocument();
    const auto nothing = [](Part& /*part*/) -> Result<void> { return {}; };
    CHECK_FALSE(document->changeParts({}, "Nothing", "", nothing).ok());
    const auto negative = [](Part& part) -> Result<void> {
        part.body.massKg = -1.0F;
        return {};
    };
    CHECK_FALSE(document->changeParts(std::array{1, 2}, "Mass", "", negative).ok());
    CHECK_FALSE(document->canUndo());
}

TEST_CASE("undoing the opening of a profile takes its file back as what is saved to") {
    const auto document = makeDocument();
    const test::ScratchFolder folder;
    const std::filesystem::path plain = document->profileFile();
    const std::filesystem::path file = folder / "other.ragdoll.json";
    REQUIRE(physics::saveProfile(file, document->profile()).ok());
    REQUIRE(document->useProfile(file).ok());
    CHECK(document->profileFile() == file);
    document->undo();
    CHECK(document->profileFile() == plain);
    CHECK_FALSE(document->unsaved());
    document->redo();
    CHECK(document->profileFile() == file);
    const std::filesystem::path copy = folder / "copy.ragdoll.json";
    REQUIRE(document->save(copy).ok());
    CHECK(document->profileFile() == copy);
    CHECK_FALSE(document->wouldReplace(copy));
    CHECK_FALSE(document->wouldReplace(file));
}

TEST_CASE("a file that was neither opened nor saved would be replaced") {
    const auto document = makeDocument();
    const test::ScratchFolder folder;
    const std::filesystem::path file = folder / "theirs.ragdoll.json";
    CHECK_FALSE(document->wouldReplace(file));
    REQUIRE(physics::saveProfile(file, document->profile()).ok());
    CHECK(document->wouldReplace(file));
    REQUIRE(document->save(file).ok());
    CHECK_FALSE(document->wouldReplace(file));
}

TEST_CASE("the history lists all changes and goes to any of them") {
    const auto editor = test::makeEditor();
    const int hand = bodyOf(editor->document(), Role::leftHand);
    const float fitted = editor->document().profile().bodies[hand].massKg;
    for (const float mass : {1.0F, 2.0F, 3.0F})
        REQUIRE(editor->edit([&](EditorDocument& document) { return document.setMass(hand, mass); }));
    REQUIRE(editor->document().undoLabels().size() == 3);
    CHECK(editor->document().undoLabels().front() == "Mass of leftHand");
    editor->travel(-2);
    CHECK(editor->document().profile().bodies[hand].massKg == 1.0F);
    CHECK(editor->document().redoLabels().size() == 2);
    editor->travel(2);
    CHECK(editor->document().profile().bodies[hand].massKg == 3.0F);
    editor->travel(-3);
    CHECK(editor->document().profile().bodies[hand].massKg == fitted);
}

TEST_CASE("a Fix that the doctor offers for a real model mends, and what no fit mends is told and not offered") {
    NEEDS_ZOO();
    const char* models[] = {"kaykit_rogue/Rogue_Hooded.glb", "godot_platformer_robot/platformer_player.glb",
                            "sketchbook_boxman/boxman.glb", "khronos_rigged_figure/RiggedFigure.glb"};
    int told = 0;
    for (const char* model : models) {
        const auto opened = EditorDocument::open(test::zooFile(model));
        REQUIRE(opened.ok());
        EditorDocument& document = *opened.value();
        const physics::Diagnosis diagnosis = document.diagnosis();
        for (const physics::Finding& finding : diagnosis.findings) {
            INFO(model << ": " << finding.code << " at " << finding.place);
            if (!document.canMend(finding)) {
                told += finding.code == "skin-not-covered" ? 1 : 0;
                continue;
            }
            const Result<void> mended = document.mend(std::span(&finding, 1));
            CHECK(mended.ok());
            if (mended.ok()) document.undo();
        }
    }
    CHECK(told > 2);  // the Rogue's cape and weapons
}
