// BVH files made here, in the spellings that recorders use.

#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <sstream>

#include "animation/import/bvh/bvh_document.hpp"
#include "animation/import/bvh/read_bvh.hpp"
#include "animation/import/checks.hpp"
#include "animation/import/gltf_file.hpp"
#include "support/catch.hpp"
#include "support/command.hpp"

using namespace lutka;
using namespace lutka::animation;
using namespace lutka::animation::rig_import;
using namespace lutka::test;
using glm::dmat4;
using glm::dvec3;

namespace {

Result<SourceScene> readText(const std::string& text) {
    const ScratchFolder folder;
    const std::string file = folder / "motion.bvh";
    std::ofstream(file, std::ios::binary) << text;
    return readBvh(file);
}

bool warns(const SourceScene& scene, const std::string& text) {
    for (const std::string& warning : scene.warnings) {
        if (warning.find(text) != std::string::npos) return true;
    }
    return false;
}

// A figure whose offsets all point along x, as captures have it; the second frame
// turns spine, legs and arms apart.
std::string lineFigure() {
    std::ostringstream out;
    const auto limb = [&](const char* name, int length) {
        out << "JOINT " << name << "\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nEnd Site\n{\nOFFSET "
            << length << " 0 0\n}\n}\n";
    };
    out << "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation "
           "Yrotation\n";
    for (const auto& [name, length] : {std::pair{"Spine", 60}, std::pair{"LeftArm", 60}, std::pair{"RightArm", 60},
                                       std::pair{"LeftLeg", 90}, std::pair{"RightLeg", 90}})
        limb(name, length);
    out << "}\nMOTION\nFrames: 2\nFrame Time: 0.01\n";
    out << "0 90 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\n";
    out << "0 90 0 0 0 0 90 0 0 0 0 0 180 0 0 -85 0 0 -95 0 0\n";
    return out.str();
}

}  // namespace

TEST_CASE("BVH channels apply in the file's order, on any joint, with any line ends and blanks") {
    const Result<SourceScene> scene = readText(
        "HIERARCHY\r\nROOT Left Hip \r\n{\r\n\tOFFSET 1 2 3\r\n\tCHANNELS 3 Yrotation Zrotation Xrotation\r\n"
        "\tJOINT Knee\r\n\t{\r\n\t\tOFFSET 0 -4 0\r\n\t\tCHANNELS 4 Xrotation Yposition Zrotation Yrotation\r\n"
        "\t\tEnd Site\r\n\t\t{\r\n\t\t\tOFFSET 0 -5 0\r\n\t\t}\r\n\t}\r\n}\r\n"
        "MOTION\r\nFrames:\t2\r\nFrame Time:\t0.04\r\n10 20 30\t40 -6 50 60\r\n0 0 0 0 -4 0 0\r\n");
    REQUIRE(scene.ok());
    REQUIRE(scene.value().nodes.size() == 3);
    CHECK(scene.value().nodes[0].name == "Left Hip");
    CHECK(scene.value().nodes[2].name == "EndSite_Knee");
    CHECK(glm::distance(dvec3(scene.value().nodes[1].parentFromNode[3]), dvec3(0, -4, 0)) < 1e-9);
    const auto turn = [](double degrees, const dvec3& axis) {
        return glm::rotate(dmat4(1.0), glm::radians(degrees), axis);
    };
    REQUIRE(scene.value().clips.size() == 1);
    const auto& channels = scene.value().clips[0].channels;
    REQUIRE(channels.size() == 3);  // the hip turns, the knee moves and turns
    CHECK(channels[0].times[1] == Approx(0.04));
    const glm::dquat hip = glm::quat_cast(turn(10, {0, 1, 0}) * turn(20, {0, 0, 1}) * turn(30, {1, 0, 0}));
    const glm::dquat knee = glm::quat_cast(turn(40, {1, 0, 0}) * turn(50, {0, 0, 1}) * turn(60, {0, 1, 0}));
    const auto same = [](const float* q, const glm::dquat& expected) {
        return std::abs(glm::dot(glm::dquat(q[3], q[0], q[1], q[2]), expected)) > 1.0 - 1e-6;
    };
    CHECK(same(channels[0].values.data(), hip));
    CHECK(channels[1].values[1] == Approx(-6.0F));
    CHECK(same(channels[2].values.data(), knee));
}

