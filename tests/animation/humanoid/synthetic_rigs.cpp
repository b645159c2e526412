#include "synthetic_rigs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <sstream>

#include "core/assert.hpp"
#include "core/random.hpp"

namespace lutka::test {
namespace {

using animation::Role;

// One convention a text: a line a joint, "name parent place role". '@' in a name stands for the side (such lines make
// two joints), '~' for a blank. A place in brackets carries no skin. Role '-' is none, '+' a joint of the spine, '*'
// the chest.
struct Convention {
    const char* name;
    const char* left;
    const char* right;
    const char* joints;
};

constexpr Convention kConventions[] = {
    {"unreal", "l", "r", R"(root - (floor) -
pelvis root hips hips
spine_01 pelvis spine +
spine_02 spine_01 chest +
spine_03 spine_02 upperChest *
neck_01 spine_03 neck neck
head neck_01 head head
clavicle_@ spine_03 clavicle Shoulder
upperarm_@ clavicle_@ upperArm UpperArm
upperarm_twist_01_@ upperarm_@ upperArmTwist -
lowerarm_@ upperarm_@ elbow LowerArm
lowerarm_twist_01_@ lowerarm_@ forearmTwist -
hand_@ lowerarm_@ hand Hand
index_01_@ hand_@ finger1 -
index_02_@ index_01_@ finger2 -
thumb_01_@ hand_@ thumb1 -
thigh_@ pelvis thigh UpperLeg
thigh_twist_01_@ thigh_@ thighTwist -
calf_@ thigh_@ knee LowerLeg
calf_twist_01_@ calf_@ calfTwist -
foot_@ calf_@ ankle Foot
ball_@ foot_@ toes Toes
ik_foot_root root (floor) -
ik_foot_@ ik_foot_root (ankle) -
ik_hand_root root (floor) -
ik_hand_gun ik_hand_root (hand) -
ik_hand_@ ik_hand_gun (hand) -)"},
    {"vroid", "L", "R", R"(Root - (floor) -
J_Bip_C_Hips Root hips hips
J_Bip_C_Spine J_Bip_C_Hips spine +
J_Bip_C_Chest J_Bip_C_Spine chest +
J_Bip_C_UpperChest J_Bip_C_Chest upperChest *
J_Bip_C_Neck J_Bip_C_UpperChest neck neck
J_Bip_C_Head J_Bip_C_Neck head head
J_Adj_@_FaceEye J_Bip_C_Head eye -
J_Sec_Hair1_01 J_Bip_C_Head hair1 -
J_Sec_Hair2_01 J_Sec_Hair1_01 hair2 -
J_Sec_@_Bust1 J_Bip_C_UpperChest bust -
J_Bip_@_Shoulder J_Bip_C_UpperChest clavicle Shoulder
J_Bip_@_UpperArm J_Bip_@_Shoulder upperArm UpperArm
J_Bip_@_LowerArm J_Bip_@_UpperArm elbow LowerArm
J_Bip_@_Hand J_Bip_@_LowerArm hand Hand
J_Bip_@_Index1 J_Bip_@_Hand finger1 -
J_Bip_@_Index2 J_Bip_@_Index1 finger2 -
J_Bip_@_Thumb1 J_Bip_@_Hand thumb1 -
J_Bip_@_UpperLeg J_Bip_C_Hips thigh UpperLeg
J_Bip_@_LowerLeg J_Bip_@_UpperLeg knee LowerLeg
J_Bip_@_Foot J_Bip_@_LowerLeg ankle Foot
J_Bip_@_ToeBase J_Bip_@_Foot toes Toes
J_Sec_@_SkirtFront0 J_Bip_@_UpperLeg skirt1 -
J_Sec_@_SkirtFront1 J_Sec_@_SkirtFront0 skirt2 -)"},
    {"daz genesis 8", "l", "r", R"(Genesis8Male - (floor) -
hip Genesis8Male hips hips
pelvis hip (hips) -
abdomenLower hip waist +
abdomenUpper abdomenLower spine +
chestLower abdomenUpper chest +
chestUpper chestLower upperChest *
neckLower chestUpper neck neck
neckUpper neckLower neck2 -
head neckUpper head head
@Eye head eye -
lowerJaw head jaw -
@Collar chestUpper clavicle Shoulder
@ShldrBend @Collar upperArm UpperArm
@ShldrTwist @ShldrBend upperArmTwist -
@ForearmBend @ShldrTwist elbow LowerArm
@ForearmTwist @ForearmBend forearmTwist -
@Hand @ForearmTwist hand Hand
@Thumb1 @Hand thumb1 -
@Carpal1 @Hand palm -
@Index1 @Carpal1 finger1 -
@ThighBend pelvis thigh UpperLeg
@ThighTwist @ThighBend thighTwist -
@Shin @ThighTwist knee LowerLeg
@Foot @Shin ankle Foot
@Metatarsals @Foot toes0 -
@Toe @Metatarsals toes Toes
@Pectoral chestLower bust -)"},
    {"daz genesis 9", "l", "r", R"(Genesis9 - (floor) -
hip Genesis9 hips hips
pelvis hip (hips) -
spine1 hip waist +
spine2 spine1 spine +
spine3 spine2 chest +
spine4 spine3 upperChest *
neck1 spine4 neck neck
neck2 neck1 neck2 -
head neck2 head head
@_shoulder spine4 clavicle Shoulder
@_upperarm @_shoulder upperArm UpperArm
@_upperarmtwist1 @_upperarm upperArmTwist -
@_forearm @_upperarm elbow LowerArm
@_forearmtwist1 @_forearm forearmTwist -
@_hand @_forearm hand Hand
@_thumb1 @_hand thumb1 -
@_index1 @_hand finger1 -
@_thigh pelvis thigh UpperLeg
@_thightwist1 @_thigh thighTwist -
@_shin @_thigh knee LowerLeg
@_foot @_shin ankle Foot
@_toes @_foot toes Toes)"},
    {"character creator", "L", "R", R"(CC_Base_BoneRoot - (floor) -
CC_Base_Hip CC_Base_BoneRoot hips hips
CC_Base_Pelvis CC_Base_Hip hips -
CC_Base_Waist CC_Base_Hip waist +
CC_Base_Spine01 CC_Base_Waist spine +
CC_Base_Spine02 CC_Base_Spine01 chest *
CC_Base_NeckTwist01 CC_Base_Spine02 neck neck
CC_Base_NeckTwist02 CC_Base_NeckTwist01 neck2 -
CC_Base_Head CC_Base_NeckTwist02 head head
CC_Base_FacialBone CC_Base_Head (head) -
CC_Base_@_Eye CC_Base_FacialBone eye -
CC_Base_@_RibsTwist CC_Base_Spine02 bust -
CC_Base_@_Clavicle CC_Base_Spine02 clavicle Shoulder
CC_Base_@_Upperarm CC_Base_@_Clavicle upperArm UpperArm
CC_Base_@_UpperarmTwist01 CC_Base_@_Upperarm upperArmTwist -
CC_Base_@_Forearm CC_Base_@_Upperarm elbow LowerArm
CC_Base_@_ElbowShareBone CC_Base_@_Forearm elbow -
CC_Base_@_ForearmTwist01 CC_Base_@_Forearm forearmTwist -
CC_Base_@_Hand CC_Base_@_Forearm hand Hand
CC_Base_@_Thumb1 CC_Base_@_Hand thumb1 -
CC_Base_@_Index1 CC_Base_@_Hand finger1 -
CC_Base_@_Thigh CC_Base_Pelvis thigh UpperLeg
CC_Base_@_ThighTwist01 CC_Base_@_Thigh thighTwist -
CC_Base_@_Calf CC_Base_@_Thigh knee LowerLeg
CC_Base_@_KneeShareBone CC_Base_@_Calf knee -
CC_Base_@_CalfTwist01 CC_Base_@_Calf calfTwist -
CC_Base_@_Foot CC_Base_@_Calf ankle Foot
CC_Base_@_ToeBaseShareBone CC_Base_@_Foot toes -
CC_Base_@_ToeBase CC_Base_@_Foot toes Toes)"},
    {"mmd", "左", "右", R"(全ての親 - (floor) -
センター 全ての親 (waist) -
グルーブ センター (waist) -
下半身 グルーブ hips hips
上半身 グルーブ spine +
上半身2 上半身 chest *
首 上半身2 neck neck
頭 首 head head
@目 頭 eye -
前髪1 頭 hair1 -
@肩 上半身2 clavicle Shoulder
@腕 @肩 upperArm UpperArm
@腕捩 @腕 upperArmTwist -
@ひじ @腕捩 elbow LowerArm
@手捩 @ひじ forearmTwist -
@手首 @手捩 hand Hand
@親指１ @手首 thumb1 -
@人指１ @手首 finger1 -
@足 下半身 thigh UpperLeg
@ひざ @足 knee LowerLeg
@足首 @ひざ ankle Foot
@つま先 @足首 toes Toes
@足ＩＫ 全ての親 (ankle) -
@つま先ＩＫ @足ＩＫ (toes) -)"},
    {"auto-rig pro", "l", "r", R"(root_ref - (floor) -
root.x root_ref hips hips
spine_01.x root.x spine +
spine_02.x spine_01.x chest *
neck.x spine_02.x neck neck
head.x neck.x head head
jawbone.x head.x jaw -
shoulder.@ spine_02.x clavicle Shoulder
arm_stretch.@ shoulder.@ upperArm UpperArm
arm_twist.@ arm_stretch.@ upperArmTwist -
forearm_stretch.@ arm_stretch.@ elbow LowerArm
forearm_twist.@ forearm_stretch.@ forearmTwist -
hand.@ forearm_stretch.@ hand Hand
index1.@ hand.@ finger1 -
thumb1.@ hand.@ thumb1 -
thigh_stretch.@ root.x thigh UpperLeg
thigh_twist.@ thigh_stretch.@ thighTwist -
leg_stretch.@ thigh_stretch.@ knee LowerLeg
leg_twist.@ leg_stretch.@ calfTwist -
foot.@ leg_stretch.@ ankle Foot
toes_01.@ foot.@ toes Toes)"},
    {"valve", "L", "R", R"(ValveBiped.Bip01_Pelvis - hips hips
ValveBiped.Bip01_Spine ValveBiped.Bip01_Pelvis waist +
ValveBiped.Bip01_Spine1 ValveBiped.Bip01_Spine spine +
ValveBiped.Bip01_Spine2 ValveBiped.Bip01_Spine1 chest +
ValveBiped.Bip01_Spine4 ValveBiped.Bip01_Spine2 upperChest *
ValveBiped.Bip01_Neck1 ValveBiped.Bip01_Spine4 neck neck
ValveBiped.Bip01_Head1 ValveBiped.Bip01_Neck1 head head
ValveBiped.forward ValveBiped.Bip01_Head1 (jaw) -
ValveBiped.Bip01_@_Clavicle ValveBiped.Bip01_Spine4 clavicle Shoulder
ValveBiped.Bip01_@_UpperArm ValveBiped.Bip01_@_Clavicle upperArm UpperArm
ValveBiped.Bip01_@_Forearm ValveBiped.Bip01_@_UpperArm elbow LowerArm
ValveBiped.Bip01_@_Hand ValveBiped.Bip01_@_Forearm hand Hand
ValveBiped.Anim_Attachment_@H ValveBiped.Bip01_@_Hand (palm) -
ValveBiped.Bip01_@_Finger1 ValveBiped.Bip01_@_Hand finger1 -
ValveBiped.Bip01_@_Finger0 ValveBiped.Bip01_@_Hand thumb1 -
ValveBiped.Bip01_@_Thigh ValveBiped.Bip01_Pelvis thigh UpperLeg
ValveBiped.Bip01_@_Calf ValveBiped.Bip01_@_Thigh knee LowerLeg
ValveBiped.Bip01_@_Foot ValveBiped.Bip01_@_Calf ankle Foot
ValveBiped.Bip01_@_Toe0 ValveBiped.Bip01_@_Foot toes Toes)"},
    {"advanced skeleton", "L", "R", R"(Main - (floor) -
Root_M Main hips hips
Spine1_M Root_M spine +
Chest_M Spine1_M chest *
Neck_M Chest_M neck neck
Head_M Neck_M head head
Jaw_M Head_M jaw -
Eye_@ Head_M eye -
Scapula_@ Chest_M clavicle Shoulder
Shoulder_@ Scapula_@ upperArm UpperArm
ShoulderPart1_@ Shoulder_@ upperArmTwist -
Elbow_@ Shoulder_@ elbow LowerArm
ElbowPart1_@ Elbow_@ forearmTwist -
Wrist_@ Elbow_@ hand Hand
IndexFinger1_@ Wrist_@ finger1 -
ThumbFinger1_@ Wrist_@ thumb1 -
Hip_@ Root_M thigh UpperLeg
HipPart1_@ Hip_@ thighTwist -
Knee_@ Hip_@ knee LowerLeg
Ankle_@ Knee_@ ankle Foot
Toes_@ Ankle_@ toes Toes
ToesEnd_@ Toes_@ (toeEnd) -)"},
    {"smpl", "L", "R", R"(root - (floor) -
Pelvis root hips hips
@_Hip Pelvis thigh UpperLeg
@_Knee @_Hip knee LowerLeg
@_Ankle @_Knee ankle Foot
@_Foot @_Ankle toes Toes
Spine1 Pelvis waist +
Spine2 Spine1 spine +
Spine3 Spine2 upperChest *
Neck Spine3 neck neck
Head Neck head head
@_Collar Spine3 clavicle Shoulder
@_Shoulder @_Collar upperArm UpperArm
@_Elbow @_Shoulder elbow LowerArm
@_Wrist @_Elbow hand Hand
@_Hand @_Wrist palm -)"},
    {"roblox r15", "Left", "Right", R"(HumanoidRootPart - (hips) -
LowerTorso HumanoidRootPart hips hips
UpperTorso LowerTorso spine *
Head UpperTorso neck head
@UpperArm UpperTorso upperArm UpperArm
@LowerArm @UpperArm elbow LowerArm
@Hand @LowerArm hand Hand
@UpperLeg LowerTorso thigh UpperLeg
@LowerLeg @UpperLeg knee LowerLeg
@Foot @LowerLeg ankle Foot)"},
    {"xsens", "Left", "Right", R"(Pelvis - hips hips
L5 Pelvis waist +
L3 L5 spine +
T12 L3 chest +
T8 T12 upperChest *
Neck T8 neck neck
Head Neck head head
@Shoulder T8 clavicle Shoulder
@UpperArm @Shoulder upperArm UpperArm
@ForeArm @UpperArm elbow LowerArm
@Hand @ForeArm hand Hand
@UpperLeg Pelvis thigh UpperLeg
@LowerLeg @UpperLeg knee LowerLeg
@Foot @LowerLeg ankle Foot
@Toe @Foot toes Toes)"},
    {"cat", "L", "R", R"(Base~Human - (floor) -
Base~HumanPelvis Base~Human hips hips
Base~HumanSpine1 Base~HumanPelvis spine +
Base~HumanRibcage Base~HumanSpine1 upperChest *
Base~HumanNeck1 Base~HumanRibcage neck neck
Base~HumanHead Base~HumanNeck1 head head
Base~Human@Collarbone Base~HumanRibcage clavicle Shoulder
Base~Human@Upperarm Base~Human@Collarbone upperArm UpperArm
Base~Human@Forearm Base~Human@Upperarm elbow LowerArm
Base~Human@Palm Base~Human@Forearm hand Hand
Base~Human@Digit11 Base~Human@Palm thumb1 -
Base~Human@Digit21 Base~Human@Palm finger1 -
Base~Human@Thigh Base~HumanPelvis thigh UpperLeg
Base~Human@Calf Base~Human@Thigh knee LowerLeg
Base~Human@Foot Base~Human@Calf ankle Foot
Base~Human@Toe1 Base~Human@Foot toes Toes
Base~Human@Platform Base~Human (ankle) -)"},
    {"cmu", "L", "R", R"(Hips - hips hips
@HipJoint Hips pelvisSide -
LowerBack Hips waist +
Spine LowerBack spine +
Spine1 Spine upperChest *
Neck Spine1 neck neck
Neck1 Neck neck2 -
Head Neck1 head head
@Shoulder Spine1 clavicle Shoulder
@Arm @Shoulder upperArm UpperArm
@ForeArm @Arm elbow LowerArm
@Hand @ForeArm hand Hand
@FingerBase @Hand palm -
@HandIndex1 @FingerBase finger1 -
@Thumb @Hand thumb1 -
@UpLeg @HipJoint thigh UpperLeg
@Leg @UpLeg knee LowerLeg
@Foot @Leg ankle Foot
@ToeBase @Foot toes Toes)"},
    {"half-life", "L", "R", R"(Bip01 - (hips) -
Bip01~Pelvis Bip01 hips hips
Bip01~Spine Bip01~Pelvis waist +
Bip01~Spine1 Bip01~Spine spine +
Bip01~Spine2 Bip01~Spine1 chest +
Bip01~Spine3 Bip01~Spine2 upperChest *
Bip01~Neck Bip01~Spine3 neck neck
Bip01~Head Bip01~Neck head head
Bip01~@~Arm Bip01~Neck clavicle Shoulder
Bip01~@~Arm1 Bip01~@~Arm upperArm UpperArm
Bip01~@~Arm2 Bip01~@~Arm1 elbow LowerArm
Bip01~@~Hand Bip01~@~Arm2 hand Hand
Bip01~@~Finger0 Bip01~@~Hand thumb1 -
Bip01~@~Finger1 Bip01~@~Hand finger1 -
Bip01~@~Leg Bip01~Pelvis thigh UpperLeg
Bip01~@~Leg1 Bip01~@~Leg knee LowerLeg
Bip01~@~Foot Bip01~@~Leg1 ankle Foot
Bip01~@~Toe0 Bip01~@~Foot toes Toes)"},
    {"makehuman game engine", "l", "r", R"(Root - (floor) -
pelvis Root hips hips
spine_01 pelvis spine +
spine_02 spine_01 chest +
spine_03 spine_02 upperChest *
neck_01 spine_03 neck neck
head neck_01 head head
clavicle_@ spine_03 clavicle Shoulder
upperarm_@ clavicle_@ upperArm UpperArm
lowerarm_@ upperarm_@ elbow LowerArm
hand_@ lowerarm_@ hand Hand
thumb_01_@ hand_@ thumb1 -
index_01_@ hand_@ finger1 -
thigh_@ pelvis thigh UpperLeg
calf_@ thigh_@ knee LowerLeg
foot_@ calf_@ ankle Foot
ball_@ foot_@ toes Toes)"},
    {"blender glued sides", "l", "r", R"(rig - (floor) -
hip rig hips hips
spine hip spine +
torso spine upperChest *
neck torso neck neck
head neck head head
@clav torso clavicle Shoulder
@uparm @clav upperArm UpperArm
@loarm @uparm elbow LowerArm
@hand @loarm hand Hand
@thigh hip thigh UpperLeg
@calf @thigh knee LowerLeg
@foot @calf ankle Foot
@toe @foot toes Toes)"},
    {"german", "links", "rechts", R"(Becken - hips hips
Wirbelsäule Becken spine +
Brust Wirbelsäule upperChest *
Hals Brust neck neck
Kopf Hals head head
Schulter_@ Brust clavicle Shoulder
Oberarm_@ Schulter_@ upperArm UpperArm
Unterarm_@ Oberarm_@ elbow LowerArm
Hand_@ Unterarm_@ hand Hand
Oberschenkel_@ Becken thigh UpperLeg
Unterschenkel_@ Oberschenkel_@ knee LowerLeg
Fuß_@ Unterschenkel_@ ankle Foot
Zehen_@ Fuß_@ toes Toes)"},
    {"spanish", "izq", "der", R"(cadera - hips hips
columna cadera spine +
pecho columna upperChest *
cuello pecho neck neck
cabeza cuello head head
hombro_@ pecho clavicle Shoulder
brazo_@ hombro_@ upperArm UpperArm
antebrazo_@ brazo_@ elbow LowerArm
mano_@ antebrazo_@ hand Hand
muslo_@ cadera thigh UpperLeg
pantorrilla_@ muslo_@ knee LowerLeg
pie_@ pantorrilla_@ ankle Foot)"},
    {"rigify control rig", "L", "R", R"(root - (floor) -
DEF-spine root hips hips
DEF-spine.001 DEF-spine spine +
DEF-spine.002 DEF-spine.001 chest +
DEF-spine.003 DEF-spine.002 upperChest *
DEF-spine.004 DEF-spine.003 neck neck
DEF-spine.005 DEF-spine.004 neck2 -
DEF-spine.006 DEF-spine.005 head head
MCH-torso.parent root (hips) -
ORG-spine MCH-torso.parent (hips) -
ORG-spine.003 ORG-spine (upperChest) -
DEF-shoulder.@ ORG-spine.003 clavicle Shoulder
DEF-upper_arm.@ ORG-spine.003 upperArm UpperArm
DEF-upper_arm.@.001 DEF-upper_arm.@ upperArmTwist -
DEF-forearm.@ DEF-upper_arm.@.001 elbow LowerArm
DEF-forearm.@.001 DEF-forearm.@ forearmTwist -
DEF-hand.@ DEF-forearm.@.001 hand Hand
DEF-pelvis.@ ORG-spine hips -
DEF-thigh.@ ORG-spine thigh UpperLeg
DEF-thigh.@.001 DEF-thigh.@ thighTwist -
DEF-shin.@ DEF-thigh.@.001 knee LowerLeg
DEF-shin.@.001 DEF-shin.@ calfTwist -
DEF-foot.@ DEF-shin.@.001 ankle Foot
DEF-toe.@ DEF-foot.@ toes Toes
foot_ik.@ root (ankle) -
hand_ik.@ root (hand) -
upper_arm_ik_target.@ root (elbowPole) -
thigh_ik_target.@ root (kneePole) -)"},
};

class Figure {
  public:
    explicit Figure(const Build& build) : b_(build) {}

