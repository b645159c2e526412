#include "walking_biped.hpp"

#include <glm/geometric.hpp>
#include <span>
#include <string>

#include "animation/ik/two_bone.hpp"
#include "animation/pose.hpp"
#include "core/random.hpp"

namespace lutka::test {

using namespace animation;

namespace {

constexpr float kAnkle = 0.09F;
constexpr float kShin = 0.41F;
constexpr float kThigh = 0.40F;

/// Adds joints by their standard places.
class Builder {
  public:
    explicit Builder(TestHumanoid& out) : out_(out), random_(out.spec.axesSeed + 1) {}

    int add(const std::string& name, int parent, const vec3& place) {
        Skeleton& skeleton = out_.character.skeleton;
        const HumanoidSpec& spec = out_.spec;
        quat axes(1, 0, 0, 0);
        if (spec.axesSeed != 0) {
            axes = glm::normalize(quat(random_.uniform(-1, 1), random_.uniform(-1, 1), random_.uniform(-1, 1),
                                       random_.uniform(-1, 1) + 0.01F));
        }
        skeleton.names.push_back(name);
        skeleton.parents.push_back(parent);
        skeleton.bindModelFromJoint.push_back({axes, spec.modelFromStandard * (place * spec.scale)});
        skeleton.skinWeight.push_back(1.0F);
        return skeleton.jointCount() - 1;
    }
    int add(Role role, int parent, const vec3& place) {
        const int joint = add(std::string(roleName(role)), parent, place);
        out_.map.roles[indexOf(role)] = RoleBinding{joint, 1.0F, "made"};
        return joint;
    }