TEST_CASE("a BVH zero pose along one axis gives way to the frame that shows the figure") {
    const Result<SourceScene> scene = readText(lineFigure());
    REQUIRE(scene.ok());
    CHECK(warns(scene.value(), "frame 1 of the motion"));
    std::vector<dmat4> at;
    for (const SourceNode& node : scene.value().nodes)
        at.push_back(node.parent < 0 ? node.parentFromNode
                                     : at[static_cast<std::size_t>(node.parent)] * node.parentFromNode);
    CHECK(glm::distance(dvec3(at[2][3]), dvec3(0, 150, 0)) < 1e-4);   // the spine's tip
    CHECK(glm::distance(dvec3(at[4][3]), dvec3(60, 90, 0)) < 1e-4);   // the left arm's
    CHECK(glm::distance(dvec3(at[6][3]), dvec3(-60, 90, 0)) < 1e-4);  // the right arm's
}

TEST_CASE("a BVH zero pose that is bent over gives way to a frame that stands, an animal's does not") {
    // Trunk and arms point ahead in the zero pose; the motion lifts the chest by as much as is said.
    const auto figure = [](double lifted) {
        std::ostringstream out;
        const auto open = [&](const char* name, const char* offset) {
            out << "JOINT " << name << "\n{\nOFFSET " << offset << "\nCHANNELS 3 Zrotation Xrotation Yrotation\n";
        };
        const auto close = [&](const char* end) { out << "End Site\n{\nOFFSET " << end << "\n}\n}\n"; };
        out << "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation "
               "Yrotation\n";
        open("Spine", "0 10 0");
        open("Neck", "45 5 0");
        close("20 0 0");
        open("LeftArm", "40 0 -18");
        open("LeftForeArm", "0 0 -28");
        close("0 0 -40");
        out << "}\n";
        open("RightArm", "40 0 18");
        open("RightForeArm", "0 0 28");
        close("0 0 40");
        out << "}\n}\n";
        for (const char* side : {"10", "-10"}) {
            open(side[0] == '-' ? "LeftUpLeg" : "RightUpLeg", (std::string("0 -5 ") + side).c_str());
            open(side[0] == '-' ? "LeftLeg" : "RightLeg", "0 -42 0");
            close("0 -42 0");
            out << "}\n";
        }
        out << "}\nMOTION\nFrames: 2\nFrame Time: 0.03\n";
        for (const double angle : {0.0, lifted}) {
            out << "0 90 0 0 0 0 " << angle;
            for (int channel = 7; channel < 36; ++channel)
                out << " 0";
            out << "\n";
        }
        return out.str();
    };
    const auto headOf = [](const SourceScene& scene) {
        return scene.nodes[0].parentFromNode * scene.nodes[1].parentFromNode * scene.nodes[2].parentFromNode[3];
    };
    const Result<SourceScene> upright = readText(figure(85.0));
    REQUIRE(upright);
    CHECK(warns(upright.value(), "bent over"));
    CHECK(warns(upright.value(), "frame 1"));
    CHECK(headOf(upright.value()).y - upright.value().nodes[0].parentFromNode[3].y > 50.0);
    const Result<SourceScene> animal = readText(figure(10.0));
    REQUIRE(animal);
    CHECK_FALSE(warns(animal.value(), "zero pose"));
}

TEST_CASE("a joint without a name gets one, so that it has a path") {
    const TemporaryFolder folder;
    std::ofstream(folder / "nameless.bvh")
        << "HIERARCHY\nROOT \n{\nOFFSET 0 0 0\nCHANNELS 3 Xposition Yposition Zposition\n"
           "JOINT up\n{\nOFFSET 0 1 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nEnd Site\n{\nOFFSET 0 1 0\n}\n}\n"
           "JOINT side\n{\nOFFSET 1 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nEnd Site\n{\nOFFSET 1 0 0\n}\n}\n}\n"
           "MOTION\nFrames: 1\nFrame Time: 0.03\n0 0 0 0 0 0 0 0 0\n";
    const Character character = imported(folder / "nameless.bvh");
    CHECK(character.skeleton.names[0] == "nodes[0]");
    CHECK(jointPath(character.skeleton, findJoint(character.skeleton, "up")) == "nodes[0]/up");
}

TEST_CASE("a BVH motion that breaks off keeps its whole frames") {
    std::string text = lineFigure();
    text.resize(text.size() - 10);
    const Result<SourceScene> scene = readText(text);
    REQUIRE(scene.ok());
    CHECK(warns(scene.value(), "2 frames, but 1 are there"));
}

TEST_CASE("a BVH whose frames take no time, or minutes, is told the rate that it gets") {
    for (const std::string stated : {"0", "-0.01", "nan", "90", "0.01"}) {
        INFO(stated);
        std::string text = lineFigure();
        text.replace(text.find("Time: 0.01") + 6, 4, stated);
        const Result<SourceScene> scene = readText(text);
        REQUIRE(scene.ok());
        const bool isOdd = stated != "0.01";
        CHECK(warns(scene.value(), "says that a frame takes") == isOdd);
        CHECK(scene.value().clips.at(0).channels.at(0).times.at(1) == Approx(isOdd ? 1.0 / 30.0 : 0.01));
    }
}

