#include "animation/segments/segment_rig.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::animation;

namespace {

int segmentNamed(const SegmentedRig& rig, const std::string& name) {
    for (std::size_t i = 0; i < rig.segments.size(); ++i) {
        if (rig.segments[i].name == name) return static_cast<int>(i);
    }
    return -1;
}

// A clip in which joints turn about their axes by an angle that goes through a whole swing.
struct Swing {
    std::string joint;
    vec3 axis;
    float angle;
};
void addClip(Character& character, const std::vector<Swing>& swings) {
    constexpr int kFrames = 24;
    Clip clip;
    clip.name = "swing";
    clip.frameCount = kFrames;
    for (int frame = 0; frame < kFrames; ++frame) {
        std::vector<RigidTransform> pose = character.skeleton.nodeParentFromJoint;
        const float phase = std::sin(2.0F * kPi * static_cast<float>(frame) / kFrames);
        for (const Swing& swing : swings) {
            const int joint = findJoint(character.skeleton, swing.joint);
            REQUIRE(joint != kNoJoint);
            pose[joint].rotation = pose[joint].rotation * glm::angleAxis(swing.angle * phase, swing.axis);
        }
        clip.parentFromJoint.append(pose);
    }
    character.clips.push_back(clip);
}

}  // namespace

TEST_CASE("a four-legged creature is parted into trunk, neck, head, tail and legs") {
    const SegmentedRig rig = segmentRig(test::makeQuadruped());
    for (const char* name : {"pelvis", "back", "ribs", "neck1", "skull", "jaw", "tail2", "tail4", "thigh_fore_l",
                             "shin_fore_l", "paw_fore_l", "thigh_hind_r", "shin_hind_r", "paw_hind_r"}) {
        INFO(name);
        CHECK(segmentNamed(rig, name) >= 0);
    }
    for (const char* name : {"root", "eye_l", "eye_r", "twist_fore_l", "twist_hind_r"}) {
        INFO(name);
        CHECK(segmentNamed(rig, name) < 0);
    }
    CHECK(rig.segments[0].name == "pelvis");
    CHECK(rig.segments[0].parent == -1);
    CHECK(rig.segments[segmentNamed(rig, "thigh_fore_r")].parent == segmentNamed(rig, "ribs"));
    CHECK(rig.standardFromModel == quat(1, 0, 0, 0));
}

TEST_CASE("a control without skin between the file's root with IK feet and the trunk has no body") {
    std::vector<test::JointSpec> joints{{"armature", -1, {0, 0, 0}},     {"body", 0, {0, 0.1F, 0}},
                                        {"pelvis", 1, {0, 0.6F, -0.4F}}, {"ribs", 2, {0, 0.6F, 0.1F}},
                                        {"skull", 3, {0, 0.8F, 0.5F}},   {"pole", 1, {0, 0.3F, 1}}};
    std::vector<test::TubeSpec> tubes{
        {2, {0, 0.6F, 0.1F}, 0.12F}, {3, {0, 0.8F, 0.5F}, 0.12F}, {4, {0, 0.8F, 0.8F}, 0.1F}};
    for (const float side : {1.0F, -1.0F}) {
        for (const int above : {2, 3}) {
            const std::string end = (above == 2 ? "_hind" : "_fore") + std::string(side > 0.0F ? "_l" : "_r");
            const vec3 top = joints[above].position + vec3(0.1F * side, -0.05F, 0);
            const vec3 foot(top.x, 0.05F, top.z);
            joints.push_back({"thigh" + end, above, top});
            tubes.push_back({static_cast<int>(joints.size()) - 1, foot, 0.05F});
            joints.push_back({"foot" + end, 0, foot});
            tubes.push_back({static_cast<int>(joints.size()) - 1, foot + vec3(0, 0, 0.15F), 0.04F});
        }
    }
    const SegmentedRig rig = segmentRig(test::makeFigure("beast", joints, tubes));
    CHECK(segmentNamed(rig, "armature") < 0);
    CHECK(segmentNamed(rig, "body") < 0);
    CHECK(rig.segments[0].name == "pelvis");
}

