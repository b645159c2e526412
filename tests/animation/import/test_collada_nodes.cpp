// Which node a Collada document means: the joints of skins, the targets of channels, the scene.

#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <string>

#include "animation/import/assimp/collada_nodes.hpp"
#include "animation/import/checks.hpp"
#include "animation/import/collada_file.hpp"
#include "animation/import/gltf_file.hpp"
#include "animation/pose.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::animation;
using namespace lutka::test;

namespace {

Character read(const TemporaryFolder& folder, const std::string& text) {
    std::ofstream(folder / "figure.dae", std::ios::binary) << text;
    Character character = imported(folder / "figure.dae");
    checkInvariants(character);
    return character;
}

// The joint that moves the top of the first mesh.
std::string topJoint(const Character& character) {
    const SkinnedMesh& mesh = character.meshes.at(0);
    std::size_t top = 0;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        top = mesh.positions[v].y > mesh.positions[top].y ? v : top;
    return jointPath(character.skeleton, mesh.joints[top][0]);
}

// Where a joint stands in a clip, in the space of its parent, for a file in metres.
RigidTransform inClip(const Character& character, const std::string& clip, const std::string& joint, float seconds) {
    for (const Clip& one : character.clips) {
        if (one.name != clip && !clip.empty()) continue;
        std::vector<RigidTransform> pose(character.skeleton.parents.size());
        sampleClip(one, seconds, pose);
        return pose[static_cast<std::size_t>(findJoint(character.skeleton, joint))];
    }
    FAIL("no clip " + clip);
    return {};
}

float turnAboutZDeg(const RigidTransform& frame) {
    return 2.0F * std::atan2(frame.rotation.z, frame.rotation.w) * 57.29578F;
}

std::string movement(const std::string& content, const std::string& name = "move") {
    return "<animation id=\"" + name + "\" name=\"" + name + "\">" + content + "</animation>";
}

ColladaFile oneFigure() {
    ColladaFile file;
    file.nodes = colladaJoints("") + colladaBody("body", "low");
    return file;
}

}  // namespace

TEST_CASE("a Collada skin's joints are those of the skeleton that it is shown with, though another has the same sids") {
    const TemporaryFolder folder;
    ColladaFile file;
    file.nodes = "<node id=\"a\">" + colladaJoints("a-") + "</node><node id=\"b\">" + colladaJoints("b-", 30.0F) +
                 "</node>" + colladaBody("body", "b-low");
    CHECK(topJoint(read(folder, file.text())).find("/b/b-low/") != std::string::npos);
    file.nodes.replace(file.nodes.find("#b-low"), 6, "#a-low");
    CHECK(topJoint(read(folder, file.text())).find("/a/a-low/") != std::string::npos);
}

TEST_CASE("a Collada skin that is shown with several skeletons has joints of each") {
    const TemporaryFolder folder;
    ColladaFile file;
    file.nodes = "<node id=\"a\">" + colladaJoints("a-") + "</node><node id=\"b\">" + colladaJoints("b-") + "</node>" +
                 colladaBody("one", "a-low") + colladaBody("two", "b-low") + colladaBody("three", "a-low");
    const rig_import::SettledCollada settled = rig_import::settledCollada(file.text());
    CHECK(settled.warnings.empty());
    CHECK(settled.text.find("a-low a-middle a-high</Name_array>") != std::string::npos);
    CHECK(settled.text.find("b-low b-middle b-high</Name_array>") != std::string::npos);
    // One copy, whose parts name each other and the same geometry.
    CHECK(settled.text.find("<controller id=\"c-own-1\"><skin source=\"#g\">") != std::string::npos);
    CHECK(settled.text.find("<input semantic=\"JOINT\" source=\"#j-own-1\"/>") != std::string::npos);
    CHECK(settled.text.find("c-own-2") == std::string::npos);
    const Character character = read(folder, file.text());
    const float moved =
        character.skeleton.skinWeight[static_cast<std::size_t>(findJoint(character.skeleton, "a-high"))] +
        character.skeleton.skinWeight[static_cast<std::size_t>(findJoint(character.skeleton, "b-high"))];
    CHECK(moved > 3.0F);
    CHECK_FALSE(warns(character, "several skeletons"));
}