    // Where a place of the left half (or the middle) is.
    [[nodiscard]] vec3 at(const std::string& place) const {
        const float hips = 0.90F * b_.legs + 0.05F;
        const float shoulder = hips + 0.47F * b_.trunk;
        const auto trunk = [&](float share) { return vec3(0, hips + share * 0.47F * b_.trunk, -0.01F); };
        const vec3 upperArm(0.17F * b_.shoulders, shoulder, -0.02F);
        const vec3 along(std::cos(b_.armsDown), -std::sin(b_.armsDown), 0);
        const vec3 elbow = upperArm + 0.28F * b_.arms * along + vec3(0, 0, -0.01F);
        const vec3 forearm = std::cos(b_.elbows) * along + std::sin(b_.elbows) * vec3(0, 0, 1);
        const vec3 hand = elbow + 0.26F * b_.arms * forearm;
        const vec3 thigh(0.10F, hips - 0.05F, 0.0F);
        const vec3 knee(0.10F, 0.49F * b_.legs, 0.015F);
        const vec3 ankle(0.10F, 0.08F * b_.legs, -0.02F);
        const vec3 neck = trunk(1.06F);
        const vec3 head = neck + vec3(0, 0.09F * b_.head, 0.02F);
        const std::pair<const char*, vec3> places[] = {
            {"floor", vec3(0)},
            {"hips", trunk(0.0F)},
            {"waist", trunk(0.12F)},
            {"spine", trunk(0.28F)},
            {"chest", trunk(0.5F)},
            {"upperChest", trunk(0.74F)},
            {"neck", neck},
            {"neck2", 0.5F * (neck + head)},
            {"head", head},
            {"eye", head + vec3(0.03F, 0.07F, 0.09F) * b_.head},
            {"jaw", head + vec3(0, 0.01F, 0.04F) * b_.head},
            {"hair1", head + vec3(0, 0.12F, -0.08F) * b_.head},
            {"hair2", head + vec3(0, -0.02F, -0.12F) * b_.head},
            {"bust", trunk(0.7F) + vec3(0.07F, 0, 0.1F)},
            {"clavicle", vec3(0.03F * b_.shoulders, shoulder + 0.01F, 0.0F)},
            {"upperArm", upperArm},
            {"upperArmTwist", 0.5F * (upperArm + elbow)},
            {"elbow", elbow},
            {"forearmTwist", 0.5F * (elbow + hand)},
            {"hand", hand},
            {"palm", hand + 0.04F * b_.arms * forearm},
            {"thumb1", hand + 0.03F * b_.arms * forearm + vec3(0, 0, 0.03F)},
            {"finger1", hand + 0.09F * b_.arms * forearm},
            {"finger2", hand + 0.13F * b_.arms * forearm},
            {"pelvisSide", vec3(0.04F, hips - 0.02F, 0)},
            {"thigh", thigh},
            {"thighTwist", 0.5F * (thigh + knee)},
            {"knee", knee},
            {"calfTwist", 0.5F * (knee + ankle)},
            {"ankle", ankle},
            {"toes0", vec3(0.10F, 0.04F * b_.legs, 0.05F)},
            {"toes", vec3(0.10F, 0.02F * b_.legs, 0.11F)},
            {"toeEnd", vec3(0.10F, 0.02F * b_.legs, 0.18F)},
            {"skirt1", thigh + vec3(0.03F, -0.02F, 0.1F)},
            {"skirt2", thigh + vec3(0.05F, -0.25F, 0.14F)},
            {"elbowPole", elbow + vec3(0, 0, -0.5F)},
            {"kneePole", knee + vec3(0, 0, 0.5F)},
        };
        const auto* found =
            std::find_if(std::begin(places), std::end(places), [&](const auto& entry) { return place == entry.first; });
        LUTKA_ASSERT(found != std::end(places));
        return found->second;
    }