TEST_CASE("legs are pairs, what lies in the mirror plane is its own counterpart, and the left one comes first") {
    const SegmentedRig rig = segmentRig(test::makeQuadruped());
    for (const char* limb : {"thigh_fore", "shin_fore", "paw_fore", "thigh_hind", "shin_hind", "paw_hind"}) {
        INFO(limb);
        const int left = segmentNamed(rig, std::string(limb) + "_l");
        const int right = segmentNamed(rig, std::string(limb) + "_r");
        REQUIRE(left >= 0);
        REQUIRE(right >= 0);
        CHECK(left < right);
        CHECK(rig.segments[left].mirror == right);
        CHECK(rig.segments[right].mirror == left);
        CHECK(rig.segments[left].side == Side::left);
        CHECK(rig.segments[right].side == Side::right);
    }
    for (const char* name : {"pelvis", "ribs", "skull", "tail2"}) {
        const int own = segmentNamed(rig, name);
        CHECK(rig.segments[own].mirror == own);
        CHECK(rig.segments[own].side == Side::center);
    }
    CHECK(rig.segments[segmentNamed(rig, "pelvis")].kind == Segment::Kind::trunk);
    CHECK(rig.segments[segmentNamed(rig, "back")].kind == Segment::Kind::trunk);
    CHECK(rig.segments[segmentNamed(rig, "tail2")].kind == Segment::Kind::chain);
    CHECK(rig.segments[segmentNamed(rig, "thigh_hind_l")].kind == Segment::Kind::limbRoot);
    CHECK(rig.segments[segmentNamed(rig, "shin_hind_l")].kind == Segment::Kind::limb);
}

TEST_CASE("a creature that faces another way is told by its head and tail") {
    Character turned = test::makeQuadruped();
    const quat turn = glm::angleAxis(radians(90.0F), vec3(0, 1, 0));
    for (RigidTransform& joint : turned.skeleton.bindModelFromJoint)
        joint = {turn, turn * joint.translation};
    for (vec3& position : turned.meshes[0].positions)
        position = turn * position;
    const SegmentedRig rig = segmentRig(turned);
    CHECK(glm::distance(rig.standardFromModel * (turn * vec3(0, 0, 1)), vec3(0, 0, 1)) < 0.02F);
    CHECK(rig.segments[segmentNamed(rig, "paw_fore_l")].side == Side::left);
}

TEST_CASE("twist joints in a row between two joints of a limb belong to the limb, and links of a tail do not") {
    // As rigs of Advanced Skeleton are exported.
    std::vector<test::JointSpec> joints{
        {"Shoulder_L", -1, {0, 1, 0}},      {"ShoulderPart1_L", 0, {0, 1, 0.2F}}, {"Elbow_L", 1, {0, 1, 0.4F}},
        {"ElbowPart1_L", 2, {0, 1, 0.5F}},  {"ElbowPart2_L", 3, {0, 1, 0.6F}},    {"Wrist_L", 4, {0, 1, 0.7F}},
        {"TailPart1", 0, {0, 0.9F, -0.2F}}, {"TailPart2", 6, {0, 0.7F, -0.3F}},   {"TailPart3", 7, {0, 0.7F, -0.6F}}};
    std::vector<test::TubeSpec> tubes;
    for (int i = 0; i < static_cast<int>(joints.size()); ++i)
        tubes.push_back({i, joints[i].position + vec3(0, 0, i < 6 ? 0.1F : -0.2F), 0.05F});
    const SegmentedRig rig = segmentRig(test::makeFigure("limb", joints, tubes));
    for (const char* name : {"Shoulder_L", "Elbow_L", "Wrist_L", "TailPart2", "TailPart3"}) {
        INFO(name);
        CHECK(segmentNamed(rig, name) >= 0);
    }
    for (const char* name : {"ShoulderPart1_L", "ElbowPart1_L", "ElbowPart2_L"}) {
        INFO(name);
        CHECK(segmentNamed(rig, name) < 0);
    }
}

TEST_CASE("joints too short for a body are merged, and a finer rig keeps to the number asked for") {
    std::vector<test::JointSpec> joints{{"link 0", -1, {0, 1, 0}}};
    std::vector<test::TubeSpec> tubes{{0, {0, 1, 0.01F}, 0.02F}};
    for (int i = 1; i < 200; ++i) {
        const float z = 0.01F * static_cast<float>(i);
        joints.push_back({"link " + std::to_string(i), i - 1, {0, 1, z}});
        tubes.push_back({i, {0, 1, z + 0.01F}, 0.02F});
    }
    const Character snake = test::makeFigure("snake", joints, tubes);
    const auto lengthsOf = [&](int most) {
        const SegmentedRig rig = segmentRig(snake, {most});
        CHECK(static_cast<int>(rig.segments.size()) <= most);
        float shortest = 10.0F;
        for (const Segment& segment : rig.segments) {
            if (segment.end == kNoJoint) continue;
            const auto& bind = snake.skeleton.bindModelFromJoint;
            shortest =
                std::min(shortest, glm::distance(bind[segment.joint].translation, bind[segment.end].translation));
        }
        return shortest;
    };
    CHECK(lengthsOf(40) > 0.07F);
    CHECK(lengthsOf(6) > 0.25F);
    CHECK(segmentRig(snake, {1}).segments.size() == 1);
}

