#include "synthetic_rigs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <sstream>

#include "core/assert.hpp"
#include "core/random.hpp"
#include "synthetic_conventions.hpp"

namespace lutka::test {
namespace {

using animation::Role;

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
    for (const Convention& convention : conventions())
        names.emplace_back(convention.name);
    return names;
}

SyntheticRig makeSyntheticRig(const std::string& convention, const Build& build) {
    const auto found = std::find_if(conventions().begin(), conventions().end(),
                                    [&](const Convention& c) { return convention == c.name; });
    LUTKA_ASSERT(found != conventions().end());
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