TEST_CASE(
    "a Collada skin may call its joints by their ids or names, with blanks in them, and other nodes by the same") {
    const TemporaryFolder folder;
    ColladaFile file = oneFigure();
    file.nodes = colladaJoints("id-of-") + colladaBody("body", "id-of-low");
    for (const char* list : {"Name_array", "IDREF_array"}) {
        INFO(list);
        file.jointList = list;
        file.jointNames = "id-of-low id-of-middle id-of-high";
        CHECK(topJoint(read(folder, file.text())).find("id-of-high") != std::string::npos);
    }
    // Things that have a joint's sid as their name or id, and come first.
    file = oneFigure();
    file.nodes = "<node id=\"x\" name=\"high\"/><node id=\"high\" name=\"hat\"/>" + colladaJoints("id-of-") +
                 colladaBody("body", "id-of-low");
    CHECK(topJoint(read(folder, file.text())).find("id-of-high") != std::string::npos);
    // Names with blanks are more words than joints; and nodes without ids or sids.
    std::string nodes = colladaJoints("");
    for (const char* joint : {"low", "middle", "high"}) {
        const std::string attributes = std::string("id=\"") + joint + "\" sid=\"" + joint + "\" name=\"" + joint + '"';
        nodes.replace(nodes.find(attributes), attributes.size(), std::string("name=\"Bip01 ") + joint + '"');
    }
    file.nodes = nodes + colladaBody("body", "");
    file.jointNames = "Bip01 low Bip01 middle Bip01 high";
    CHECK(topJoint(read(folder, file.text())).find("Bip01 high") != std::string::npos);
}

TEST_CASE("a Collada channel reaches its node over sids, by its name, and by ids with dots and brackets") {
    const TemporaryFolder folder;
    const auto turned = [&](const std::string& nodes, const std::string& target, const std::string& joint) {
        ColladaFile file;
        file.nodes = nodes + colladaBody("body", "");
        file.animations = movement(colladaChannel("k", target, {0, 1}, {0, 60}));
        const Character character = read(folder, file.text());
        CHECK(character.warnings.empty());
        return turnAboutZDeg(inClip(character, "", joint, 0.5F));
    };
    const std::string plain = colladaJoints("");
    CHECK(turned(plain, "middle/rz.ANGLE", "middle") == Approx(30).margin(0.1));
    CHECK(turned(colladaJoints("id-"), "id-low/middle/rz.angle", "id-middle") == Approx(30).margin(0.1));
    CHECK(turned(colladaJoints("id-"), "middle/rz(3)", "id-middle") == Approx(30).margin(0.1));
    CHECK(turned(colladaJoints("Arm.L(1)/"), "Arm.L(1)/middle/rz.ANGLE", "Arm.L(1)/middle") == Approx(30).margin(0.1));
}

TEST_CASE("Collada channels that move no part of a node are told, and leave the others as they are") {
    const TemporaryFolder folder;
    ColladaFile file = oneFigure();
    file.animations = movement(
        colladaChannel("a", "middle/rz.ANGLE", {0, 1}, {0, 60}) +
        colladaChannel("b", "midle/rz.ANGLE", {0, 1}, {0, 60}) + colladaChannel("d", "middle/rz.TURN", {0, 1}, {0, 9}) +
        colladaChannel("e", "middle/t(3)", {0, 1}, {0, 9}) + colladaChannel("f", "g/s", {0, 1}, {0, 1}));
    const Character character = read(folder, file.text());
    CHECK(turnAboutZDeg(inClip(character, "", "middle", 0.5F)) == Approx(30).margin(0.1));
    CHECK(inClip(character, "", "middle", 1.0F).translation.y == Approx(0.6F).margin(1e-4));
    CHECK(warns(character, "animations of what is not in the file: midle/rz.ANGLE, middle/rz.TURN, middle/t(3)"));
}

