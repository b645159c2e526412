#include "animation/humanoid/name_evidence.hpp"

#include "animation/humanoid/name_tokens.hpp"
#include "support/catch.hpp"

namespace lutka::test {
namespace {

using animation::nameEvidence;
using animation::Part;
using animation::Side;

struct Reading {
    const char* name;
    Side side;
    Part part;
};

// The part that a name speaks for most.
Part bestPart(const char* name) {
    const animation::NameEvidence evidence = nameEvidence(name);
    int best = 0;
    for (int part = 1; part < animation::kPartCount; ++part) {
        if (evidence.parts.values[part] > evidence.parts.values[best]) best = part;
    }
    return static_cast<Part>(best);
}

}  // namespace

TEST_CASE("names of every spelling give side and part", "[names]") {
    const Reading readings[] = {
        {"mixamorig:LeftForeArm", Side::left, Part::lowerArm},
        {"Armature|mixamorig1:RightUpLeg", Side::right, Part::upperLeg},
        {"Bip01 L Thigh", Side::left, Part::upperLeg},
        {"DEF-upper_arm.R.001_038", Side::right, Part::upperArm},
        {"Luparm", Side::left, Part::upperArm},
        {"main gauche", Side::left, Part::hand},
        {"L Inner Arm", Side::left, Part::upperArm},
        {"R Outer Arm", Side::right, Part::lowerArm},
        {"lThighBend", Side::left, Part::upperLeg},
        {"rShldrBend", Side::right, Part::upperArm},
        {"CC_Base_L_Calf", Side::left, Part::lowerLeg},
        {"J_Bip_R_ToeBase", Side::right, Part::toes},
        {"mElbowLeft", Side::left, Part::lowerArm},
        {"HANDL", Side::left, Part::hand},
        {"Lefthand", Side::left, Part::hand},
        {"lowerarm01.L", Side::left, Part::lowerArm},
        {"左ひじ", Side::left, Part::lowerArm},
        {"右足首", Side::right, Part::foot},
        {"下半身", Side::center, Part::hips},
        {"頭", Side::center, Part::head},
        {"Fuß_links", Side::left, Part::foot},
        {"mano_der", Side::right, Part::hand},
        {"L3", Side::center, Part::trunk},
        {"LowerTorso", Side::center, Part::hips},
        {"L_Ueude", Side::left, Part::upperArm},
        {"R_Sitaude", Side::right, Part::lowerArm},
        {"R_momo", Side::right, Part::upperLeg},
        {"L_Sune", Side::left, Part::lowerLeg},
        {"Kosi", Side::center, Part::hips},
        {"Armature_SolUstBacak", Side::left, Part::upperLeg},
        {"SagAltKol", Side::right, Part::lowerArm},
        {"Kafa", Side::center, Part::head},
        {"CC_Base_NeckTwist01", Side::center, Part::neck},
        {"Bip01FBXASC032LFBXASC032Thigh", Side::left, Part::upperLeg},
        {"rigFBXASC058RightFBXASC046Hand", Side::right, Part::hand},
    };
    for (const Reading& reading : readings) {
        INFO(reading.name);
        CHECK(nameEvidence(reading.name).side == reading.side);
        CHECK(bestPart(reading.name) == reading.part);
        CHECK(nameEvidence(reading.name).parts[reading.part] > 0.0F);
    }
}

TEST_CASE("helpers, fingers, faces and props speak for no part", "[names]") {
    for (const char* name :
         {"upperarm_twist_01_l", "LeftFootIK", "kneePoleTarget.L", "ik_hand_gun", "Bip01 HeadNub", "LeftHandThumb1",
          "L_Eye", "HeadTop_End", "handslot.r", "LeftCollar_Att", "MCH-spine.001", "hair_01", "Tail1", "左足ＩＫ",
          "左腕捩", "Hips_$AssimpFbx$_Rotation", "FrontLeg.R", "breast.L", "wield"}) {
        INFO(name);
        for (const float score : nameEvidence(name).parts.values)
            CHECK(score <= 0.0F);
    }
}

TEST_CASE("wings, feelers and tentacles are an animal's", "[names]") {
    for (const char* name : {"wing.l", "L_antenna_jnt", "feeler_R", "Tentacles.003", "FrontLeg.R", "Tail1"}) {
        INFO(name);
        CHECK(nameEvidence(name).creature);
    }
    for (const char* name : {"hair_tail_L", "forearm.l", "ponytail"}) {
        INFO(name);
        CHECK_FALSE(nameEvidence(name).creature);
    }
}

TEST_CASE("names without meaning say nothing", "[names]") {
    for (const char* name : {"joint_17", "nodes[3]", "Bone.012", "", "x", "Object_5", "\xFF\xC3"}) {
        const animation::NameEvidence evidence = nameEvidence(name);
        INFO(name);
        CHECK_FALSE(evidence.meaningful);
        CHECK(evidence.side == Side::center);
        for (const float score : evidence.parts.values)
            CHECK(score == 0.0F);
    }
}

TEST_CASE("words whose meaning differs between rigs speak for all of them", "[names]") {
    const auto shoulder = nameEvidence("L_Shoulder").parts;
    CHECK(shoulder[Part::clavicle] > 1.0F);
    CHECK(shoulder[Part::upperArm] > 1.0F);
    const auto leg = nameEvidence("LeftLeg").parts;
    CHECK(leg[Part::upperLeg] > 1.0F);
    CHECK(leg[Part::lowerLeg] > 1.0F);
    CHECK(nameEvidence("hip").parts[Part::hips] > 3.0F);
    CHECK(nameEvidence("L_Hip").parts[Part::upperLeg] > 1.0F);
}

}  // namespace lutka::test