TEST_CASE("a damaged BVH hierarchy is refused with its line") {
    for (const char* text : {"HIERARCHY\nROOT a\n{\nOFFSET 0 0\n}", "HIERARCHY\nROOT a\n{\nCHANNELS 99 Xposition\n}",
                             "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\n", "HIERARCHY\n"}) {
        const Result<SourceScene> scene = readText(text);
        REQUIRE_FALSE(scene.ok());
        CHECK(scene.error().code == ErrorCode::input);
    }
}

TEST_CASE("BVH joints nested beyond all measure are refused with the limit") {
    std::string text = "HIERARCHY\nROOT a\n{\n";
    for (int i = 0; i < 6000; ++i)
        text += "JOINT a\n{\n";
    const Result<SourceScene> scene = readText(text);
    REQUIRE_FALSE(scene.ok());
    CHECK(scene.error().message.find("deeper than 4096") != std::string::npos);
}

TEST_CASE("a figure of the CMU captures is no giant because it stands astride") {
    const ScratchFolder folder;
    std::ofstream(folder / "astride.bvh")
        << "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n"
           "JOINT Spine\n{\nOFFSET 0 2 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nEnd Site\n{\nOFFSET 0 7.2 "
           "0\n}\n}\n"
           "JOINT LeftLeg\n{\nOFFSET 2 -2 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nEnd Site\n{\nOFFSET 5 -13 "
           "0\n}\n}\n"
           "JOINT RightLeg\n{\nOFFSET -2 -2 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nEnd Site\n{\nOFFSET -5 -13 "
           "0\n}\n}\n"
           "}\nMOTION\nFrames: 1\nFrame Time: 0.01\n0 0 0 0 0 0 0 0 0 0 0 0\n";
    const Character character = imported(folder / "astride.bvh");
    CHECK(character.units.metresPerFileUnit == Approx(0.0254F / 0.45F));
}

TEST_CASE("what a BVH's motion says of itself and what is there are told where they differ") {
    const std::string joints =
        "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 3 Xposition Yposition Zposition\nJOINT b\n{\nOFFSET 0 1 0\n"
        "CHANNELS 3 Zrotation Xrotation Yrotation\n}\n}\nMOTION\n";
    const auto read = [&](const std::string& motion) {
        Result<SourceScene> scene = readText(joints + motion);
        REQUIRE(scene.ok());
        return std::move(scene).value();
    };
    const auto keys = [](const SourceScene& scene) {
        return scene.clips.empty() ? 0 : scene.clips[0].channels[0].times.size();
    };
    const std::string frame = "1 2 3 10 20 30\n";
    const std::string time = "Frame Time: 0.05\n";
    CHECK(read("Frames: 2\n" + time + frame + frame).warnings.empty());
    const SourceScene more = read("Frames: 1\n" + time + frame + frame);
    CHECK(keys(more) == 2);
    CHECK(warns(more, "1 frames, but 2 are there"));
    const SourceScene none = read("Frames: 0\n" + time);
    CHECK(none.clips.empty());
    CHECK(none.warnings.empty());
    CHECK(warns(read("Frames: 0\n" + time + frame), "0 frames, but 1 are there"));
    CHECK(read(time + frame).warnings.empty());
    CHECK(warns(read(time + frame + "7 8"), "2 numbers beyond its 1 frames"));
    const SourceScene timeless = read("Frames: 2\n" + frame + frame);
    CHECK(keys(timeless) == 2);
    CHECK(warns(timeless, "how long a frame takes: took 1/30 s"));
    // Decimal commas, and numbers that are none.
    const SourceScene commas = read("Frames: 2\nFrame Time: 0,05\n1,5 2 3 10 20 30\n2,5 2 3 10 20 30\n");
    CHECK(commas.warnings.empty());
    CHECK(commas.clips[0].channels[0].values[3] == Approx(2.5F));
    CHECK(commas.clips[0].channels[0].times[1] == Approx(0.05));
    for (const char* broken : {"nan", "-NaN(ind)", "inf", "1.#QNAN", "-1.#IND00"}) {
        const SourceScene scene = read("Frames: 2\n" + time + frame + broken + " 2 3 10 20 30\n");
        CHECK(warns(scene, "1 of the motion's numbers are none"));
        CHECK(scene.clips[0].channels[0].values[3] == Approx(1.0F));
    }
    const SourceScene torn = read("Frames: 3\n" + time + frame + frame + "1 2 x3 4 5 6\n");
    CHECK(keys(torn) == 2);
    CHECK(warns(torn, "up to line 17, where 'x3' is no number"));
}