TEST_CASE("a Collada channel may move a whole rotation, whatever its params are called") {
    const TemporaryFolder folder;
    for (const std::string params : {"", "<param name=\"ROTATION\" type=\"float4\"/>",
                                     "<param type=\"float\"/><param type=\"float\"/><param type=\"float\"/>"
                                     "<param name=\"ANGLE\" type=\"float\"/>"}) {
        INFO(params);
        ColladaFile file = oneFigure();
        file.animations =
            movement(colladaChannel("k", "middle/rz", {0, 1}, {0, 0, 1, 0, 0, 0, 1, 300}, 4, params) +
                     colladaChannel("l", "middle/t", {0, 1}, {0, 0.6F, 0, 0, 0.6F, 0.5F}, 3,
                                    params.empty() ? "" : "<param name=\"TRANSLATION\" type=\"float3\"/>"));
        const Character character = read(folder, file.text());
        CHECK(turnAboutZDeg(inClip(character, "", "middle", 0.25F)) == Approx(75).margin(0.1));
        CHECK(std::abs(turnAboutZDeg(inClip(character, "", "middle", 0.5F))) == Approx(150).margin(0.1));
        CHECK(inClip(character, "", "middle", 0.5F).translation.z == Approx(0.25F).margin(1e-4));
    }
}

TEST_CASE("Collada channels of single numbers of a matrix move the matrix, rows first or columns first") {
    const TemporaryFolder folder;
    const auto place = [](int row, int column, int kind) {
        const auto index = [](int i) { return '(' + std::to_string(i) + ')'; };
        return kind == 0   ? index(row) + index(column)
               : kind == 1 ? index(column) + index(row)
                           : index(4 * row + column);
    };
    for (const int kind : {0, 1, 2}) {
        INFO(kind);
        ColladaFile file = oneFigure();
        const float c = std::cos(0.5F);
        const float s = std::sin(0.5F);
        const float turned[3][4] = {{c, -s, 0, 0.2F}, {s, c, 0, 0}, {0, 0, 1, -0.1F}};
        std::string channels;
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 4; ++column) {
                // Times of their own, so that they meet between their keys.
                channels += colladaChannel("k" + std::to_string(4 * row + column),
                                           "middle/m" + place(row, column, kind), {0, 1, column == 3 ? 3.0F : 2.0F},
                                           {row == column ? 1.0F : 0.0F, turned[row][column], turned[row][column]});
            }
        }
        file.animations = movement(channels);
        const Character character = read(folder, file.text());
        CHECK(character.warnings.empty());
        const RigidTransform frame = inClip(character, "", "middle", 1.5F);
        CHECK(turnAboutZDeg(frame) == Approx(0.5F * 57.29578F).margin(0.05));
        CHECK(glm::distance(frame.translation, vec3(0.2F, 0.6F, -0.1F)) < 1e-3F);
    }
    // One number alone: of the two that (0)(3) may be, one leaves a matrix that moves and turns.
    for (const char* number : {"(0)(3)", "(3)(0)", "(3)"}) {
        INFO(number);
        ColladaFile file = oneFigure();
        file.animations = movement(colladaChannel("k", std::string("middle/m") + number, {0, 1}, {0, 0.4F}));
        CHECK(glm::distance(inClip(read(folder, file.text()), "", "middle", 0.5F).translation, vec3(0.2F, 0.6F, 0)) <
              1e-3F);
    }
}

TEST_CASE("Collada animations nest, and several takes of them stay apart under their names") {
    const TemporaryFolder folder;
    const auto take = [](const std::string& name, float turn) {
        return movement(
            colladaChannel(name + "1", "middle/rz.ANGLE", {0, 1}, {0, turn}) +
                movement(movement(colladaChannel(name + "2", "high/rz.ANGLE", {0, 1}, {0, -turn}), name + "-y"),
                         name + "-x"),
            name);
    };
    ColladaFile file = oneFigure();
    file.animations = take("walk", 60) + take("run", 20);
    const Character character = read(folder, file.text());
    REQUIRE(character.clips.size() == 2);
    for (const char* joint : {"middle", "high"}) {
        const float sign = joint[0] == 'm' ? 1.0F : -1.0F;
        CHECK(turnAboutZDeg(inClip(character, "walk", joint, 0.5F)) == Approx(30 * sign).margin(0.1));
        CHECK(turnAboutZDeg(inClip(character, "run", joint, 0.5F)) == Approx(10 * sign).margin(0.1));
    }
}

