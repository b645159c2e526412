#include "animation/humanoid/roles.hpp"

namespace lutka::animation {
namespace {

struct RoleFacts {
    std::string_view name;
    int parent;  // -1: none
    bool required;
};

constexpr int kFirstLeft = 6;
constexpr int kPerSide = 8;

// In the order of the enumeration.
constexpr std::array<RoleFacts, kRoleCount> kFacts{{
    {"hips", -1, true},          {"spine", 0, true},       {"chest", 1, false},         {"upperChest", 2, false},
    {"neck", 3, false},          {"head", 4, true},        {"leftShoulder", 3, false},  {"leftUpperArm", 6, true},
    {"leftLowerArm", 7, true},   {"leftHand", 8, true},    {"leftUpperLeg", 0, true},   {"leftLowerLeg", 10, true},
    {"leftFoot", 11, true},      {"leftToes", 12, false},  {"rightShoulder", 3, false}, {"rightUpperArm", 14, true},
    {"rightLowerArm", 15, true}, {"rightHand", 16, true},  {"rightUpperLeg", 0, true},  {"rightLowerLeg", 18, true},
    {"rightFoot", 19, true},     {"rightToes", 20, false},
}};

}  // namespace

std::string_view roleName(Role role) {
    return kFacts[indexOf(role)].name;
}

std::optional<Role> roleFromName(std::string_view name) {
    for (int index = 0; index < kRoleCount; ++index) {
        if (kFacts[index].name == name) return roleAt(index);
    }
    return std::nullopt;
}

Side sideOf(Role role) {
    const int index = indexOf(role);
    if (index < kFirstLeft) return Side::center;
    return index < kFirstLeft + kPerSide ? Side::left : Side::right;
}

Role mirrored(Role role) {
    switch (sideOf(role)) {
        case Side::left:
            return roleAt(indexOf(role) + kPerSide);
        case Side::right:
            return roleAt(indexOf(role) - kPerSide);
        case Side::center:
            break;
    }
    return role;
}

bool isEitherSide(Role role, Role left) {
    return role == left || role == mirrored(left);
}

bool isSpine(Role role) {
    return role == Role::spine || role == Role::chest || role == Role::upperChest;
}

bool isTrunk(Role role) {
    return role == Role::hips || isSpine(role);
}

bool isRequired(Role role) {
    return kFacts[indexOf(role)].required;
}

std::optional<Role> parentRole(Role role) {
    const int parent = kFacts[indexOf(role)].parent;
    if (parent < 0) return std::nullopt;
    return roleAt(parent);
}

}  // namespace lutka::animation