TEST_CASE("a joint that bends in one plane in all clips is a hinge, one that swings about is none") {
    Character creature = test::makeQuadruped();
    const vec3 x(1, 0, 0);
    const vec3 z(0, 0, 1);
    addClip(creature, {{"shin_fore_l", x, 0.6F},
                       {"shin_fore_r", x, 0.5F},
                       {"thigh_fore_l", x, 0.5F},
                       {"thigh_fore_r", x, 0.5F},
                       {"shin_hind_l", x, 0.6F}});
    addClip(creature, {{"thigh_fore_l", z, 0.4F}, {"thigh_fore_r", z, 0.4F}, {"tail2", x, 0.05F}});
    const SegmentedRig rig = segmentRig(creature);
    for (const char* name : {"shin_fore_l", "shin_fore_r"}) {
        const Segment& shin = rig.segments[segmentNamed(rig, name)];
        REQUIRE(shin.hinge.has_value());
        CHECK(std::abs(glm::dot(shin.hinge->axis, x)) > 0.999F);
        CHECK(shin.hinge->low < -0.45F);
        CHECK(shin.hinge->high > 0.45F);
    }
    CHECK_FALSE(rig.segments[segmentNamed(rig, "thigh_fore_l")].hinge.has_value());  // two planes
    CHECK_FALSE(rig.segments[segmentNamed(rig, "tail2")].hinge.has_value());         // hardly moves
    CHECK_FALSE(rig.segments[segmentNamed(rig, "shin_hind_l")].hinge.has_value());   // its counterpart does not
}

TEST_CASE("rigs of little are parted, too") {
    CHECK(segmentRig(Character{}).segments.empty());
    const Character one = test::makeFigure("one", {{"only", -1, {0, 1, 0}}}, {{0, {0, 2, 0}, 0.1F}});
    REQUIRE(segmentRig(one).segments.size() == 1);
    const Character bare =
        test::makeFigure("bare", {{"a", -1, {0, 0, 0}}, {"b", 0, {0, 1, 0}}, {"c", 1, {0, 2, 0}}}, {});
    const SegmentedRig rig = segmentRig(bare);
    REQUIRE(rig.segments.size() == 2);
    CHECK(rig.segments[1].name == "b");
    CHECK(rig.segments[1].end == 2);
    // Trees side by side become one ragdoll.
    const Character trees = test::makeFigure(
        "trees", {{"a", -1, {0, 0, 0}}, {"a2", 0, {0, 1, 0}}, {"b", -1, {2, 0, 0}}, {"b2", 2, {2, 1, 0}}},
        {{0, {0, 1, 0}, 0.1F}, {1, {0, 2, 0}, 0.1F}, {2, {2, 1, 0}, 0.1F}, {3, {2, 2, 0}, 0.1F}});
    CHECK(segmentRig(trees).segments.size() == 4);
}

TEST_CASE("limbs with a man's names that move no skin make no bodies of a creature's root") {
    // A bear whose paws' skin hangs on trunk and hips; its root stands behind it.
    std::vector<test::JointSpec> joints{
        {"Root", -1, {0, 0.2F, -1.4F}}, {"Waist", 0, {0, 1.1F, 0}}, {"Neck", 1, {0, 1.3F, 1.1F}}};
    std::vector<test::TubeSpec> skin{{1, {0, 1.2F, 1}, 0.5F}, {2, {0, 1.3F, 1.9F}, 0.3F}};
    for (const float side : {1.0F, -1.0F}) {
        const std::string start = side > 0.0F ? "Left" : "Right";
        const auto add = [&](const std::string& name, int parent, const vec3& place) {
            joints.push_back({start + name, parent, place * vec3(side, 1, 1)});
            return static_cast<int>(joints.size()) - 1;
        };
        add("Elbow", add("Shoulder", 1, {0.3F, 0.9F, 0.5F}), {0.3F, 0.5F, 0.5F});
        const int hip = add("Hip", 0, {0.25F, 1.2F, -0.8F});
        add("Ankle", add("Knee", hip, {0.25F, 0.6F, -0.7F}), {0.25F, 0.1F, -0.6F});
        skin.push_back({hip, {side * 0.25F, 0, -0.7F}, 0.2F});
    }
    const SegmentedRig rig = segmentRig(test::makeFigure("bear", joints, skin));
    for (const char* name : {"Waist", "Neck", "LeftHip", "RightHip"}) {
        INFO(name);
        CHECK(segmentNamed(rig, name) >= 0);
    }
    for (const char* name : {"Root", "LeftShoulder", "RightElbow", "LeftAnkle"}) {
        INFO(name);
        CHECK(segmentNamed(rig, name) < 0);
    }
}