  private:
    Build b_;
};

std::string withSide(std::string text, const std::string& side) {
    for (std::size_t at = text.find('@'); at != std::string::npos; at = text.find('@'))
        text.replace(at, 1, side);
    std::replace(text.begin(), text.end(), '~', ' ');
    return text;
}

void addJoint(SyntheticRig& rig, const std::string& name, const std::string& parent, const vec3& position, bool skin) {
    animation::Skeleton& skeleton = rig.character.skeleton;
    const auto found = std::find(skeleton.names.begin(), skeleton.names.end(), parent);
    const bool isRoot = found == skeleton.names.end();
    LUTKA_ASSERT(!isRoot || parent == "-");
    const int index = static_cast<int>(found - skeleton.names.begin());
    skeleton.names.push_back(name);
    skeleton.parents.push_back(isRoot ? animation::kNoJoint : index);
    skeleton.bindModelFromJoint.push_back({quat(1, 0, 0, 0), position});
    const vec3 base = isRoot ? vec3(0) : skeleton.bindModelFromJoint[index].translation;
    skeleton.nodeParentFromJoint.push_back({quat(1, 0, 0, 0), position - base});
    skeleton.skinWeight.push_back(skin ? 100.0F : 0.0F);
}

void addTruth(Truth& truth, const std::string& role, const std::string& name, bool left, bool sided) {
    if (role == "-") return;
    if (role == "+") {
        truth.spine.push_back(name);
    } else if (role == "*") {
        truth.chest.push_back(name);
    } else {
        const std::string full = sided ? (left ? "left" : "right") + role : role;
        truth.roles[indexOf(*animation::roleFromName(full))] = std::vector<std::string>{name};
    }
}

}  // namespace

std::vector<std::string> syntheticConventions() {
    std::vector<std::string> names;
    for (const Convention& convention : kConventions)
        names.emplace_back(convention.name);
    return names;
}

SyntheticRig makeSyntheticRig(const std::string& convention, const Build& build) {
    const auto* found = std::find_if(std::begin(kConventions), std::end(kConventions),
                                     [&](const Convention& c) { return convention == c.name; });
    LUTKA_ASSERT(found != std::end(kConventions));
    const Figure figure(build);
    SyntheticRig rig;
    rig.truth.model = convention;
    rig.truth.humanoid = true;
    std::istringstream lines(found->joints);
    std::string name;
    std::string parent;
    std::string place;
    std::string role;
    while (lines >> name >> parent >> place >> role) {
        const bool skin = place.front() != '(';
        const vec3 position = figure.at(skin ? place : place.substr(1, place.size() - 2));
        const bool sided = name.find('@') != std::string::npos;
        for (const bool left : {true, false}) {
            const std::string side = left ? found->left : found->right;
            const std::string full = withSide(name, side);
            if (left || sided) {
                addJoint(rig, full, withSide(parent, side), left ? position : vec3(-position.x, position.y, position.z),
                         skin);
                addTruth(rig.truth, role, full, left, sided);
            }
        }
    }
    return rig;
}

void addAccessories(SyntheticRig& rig, std::uint64_t seed) {
    Random random(seed);
    const auto nameOf = [&](Role role) { return rig.truth.roles[indexOf(role)]->front(); };
    const auto at = [&](const std::string& name) {
        const auto& names = rig.character.skeleton.names;
        const auto index = std::find(names.begin(), names.end(), name) - names.begin();
        return rig.character.skeleton.bindModelFromJoint[index].translation;
    };
    const auto addChain = [&](const std::string& stem, const std::string& parent, vec3 start, const vec3& step,
                              int count) {
        std::string last = parent;
        for (int i = 0; i < count; ++i) {
            const std::string name = stem + std::to_string(i);
            addJoint(rig, name, last, start, true);
            rig.character.skeleton.skinWeight.back() = 12.0F;
            last = name;
            start += step;
        }
    };
    const std::string head = nameOf(Role::head);
    const std::string hips = nameOf(Role::hips);
    const float sway = random.uniform(0.8F, 1.2F);
    addChain("tail_", hips, at(hips) + vec3(0, 0.02F, -0.1F), vec3(0, -0.03F, -0.12F) * sway, 5);
    for (const bool left : {true, false}) {
        const float x = left ? 1.0F : -1.0F;
        const std::string side = left ? "_L" : "_R";
        addChain("hair" + side, head, at(head) + vec3(0.08F * x, 0.1F, -0.02F), vec3(0.02F * x, -0.12F, 0) * sway, 4);
        addChain("skirt" + side, hips, at(hips) + vec3(0.14F * x, -0.04F, 0.05F), vec3(0.02F * x, -0.13F, 0.02F) * sway,
                 3);
        addChain("wing" + side, rig.truth.chest.front(), at(rig.truth.chest.front()) + vec3(0.08F * x, 0.05F, -0.12F),
                 vec3(0.25F * x, 0.12F, -0.1F) * sway, 3);
    }
}

}  // namespace lutka::test