  private:
    TestHumanoid& out_;
    Random random_;
};

void addFingers(Builder& builder, int hand, const vec3& wrist, const vec3& along) {
    for (const char* name : {"Thumb", "Index", "Middle"}) {
        int parent = hand;
        vec3 place = wrist + along * 0.08F;
        for (const char* part : {"Proximal", "Intermediate", "Distal"}) {
            parent = builder.add(std::string(name) + part, parent, place);
            place += along * 0.03F;
        }
    }
}

void addArm(Builder& builder, const HumanoidSpec& spec, int chest, float chestHeight, bool left) {
    const float sign = left ? 1.0F : -1.0F;
    const auto of = [&](Role role) { return left ? role : mirrored(role); };
    int parent = chest;
    const vec3 top(0, chestHeight + 0.12F, 0);
    if (spec.shoulders) parent = builder.add(of(Role::leftShoulder), parent, top + vec3(sign * 0.04F, 0, 0));
    const vec3 shoulder = top + vec3(sign * 0.18F, 0, 0);
    const quat drop = glm::angleAxis(-sign * radians(spec.armDropDeg), vec3(0, 0, 1));
    const vec3 upper = drop * vec3(sign, 0, 0);
    // The elbow flexes about the axis that is upright in a T-pose.
    const quat bend = drop * glm::angleAxis(-sign * radians(spec.elbowBendDeg), vec3(0, 1, 0));
    const vec3 lower = bend * vec3(sign, 0, 0);
    const vec3 elbow = shoulder + upper * (0.28F * spec.armShare);
    const vec3 wrist = elbow + lower * (0.26F * spec.armShare);
    parent = builder.add(of(Role::leftUpperArm), parent, shoulder);
    parent = builder.add(of(Role::leftLowerArm), parent, elbow);
    if (spec.twistJoints) parent = builder.add("twist", parent, (elbow + wrist) * 0.5F);
    parent = builder.add(of(Role::leftHand), parent, wrist);
    if (spec.fingers)
        addFingers(builder, parent, wrist, lower);
    else
        builder.add("palm", parent, wrist + lower * 0.08F);
}

void addLeg(Builder& builder, const HumanoidSpec& spec, int hips, bool left) {
    const float x = (left ? 1.0F : -1.0F) * spec.hipWidth;
    const auto of = [&](Role role) { return left ? role : mirrored(role); };
    const float knee = kAnkle + kShin * spec.legShare;
    int parent = builder.add(of(Role::leftUpperLeg), hips, {x, knee + kThigh * spec.legShare, 0});
    parent = builder.add(of(Role::leftLowerLeg), parent, {x, knee, 0.005F});
    parent = builder.add(of(Role::leftFoot), parent, {x, kAnkle, -0.01F});
    if (!spec.toes) return;
    parent = builder.add(of(Role::leftToes), parent, {x, 0.03F, 0.13F});
    builder.add("toeEnd", parent, {x, 0.0F, 0.2F});
}

float legsTop(const HumanoidSpec& spec) {
    return kAnkle + (kShin + kThigh) * spec.legShare;
}

vec3 inModel(const TestHumanoid& humanoid, const vec3& standard) {
    return humanoid.spec.modelFromStandard * (standard * humanoid.spec.scale);
}

/// Where an ankle is at a time of the walk, before the scale, and how far its toes hang.
struct Step {
    vec3 ankle;
    float pitch = 0.0F;
};

Step stepAt(const HumanoidSpec& spec, float seconds, bool left) {
    constexpr float kStance = 0.6F;
    const float stride = 0.8F * spec.legShare;
    const float phase = seconds + (left ? 0.0F : 0.5F);
    const float cycle = std::floor(phase);
    const float part = phase - cycle;
    // While it stands the body goes over it.
    const float stand = (cycle - (left ? 0.0F : 0.5F)) * stride + kStance * 0.5F * stride;
    const float x = left ? spec.hipWidth : -spec.hipWidth;
    if (part <= kStance) return {{x, kAnkle, stand}, 0.0F};
    const float swing = (part - kStance) / (1.0F - kStance);
    const float eased = swing * swing * (3.0F - 2.0F * swing);
    const float lift = std::sin(kPi * swing);
    return {{x, kAnkle + 0.12F * lift * lift, stand + eased * stride}, 0.4F * lift * lift};
}

}  // namespace

TestHumanoid makeHumanoid(const HumanoidSpec& spec) {
    TestHumanoid out;
    out.spec = spec;
    out.character.name = "made";
    out.map.humanoid = true;
    out.map.confidence = 1.0F;
    out.map.standardFromModel = glm::conjugate(spec.modelFromStandard);
    Builder builder(out);
    const float hipsHeight = legsTop(spec) + 0.03F;
    const int hips = builder.add(Role::hips, kNoJoint, {0, hipsHeight, 0});
    int trunk = hips;
    float height = hipsHeight;
    for (int i = 0; i < spec.trunkJoints; ++i) {
        height = hipsHeight + 0.36F * static_cast<float>(i + 1) / static_cast<float>(spec.trunkJoints);
        if (i == 0)
            trunk = builder.add(Role::spine, trunk, {0, height, 0});
        else if (i + 1 == spec.trunkJoints)
            trunk = builder.add(Role::chest, trunk, {0, height, 0});
        else
            trunk = builder.add("between", trunk, {0, height, 0});
    }
    const int neck = builder.add(Role::neck, trunk, {0, height + 0.18F, 0});
    builder.add(Role::head, neck, {0, height + 0.27F, 0.01F});
    for (const bool left : {true, false})
        addArm(builder, spec, trunk, height, left);
    for (const bool left : {true, false})
        addLeg(builder, spec, hips, left);
    Skeleton& skeleton = out.character.skeleton;
    skeleton.nodeParentFromJoint.resize(skeleton.parents.size());
    modelToLocal(skeleton, skeleton.bindModelFromJoint, skeleton.nodeParentFromJoint);
    return out;
}

std::span<const RigidTransform> frameOf(const Clip& clip, int frame) {
    const std::size_t joints = clip.parentFromJoint.size() / static_cast<std::size_t>(clip.frameCount);
    return std::span(clip.parentFromJoint.get()).subspan(static_cast<std::size_t>(frame) * joints, joints);
}

void turnInStandard(const TestHumanoid& humanoid, Role role, const quat& turn,
                    std::span<RigidTransform> parentFromJoint) {
    const Skeleton& skeleton = humanoid.character.skeleton;
    const int joint = humanoid.map.jointOf(role);
    if (joint == kNoJoint) return;
    const quat& to = humanoid.spec.modelFromStandard;
    const quat inModelSpace = to * turn * glm::conjugate(to);
    const quat now = modelFrameOf(skeleton, parentFromJoint, joint).rotation;
    RigidTransform& local = parentFromJoint[joint];
    const quat modelFromParent = now * glm::conjugate(local.rotation);
    local.rotation = glm::normalize(glm::conjugate(modelFromParent) * inModelSpace * now);
}

vec3 boneDirection(const TestHumanoid& humanoid, std::span<const RigidTransform> parentFromJoint, Role from, Role to) {
    const Skeleton& skeleton = humanoid.character.skeleton;
    const vec3 a = modelFrameOf(skeleton, parentFromJoint, humanoid.map.jointOf(from)).translation;
    const vec3 b = modelFrameOf(skeleton, parentFromJoint, humanoid.map.jointOf(to)).translation;
    return glm::normalize(humanoid.map.standardFromModel * (b - a));
}

Clip makeWalk(const TestHumanoid& humanoid) {
    const HumanoidSpec& spec = humanoid.spec;
    const Skeleton& skeleton = humanoid.character.skeleton;
    const quat& to = spec.modelFromStandard;
    std::vector<RigidTransform> rest(skeleton.parents.size());
    modelToLocal(skeleton, skeleton.bindModelFromJoint, rest);
    Clip clip;
    clip.name = "walk";
    clip.frameCount = 61;
    for (int frame = 0; frame < clip.frameCount; ++frame) {
        const float seconds = static_cast<float>(frame) / clip.framesPerSecond;
        const float turn = 2.0F * kPi * seconds;
        std::vector<RigidTransform> pose = rest;
        const vec3 hips(0.02F * std::sin(turn), legsTop(spec) - 0.06F + 0.01F * std::cos(2.0F * turn),
                        0.8F * spec.legShare * seconds);
        pose[0].translation = inModel(humanoid, hips);
        turnInStandard(humanoid, Role::spine, glm::angleAxis(0.15F * std::sin(turn), vec3(0, 1, 0)), pose);
        for (const bool left : {true, false}) {
            const auto of = [&](Role role) { return left ? role : mirrored(role); };
            const float sign = left ? 1.0F : -1.0F;
            const float swing = 0.5F * sign * std::sin(turn);
            const vec3 now = boneDirection(humanoid, pose, of(Role::leftUpperArm), of(Role::leftLowerArm));
            const vec3 hanging = glm::normalize(vec3(sign * 0.15F, -1.0F, 0));
            turnInStandard(humanoid, of(Role::leftUpperArm),
                           glm::angleAxis(swing, vec3(1, 0, 0)) * rotationBetween(now, hanging), pose);
            turnInStandard(humanoid, of(Role::leftLowerArm), glm::angleAxis(-0.4F, vec3(1, 0, 0)), pose);
            const Step step = stepAt(spec, seconds, left);
            TwoBone leg;
            leg.upper = humanoid.map.jointOf(of(Role::leftUpperLeg));
            leg.middle = humanoid.map.jointOf(of(Role::leftLowerLeg));
            leg.end = humanoid.map.jointOf(of(Role::leftFoot));
            TwoBoneGoal goal;
            goal.softness = 0.0F;
            goal.target = inModel(humanoid, step.ankle);
            goal.pole = to * vec3(0, 0, 1);
            const quat pitch = glm::angleAxis(step.pitch, vec3(1, 0, 0));
            goal.endRotation = to * pitch * glm::conjugate(to) * skeleton.bindModelFromJoint[leg.end].rotation;
            solveTwoBone(skeleton, leg, goal, pose);
        }
        clip.parentFromJoint.append(pose);
    }
    return clip;
}

}  // namespace lutka::test