TEST_CASE("joints of one name become bodies of different names") {
    const Character twins =
        test::makeFigure("twins", {{"Bone", -1, {0, 0, 0}}, {"Bone", 0, {0, 1, 0}}, {"head", 1, {0, 2, 0}}},
                         {{0, {0, 1, 0}, 0.1F}, {1, {0, 2, 0}, 0.1F}, {2, {0, 3, 0}, 0.1F}});
    const SegmentedRig rig = segmentRig(twins);
    REQUIRE(rig.segments.size() == 3);
    CHECK(rig.segments[0].name != rig.segments[1].name);
    // A role's name is kept for bodies that have the role.
    CHECK(rig.segments[2].name == "head 2");
}

TEST_CASE("a figure of rigid parts starts at the part that all others hang on, not at the scene's root") {
    const std::vector<test::JointSpec> joints{{"RootNode", -1, {0, 0, 0}},
                                              {"body", 0, {0.8F, 0.5F, 0}},
                                              {"neck", 1, {0.8F, 0.5F, 0.2F}},
                                              {"tail", 1, {0.8F, 0.5F, -0.2F}}};
    Character creature;
    creature.skeleton = test::makeSkeleton(joints);
    for (std::size_t joint = 1; joint < joints.size(); ++joint) {
        SkinnedMesh part;
        part.rigid = true;
        const vec3 at = joints[joint].position;
        part.positions = {at, at + vec3(0.05F, 0.1F, 0), at + vec3(0, 0, joint == 3 ? -0.2F : 0.2F)};
        part.joints.assign(3, {static_cast<std::uint16_t>(joint), 0, 0, 0});
        part.weights.assign(3, {1.0F, 0.0F, 0.0F, 0.0F});
        part.indices = {0, 1, 2};
        creature.meshes.push_back(part);
    }
    const SegmentedRig rig = segmentRig(creature);
    REQUIRE(rig.segments.size() == 3);
    CHECK(rig.segments[0].name == "body");
    CHECK(segmentNamed(rig, "RootNode") < 0);
}

TEST_CASE("hips with a joint for each leg in the middle are a pair, and the legs on them another") {
    std::vector<test::JointSpec> joints{{"body", -1, {0, 1, 0}}};
    std::vector<test::TubeSpec> tubes{{0, {0, 1.5F, 0}, 0.3F}};
    for (const float side : {1.0F, -1.0F}) {
        const std::string end = side > 0.0F ? ".L" : ".R";
        const auto add = [&](const std::string& name, int parent, const vec3& place, const vec3& tip) {
            joints.push_back({name + end, parent, vec3(side, 1, 1) * place});
            tubes.push_back({static_cast<int>(joints.size()) - 1, vec3(side, 1, 1) * tip, 0.08F});
            return static_cast<int>(joints.size()) - 1;
        };
        const int hip = add("Pelvic", 0, {0, 0.9F, 0}, {0.25F, 0.9F, 0});
        const int thigh = add("Thigh", hip, {0.3F, 0.9F, 0}, {0.3F, 0.5F, 0.1F});
        add("Shin", thigh, {0.3F, 0.45F, 0.1F}, {0.3F, 0, 0});
    }
    const SegmentedRig rig = segmentRig(test::makeFigure("walker", joints, tubes));
    for (const char* limb : {"Pelvic", "Thigh", "Shin"}) {
        INFO(limb);
        const int left = segmentNamed(rig, std::string(limb) + ".L");
        const int right = segmentNamed(rig, std::string(limb) + ".R");
        REQUIRE(left >= 0);
        REQUIRE(right >= 0);
        CHECK(rig.segments[left].mirror == right);
        CHECK(rig.segments[left].side == Side::left);
    }
    CHECK(rig.segments[segmentNamed(rig, "Thigh.L")].kind == Segment::Kind::limb);
}

TEST_CASE("a creature among thousands of parts is parted as it is alone", "[crowds]") {
    const Character alone = test::makeQuadruped();
    Character scene = alone;
    test::addParts(scene, 5000, "part_");
    const SegmentedRig expected = segmentRig(alone);
    const SegmentedRig rig = segmentRig(scene);
    REQUIRE(rig.segments.size() == expected.segments.size());
    for (std::size_t i = 0; i < rig.segments.size(); ++i) {
        CHECK(rig.segments[i].name == expected.segments[i].name);
        CHECK(rig.segments[i].joint == expected.segments[i].joint);
        CHECK(rig.segments[i].end == expected.segments[i].end);
    }
}

TEST_CASE("a crowd alone is still a thing with a body", "[crowds]") {
    Character scene;
    test::addParts(scene, 600, "part_");
    CHECK_FALSE(segmentRig(scene).segments.empty());
}
