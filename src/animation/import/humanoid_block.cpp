#include "animation/import/humanoid_block.hpp"

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "core/math.hpp"

namespace lutka::animation::rig_import {
namespace {

class Block {
  public:
    Block(const std::map<std::string, int>& roles, const Skeleton& skeleton) : roles_(roles), skeleton_(skeleton) {}

    [[nodiscard]] std::optional<int> joint(const std::string& role) const {
        const auto found = roles_.find(role);
        return found == roles_.end() ? std::nullopt : std::optional(found->second);
    }
    [[nodiscard]] vec3 place(int joint) const { return skeleton_.bindModelFromJoint[joint].translation; }
    [[nodiscard]] std::string called(const std::string& role) const {
        return fmt::format("{} (\"{}\")", role, skeleton_.names[*joint(role)]);
    }

    // A limb's joint that lies above the one which it should hang on, or hangs on another limb instead. (Feet may hang
    // on helpers beside their legs.)
    [[nodiscard]] std::optional<std::string> brokenLimb() const {
        constexpr const char* kLimbs[][3] = {{"UpperArm", "LowerArm", "Hand"}, {"UpperLeg", "LowerLeg", "Foot"}};
        for (const char* side : {"left", "right"}) {
            for (const auto& limb : kLimbs) {
                for (int i = 0; i < 2; ++i) {
                    const std::string upper = std::string(side) + limb[i];
                    const std::string lower = std::string(side) + limb[i + 1];
                    if (!joint(upper) || !joint(lower) || *joint(upper) == *joint(lower)) continue;
                    if (isAncestorOrSelf(skeleton_, *joint(lower), *joint(upper)))
                        return fmt::format("{} lies above {}, which it should hang on", called(lower), called(upper));
                    if (isAncestorOrSelf(skeleton_, *joint(upper), *joint(lower))) continue;
                    if (const auto other = upperAbove(*joint(lower)))
                        return fmt::format("{} hangs on {}", called(lower), called(*other));
                }
            }
        }
        return std::nullopt;
    }

    // A leg that begins nearer to the head than the arm of its side.
    [[nodiscard]] std::optional<std::string> legAboveArm() const {
        if (!joint("hips") || !joint("head")) return std::nullopt;
        const vec3 up = place(*joint("head")) - place(*joint("hips"));
        for (const std::string side : {"left", "right"}) {
            const auto arm = joint(side + "UpperArm");
            const auto leg = joint(side + "UpperLeg");
            if (!arm || !leg || !(glm::dot(place(*leg) - place(*arm), up) > 0.0F)) continue;
            return fmt::format("{} lies above {}", called(side + "UpperLeg"), called(side + "UpperArm"));
        }
        return std::nullopt;
    }

    // Toes that point backwards where left and right are as the map says.
    [[nodiscard]] std::optional<std::string> exchangedSides() const {
        constexpr float kPlain = 0.5F;  // of the cosine: feet may be turned, and toes bound to a foot's end
        for (const char* role :
             {"hips", "head", "leftUpperLeg", "rightUpperLeg", "leftFoot", "rightFoot", "leftToes", "rightToes"}) {
            if (!joint(role)) return std::nullopt;
        }
        const vec3 up = glm::normalize(place(*joint("head")) - place(*joint("hips")));
        const vec3 left = place(*joint("leftUpperLeg")) - place(*joint("rightUpperLeg"));
        const vec3 front = glm::cross(left, up);
        for (const std::string side : {"left", "right"}) {
            vec3 toes = place(*joint(side + "Toes")) - place(*joint(side + "Foot"));
            toes -= glm::dot(toes, up) * up;
            if (!(glm::dot(toes, front) < -kPlain * glm::length(toes) * glm::length(front))) return std::nullopt;
        }
        return "left and right are exchanged: the toes would point backwards";
    }

  private:
    [[nodiscard]] std::optional<std::string> upperAbove(int joint_) const {
        for (const char* role : {"leftUpperArm", "rightUpperArm", "leftUpperLeg", "rightUpperLeg"}) {
            if (joint(role) && isAncestorOrSelf(skeleton_, *joint(role), joint_)) return role;
        }
        return std::nullopt;
    }

    const std::map<std::string, int>& roles_;
    const Skeleton& skeleton_;
};

}  // namespace

std::optional<std::string> contradictionIn(const std::map<std::string, int>& roles, const Skeleton& skeleton) {
    const Block block(roles, skeleton);
    std::optional<std::string> found = block.brokenLimb();
    if (!found) found = block.legAboveArm();
    return found ? found : block.exchangedSides();
}

}  // namespace lutka::animation::rig_import