TEST_CASE("Collada clips that share a time line are the parts of it that they state") {
    const TemporaryFolder folder;
    ColladaFile file = oneFigure();
    file.animations = movement(colladaChannel("k", "middle/t.Z", {0, 1, 3}, {0, 1, 3}));
    const auto clip = [](const std::string& name, const std::string& span) {
        return "<animation_clip name=\"" + name + "\"" + span + "><instance_animation url=\"#move\"/></animation_clip>";
    };
    file.clips = "<library_animation_clips>" + clip("walk", " start=\"0\" end=\"0.5\"") +
                 clip("run", " start=\"0.5\" end=\"2\"") + "</library_animation_clips>";
    const Character character = read(folder, file.text());
    REQUIRE(character.clips.size() == 2);
    CHECK(character.clips[0].seconds() == Approx(0.5F));
    CHECK(character.clips[1].seconds() == Approx(1.5F));
    CHECK(inClip(character, "walk", "middle", 0.5F).translation.z == Approx(0.5F).margin(1e-4));
    CHECK(inClip(character, "run", "middle", 0.0F).translation.z == Approx(0.5F).margin(1e-4));
    CHECK(inClip(character, "run", "middle", 1.5F).translation.z == Approx(2.0F).margin(1e-4));
    // A clip alone is cut, too; one that lies outside of the keys, as in frames, is not.
    file.clips = "<library_animation_clips>" + clip("late", " start=\"1\" end=\"2\"") + "</library_animation_clips>";
    CHECK(read(folder, file.text()).clips.at(0).seconds() == Approx(1.0F));
    file.clips = "<library_animation_clips>" + clip("late", " start=\"24\" end=\"48\"") + "</library_animation_clips>";
    CHECK(read(folder, file.text()).clips.at(0).seconds() == Approx(3.0F));
}

TEST_CASE("a Collada document shows its first scene where it names none that is there, and may have a prefix") {
    const TemporaryFolder folder;
    for (const char* scene : {"", "<scene/>", "<scene><instance_visual_scene url=\"#t\"/></scene>",
                              "<scene><instance_visual_scene url=\"#t\"></instance_visual_scene></scene>"}) {
        INFO(scene);
        ColladaFile file = oneFigure();
        file.scene = scene;
        const Character character = read(folder, file.text());
        CHECK(character.meshes.size() == 1);
        CHECK(character.warnings.empty());
        std::string text = file.text();
        text.insert(text.find("</library_visual_scenes>"), "<visual_scene id=\"u\"><node id=\"z\"/></visual_scene>");
        CHECK(warns(read(folder, text), "which of its scenes"));
        text.erase(text.find(" id=\"s\""), 7);
        CHECK(read(folder, text).meshes.size() == 1);
    }
    std::string text = oneFigure().text();
    for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at + 1)) {
        if (text[at + 1] != '?') text.insert(at + (text[at + 1] == '/' ? 2 : 1), "dae:");
    }
    text.replace(text.find("xmlns="), 6, "xmlns:dae=");
    CHECK(read(folder, text).meshes.size() == 1);
}

TEST_CASE("Collada skins whose sources have the ids of another's have sources of their own") {
    const TemporaryFolder folder;
    ColladaFile file = oneFigure();
    file.nodes +=
        "<node id=\"other\"><instance_controller url=\"#d\"><skeleton>#low</skeleton></instance_controller>"
        "</node>";
    std::string text = file.text();
    // The second's weights are on other joints.
    const std::size_t start = text.find("<controller id=\"c\">");
    std::string second = text.substr(start, text.find("</library_controllers>") - start);
    second[second.find("id=\"c\"") + 4] = 'd';
    second.replace(second.find("low middle high"), 15, "high middle low");
    text.insert(text.find("</library_controllers>"), second);
    const Character character = read(folder, text);
    REQUIRE(character.meshes.size() == 2);
    CHECK(topJoint(character).find("high") != std::string::npos);
}
