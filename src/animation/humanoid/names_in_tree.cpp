#include "animation/humanoid/names_in_tree.hpp"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <initializer_list>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "animation/humanoid/name_lexicon.hpp"
#include "animation/humanoid/names_of_arms.hpp"
#include "animation/humanoid/names_of_ends.hpp"

namespace lutka::animation {
namespace {

// What a name's score says of a part.
constexpr float kSurely = kTellsSurely;
constexpr float kMaybe = 2.0F;
constexpr float kSurelyNot = -2.5F;
constexpr float kOfOtherPart = -9.0F;  // no place for it at all
constexpr float kRatherNot = 0.5F;     // the name tells the limb, and another part of it is likelier
constexpr float kSomeLimb = 1.5F;      // the name tells the limb and no part of it

bool saysConcept(const NameEvidence& name, Concept meaning) {
    return std::any_of(name.words.begin(), name.words.end(),
                       [&](const std::string& word) { return conceptOf(word) == meaning; });
}

// An elbow that moves nothing, beside an arm that goes on in skin, is what the elbow points at.
bool isPoleBesideArm(const RigFeatures& rig, int elbow) {
    if (!rig.skinned || rig.carriesSkin(elbow)) return false;
    const std::vector<int>& siblings = rig.children[rig.parents[elbow]];
    return std::any_of(siblings.begin(), siblings.end(), [&](int sibling) {
        return rig.names[sibling].side == rig.names[elbow].side && rig.carriesSkin(sibling) &&
               rig.names[sibling].parts[Part::upperArm] >= kMaybe;
    });
}

// "Shoulder, forearm, arm" from above: who so calls them means the fore part of the arm and the rest of it. Not where
// a hand hangs on the forearm, or what moves more skin than that arm: then it only turns with the forearm.
void readForearmsAboveArms(RigFeatures& rig) {
    const auto goesOnElsewhere = [&](int forearm, int arm) {
        return std::any_of(rig.children[forearm].begin(), rig.children[forearm].end(), [&](int child) {
            return child != arm &&
                   (rig.names[child].parts[Part::hand] >= kSurely || rig.subtreeWeight[child] > rig.subtreeWeight[arm]);
        });
    };
    for (int lower = 0; lower < rig.count(); ++lower) {
        const int upper = rig.parents[lower];
        const int shoulder = upper == kNoJoint ? kNoJoint : rig.parents[upper];
        if (shoulder == kNoJoint) continue;
        const Side side = rig.names[lower].side;
        if (rig.names[upper].side != side || rig.names[shoulder].side != side) continue;
        if (!rig.names[lower].bareLimb || !saysConcept(rig.names[lower], Concept::arm)) continue;
        if (rig.names[upper].parts[Part::lowerArm] < kSurely || rig.names[shoulder].parts[Part::clavicle] < kMaybe)
            continue;
        if (goesOnElsewhere(upper, lower)) continue;
        for (const auto& [joint, part] : {std::pair{shoulder, Part::clavicle}, std::pair{upper, Part::upperArm},
                                          std::pair{lower, Part::lowerArm}}) {
            rig.names[joint].bareLimb = false;
            rig.names[joint].parts.values.fill(kSurelyNot);
            rig.names[joint].parts[part] = kSurely;
        }
    }
}

// A wrist on the forearm, from which the hand with its fingers is further away than the elbow.
bool isWristInForearm(const RigFeatures& rig, int wrist, int hand) {
    constexpr std::size_t kFewestFingers = 3;
    const int elbow = rig.parents[wrist];
    if (elbow == kNoJoint || rig.names[elbow].parts[Part::lowerArm] < kSurely) return false;
    if (!saysConcept(rig.names[wrist], Concept::wrist) || saysConcept(rig.names[hand], Concept::wrist)) return false;
    return rig.children[hand].size() >= kFewestFingers && rig.carriesSkin(hand) &&
           glm::distance(rig.positions[wrist], rig.positions[hand]) >
               glm::distance(rig.positions[elbow], rig.positions[wrist]);
}

// A word of two meanings has one where its neighbour has the other: a shoulder above an arm is the clavicle and that
// arm the upper arm, one above an elbow is the upper arm itself; a leg below a thigh is the shin.
void readNamesInChains(RigFeatures& rig) {
    // An elbow first: beside it may hang what stands for the arm's volume.
    for (int joint = 0; joint < rig.count(); ++joint) {
        const int parent = rig.parents[joint];
        if (parent == kNoJoint || rig.names[parent].side != rig.names[joint].side) continue;
        PartScores& upper = rig.names[parent].parts;
        const bool isShoulder = upper[Part::clavicle] >= kMaybe && upper[Part::clavicle] < kSurely;
        if (!isShoulder || rig.names[joint].parts[Part::lowerArm] < kSurely || isPoleBesideArm(rig, joint)) continue;
        upper[Part::upperArm] = std::max(upper[Part::upperArm], kSurely);
        upper[Part::clavicle] = kSurelyNot;
    }
    for (int joint = 0; joint < rig.count(); ++joint) {
        const int parent = rig.parents[joint];
        if (parent == kNoJoint || rig.names[parent].side != rig.names[joint].side) continue;
        PartScores& upper = rig.names[parent].parts;
        PartScores& lower = rig.names[joint].parts;
        if (rig.names[parent].words == rig.names[joint].words) continue;
        if (upper[Part::clavicle] >= kMaybe && lower[Part::upperArm] >= kMaybe && lower[Part::clavicle] < kMaybe) {
            upper[Part::clavicle] = std::max(upper[Part::clavicle], kSurely);
            upper[Part::upperArm] = kSurelyNot;
            lower[Part::upperArm] = std::max(lower[Part::upperArm], kSurely);
        }
        // A wrist nearer to the elbow than to the hand turns with the forearm.
        if (upper[Part::hand] >= kSurely && lower[Part::hand] >= kSurely && isWristInForearm(rig, parent, joint))
            upper[Part::hand] = kSurelyNot;
        // Palm below a hand: the bones of the middle hand. Nor is a thing named so below a foot another foot.
        for (const Part end : {Part::hand, Part::foot}) {
            if (upper[end] >= kSurely && lower[end] >= kSurely) lower[end] = kSurelyNot;
        }
        if (upper[Part::upperLeg] >= kSurely && lower[Part::lowerLeg] >= kMaybe) {
            lower[Part::lowerLeg] = std::max(lower[Part::lowerLeg], kSurely);
            lower[Part::upperLeg] = kSurelyNot;
        }
    }
}

// In a flattened rig no joint hangs on the shoulder: beside a joint that is called arm it is the clavicle. The arm
// hangs where the shoulder does, or on a root or a control, but never on a shoulder: else the one beside it is a pad.
void readFlatShoulders(RigFeatures& rig) {
    // Also one of which its place has told that it is the upper arm (readShouldersAsArms()).
    const auto isShoulder = [&](int joint) {
        return rig.names[joint].parts[Part::clavicle] >= kMaybe || saysConcept(rig.names[joint], Concept::shoulder);
    };
    std::vector<int> arms;
    for (int joint = 0; joint < rig.count(); ++joint) {
        const NameEvidence& name = rig.names[joint];
        if (name.side == Side::center || name.helper || name.parts[Part::upperArm] < kMaybe || isShoulder(joint) ||
            !rig.carriesSkin(joint))
            continue;
        int above = rig.parents[joint];
        while (above != kNoJoint && !isShoulder(above))
            above = rig.parents[above];
        if (above == kNoJoint) arms.push_back(joint);
    }
    const auto areBeside = [&](int arm, int shoulder) {
        const int parent = rig.parents[arm];
        const bool flat = parent == kNoJoint || parent == rig.parents[shoulder] || rig.directWeight[parent] <= 0.0F;
        return flat && rig.names[arm].side == rig.names[shoulder].side && !rig.isAncestorOrSelf(arm, shoulder);
    };
    for (int shoulder = 0; shoulder < rig.count(); ++shoulder) {
        const NameEvidence& name = rig.names[shoulder];
        PartScores& parts = rig.names[shoulder].parts;
        if (name.side == Side::center || name.helper || !isShoulder(shoulder) || parts[Part::clavicle] >= kSurely ||
            !rig.children[shoulder].empty())
            continue;
        for (const int arm : arms) {
            if (!areBeside(arm, shoulder)) continue;
            parts[Part::clavicle] = kSurely;
            parts[Part::upperArm] = kSurelyNot;
            rig.names[arm].parts[Part::upperArm] = std::max(rig.names[arm].parts[Part::upperArm], kSurely);
        }
    }
}

// A rigid mesh that hangs on the joint of its name is no joint of its own: "Head" below "Head_jnt".
void leaveNamesToPivots(RigFeatures& rig) {
    constexpr float kTellingName = 2.0F;
    for (int joint = 0; joint < rig.count(); ++joint) {
        const int parent = rig.parents[joint];
        if (parent == kNoJoint || !rig.rigidPart[joint] || rig.rigidPart[parent] || !rig.children[joint].empty())
            continue;
        if (rig.names[parent].side != rig.names[joint].side || rig.names[parent].helper) continue;
        PartScores& own = rig.names[joint].parts;
        const PartScores& above = rig.names[parent].parts;
        bool alike = false;
        for (std::size_t part = 0; part < own.values.size(); ++part)
            alike = alike || (own.values[part] >= kTellingName && above.values[part] >= kTellingName);
        if (!alike) continue;
        own.values.fill(kOfOtherPart);
        rig.names[joint].helper = true;
    }
}

// The blocks below a group that is named as a part, or as something worn, are its mesh and no parts of their own:
// "cube" below "leg_left".
void leaveBlocksToGroups(RigFeatures& rig) {
    constexpr std::array<std::string_view, 6> kSolids{"cube", "cuboid", "box", "sphere", "cylinder", "plane"};
    constexpr float kTellingName = 1.0F;
    constexpr float kNoPart = -3.0F;  // a robe, a weapon, hair
    const auto isSolid = [&](const std::string& word) {
        return std::find(kSolids.begin(), kSolids.end(), word) != kSolids.end();
    };
    for (int joint = 0; joint < rig.count(); ++joint) {
        const int group = rig.parents[joint];
        NameEvidence& name = rig.names[joint];
        const bool block = rig.rigidPart[joint] && rig.children[joint].empty() && !name.words.empty() &&
                           std::all_of(name.words.begin(), name.words.end(), isSolid);
        if (!block || group == kNoJoint || rig.rigidPart[group]) continue;
        const auto& parts = rig.names[group].parts.values;
        const float most = *std::max_element(parts.begin(), parts.end());
        if (most < kTellingName && most > kNoPart) continue;
        name.parts.values.fill(kOfOtherPart);
        name.helper = true;
    }
}

// The limb that a name speaks of, or what is worn on it.
enum class WornLimb { none, arm, leg };

WornLimb wornLimbOf(const NameEvidence& name) {
    using Meanings = std::initializer_list<Concept>;
    const auto saysAny = [&](Meanings meanings) {
        return std::any_of(meanings.begin(), meanings.end(), [&](Concept one) { return saysConcept(name, one); });
    };
    const auto hasAny = [&](std::initializer_list<std::string_view> words) {
        return std::any_of(name.words.begin(), name.words.end(), [&](const std::string& word) {
            return std::find(words.begin(), words.end(), word) != words.end();
        });
    };
    if (hasAny({"sleeve", "sleeves"}) ||
        saysAny({Concept::arm, Concept::upperArm, Concept::forearm, Concept::elbow, Concept::wrist, Concept::hand}))
        return WornLimb::arm;
    if (hasAny({"pants", "trousers"}) ||
        saysAny({Concept::leg, Concept::thigh, Concept::shin, Concept::knee, Concept::ankle, Concept::foot}))
        return WornLimb::leg;
    return WornLimb::none;
}

// A sleeve beside the arm, both of them meshes without a skin: worn, and no part of the arm. Trousers beside arms are
// all the legs that there are, and a shirt is the trunk.
void leaveLimbsToWearers(RigFeatures& rig) {
    const auto isMesh = [&](int joint) { return rig.rigidPart[joint] && rig.children[joint].empty(); };
    const auto isCloth = [&](int joint) { return saysConcept(rig.names[joint], Concept::cloth); };
    for (const std::vector<int>& children : rig.children) {
        std::vector<std::pair<Side, WornLimb>> limbs;  // few, each once
        const auto wornBy = [&](int joint) { return std::pair{rig.names[joint].side, wornLimbOf(rig.names[joint])}; };
        for (const int joint : children) {
            if (!isMesh(joint) || !rig.names[joint].meaningful || isCloth(joint)) continue;
            const auto limb = wornBy(joint);
            if (std::find(limbs.begin(), limbs.end(), limb) == limbs.end()) limbs.push_back(limb);
        }
        for (const int joint : children) {
            if (limbs.empty() || !isMesh(joint) || !isCloth(joint)) continue;
            const auto limb = wornBy(joint);
            if (limb.first == Side::center || limb.second == WornLimb::none) continue;
            if (std::find(limbs.begin(), limbs.end(), limb) == limbs.end()) continue;
            rig.names[joint].parts.values.fill(kOfOtherPart);
            rig.names[joint].helper = true;
        }
    }
}

// What moves nothing itself, below a head and named as one: where a helmet or one of several heads is put on.
void leaveNameToHead(RigFeatures& rig) {
    const auto isPart = [&](int child) { return rig.rigidPart[child] && rig.children[child].empty(); };
    for (int joint = 0; joint < rig.count(); ++joint) {
        const int parent = rig.parents[joint];
        if (parent == kNoJoint || rig.directWeight[joint] > 0.0F) continue;
        if (!std::all_of(rig.children[joint].begin(), rig.children[joint].end(), isPart)) continue;
        NameEvidence& name = rig.names[joint];
        if (rig.names[parent].helper || rig.names[parent].parts[Part::head] < kSurely) continue;
        if (name.parts[Part::head] < kSurely) continue;
        name.parts.values.fill(kOfOtherPart);
        name.helper = true;
    }
}

// "Arm 1, Arm 2, Arm 3": where one chain calls three joints or more by the same word for a limb, the word tells the
// limb and no part of it.
void flattenNumberedLimbs(RigFeatures& rig) {
    // A name that stands twice is that of a copy of the whole skeleton.
    std::map<std::pair<Side, std::vector<std::string>>, std::set<std::vector<int>>> numbers;
    for (const NameEvidence& name : rig.names)
        numbers[{name.side, name.words}].insert(name.numbers);
    for (int joint = 0; joint < rig.count(); ++joint) {
        const NameEvidence& name = rig.names[joint];
        if (!name.bareLimb || name.helper || saysConcept(name, Concept::hand) || saysConcept(name, Concept::foot))
            continue;
        if (numbers[{name.side, name.words}].size() < 3) continue;
        const bool arm = saysConcept(name, Concept::arm);
        for (const Part part : arm ? std::array{Part::clavicle, Part::upperArm, Part::lowerArm, Part::hand}
                                   : std::array{Part::upperLeg, Part::lowerLeg, Part::foot, Part::toes})
            rig.names[joint].parts[part] = kSomeLimb;
    }
}

// "Arm, Arm1, Arm2": bones of a biped whose language has one word for collarbone and arm. Where the first is far
// shorter than the second, or shorter and a hand hangs on the third, they are the clavicle, the upper arm and the
// forearm; not below a bone that is the clavicle by its name.
void readCountedArms(RigFeatures& rig) {
    constexpr float kShort = 0.6F;  // of the second
    const auto nextOf = [&](int joint, int number) {
        std::vector<int> numbers = rig.names[joint].numbers;
        if (number > 1) numbers.pop_back();
        numbers.push_back(number);
        for (const int child : rig.children[joint]) {
            const NameEvidence& name = rig.names[child];
            if (name.bareLimb && name.side == rig.names[joint].side && name.words == rig.names[joint].words &&
                name.numbers == numbers)
                return child;
        }
        return kNoJoint;
    };
    const auto hasClavicleAbove = [&](int joint) {
        const Side side = rig.names[joint].side;
        for (int above = rig.parents[joint]; above != kNoJoint; above = rig.parents[above])
            if (rig.names[above].side == side && rig.names[above].parts[Part::clavicle] >= kMaybe) return true;
        return false;
    };
    for (int first = 0; first < rig.count(); ++first) {
        const NameEvidence& name = rig.names[first];
        if (!name.bareLimb || name.side == Side::center || name.parts[Part::upperArm] <= 0.0F) continue;
        const int second = nextOf(first, 1);
        const int third = second != kNoJoint ? nextOf(second, 2) : kNoJoint;
        if (third == kNoJoint) continue;
        const auto isHand = [&](int child) { return rig.names[child].parts[Part::hand] >= kSurely; };
        const bool hand = std::any_of(rig.children[third].begin(), rig.children[third].end(), isHand);
        const float firstLength = glm::distance(rig.positions[first], rig.positions[second]);
        const float secondLength = glm::distance(rig.positions[second], rig.positions[third]);
        if (firstLength > (hand ? 1.0F : kShort) * secondLength || hasClavicleAbove(first)) continue;
        for (const auto& [joint, part] :
             {std::pair{first, Part::clavicle}, std::pair{second, Part::upperArm}, std::pair{third, Part::lowerArm}}) {
            rig.names[joint].bareLimb = false;
            rig.names[joint].parts.values.fill(kSurelyNot);
            rig.names[joint].parts[part] = kSurely;
        }
    }
}

// Whether more of a limb lies above a joint than below it, down to `end`: on joints of its own, that carry nothing of
// the other side.
bool isBelowMostOfLimb(const RigFeatures& rig, int top, int end) {
    const Side other = rig.names[top].side == Side::left ? Side::right : Side::left;
    const auto isOfLimb = [&](int above) {
        const PartScores& parts = rig.names[above].parts;
        for (const Part trunk : {Part::hips, Part::trunk, Part::chest})
            if (parts[trunk] >= kMaybe) return false;
        for (int joint = 0; joint < rig.count(); ++joint)
            if (rig.names[joint].side == other && rig.isAncestorOrSelf(above, joint)) return false;
        return true;
    };
    int start = top;
    while (rig.parents[start] != kNoJoint && isOfLimb(rig.parents[start]))
        start = rig.parents[start];
    return glm::distance(rig.positions[start], rig.positions[top]) >
           glm::distance(rig.positions[top], rig.positions[end]);
}

// "foot 1, foot 2, foot 3" in one chain, below nothing that is named as the limb's start: many a language has one word
// for foot and leg, and one for hand and arm. Not a foot and its toes below bones without names, nor a hand and several
// fingers.
void readEndsAsLimbs(RigFeatures& rig) {
    constexpr int kFewest = 3;
    struct Limb {
        Part end;
        std::array<Part, 3> parts;
    };
    const auto alike = [&](int a, int b) {
        return rig.names[a].side == rig.names[b].side && rig.names[a].words == rig.names[b].words;
    };
    for (const Limb& limb : {Limb{Part::hand, {Part::upperArm, Part::lowerArm, Part::hand}},
                             Limb{Part::foot, {Part::upperLeg, Part::lowerLeg, Part::foot}}}) {
        for (int top = 0; top < rig.count(); ++top) {
            if (rig.names[top].helper || rig.names[top].parts[limb.end] < kSurely) continue;
            if (rig.parents[top] != kNoJoint && alike(rig.parents[top], top)) continue;
            std::vector<int> chain{top};
            bool branches = false;
            for (std::size_t at = 0; at < chain.size(); ++at) {
                const std::vector<int>& below = rig.children[chain[at]];
                const auto isNext = [&](int child) { return alike(child, top); };
                const auto next = std::find_if(below.begin(), below.end(), isNext);
                if (next == below.end()) continue;
                branches = branches || std::any_of(next + 1, below.end(), isNext);
                chain.push_back(*next);
            }
            if (branches || static_cast<int>(chain.size()) < kFewest) continue;
            if (isBelowMostOfLimb(rig, top, chain[kFewest - 1])) continue;
            bool begunAbove = false;
            for (int above = rig.parents[top]; above != kNoJoint; above = rig.parents[above]) {
                const PartScores& parts = rig.names[above].parts;
                begunAbove = begunAbove || parts[limb.parts[0]] > kMaybe || parts[limb.parts[1]] > kMaybe;
            }
            if (begunAbove) continue;
            const int shoulder = rig.parents[top];
            if (limb.end == Part::hand && shoulder != kNoJoint && rig.names[shoulder].parts[Part::clavicle] >= kMaybe) {
                rig.names[shoulder].parts[Part::clavicle] = kSurely;
                rig.names[shoulder].parts[Part::upperArm] = kSurelyNot;
            }
            for (std::size_t place = 0; place < chain.size(); ++place) {
                rig.names[chain[place]].bareLimb = true;
                PartScores& parts = rig.names[chain[place]].parts;
                parts[limb.end] = kSurelyNot;
                for (std::size_t part = 0; part < limb.parts.size(); ++part)
                    parts[limb.parts[part]] = part == place ? kMaybe : kRatherNot;
                if (place >= limb.parts.size() && limb.end == Part::foot) parts[Part::toes] = kMaybe;
            }
        }
    }
}

// "arm_end": a tip, unless something of the figure goes on below it. Then it is where the limb ends: hand or foot.
void readLimbEnds(RigFeatures& rig) {
    constexpr float kEndOfLimb = 3.0F;
    const auto says = [&](int joint, Concept meaning) { return saysConcept(rig.names[joint], meaning); };
    for (int joint = 0; joint < rig.count(); ++joint) {
        NameEvidence& name = rig.names[joint];
        if (!name.bareLimb || !says(joint, Concept::end)) continue;
        const auto goesOn = [&](int child) { return rig.carriesSkin(child) && !says(child, Concept::end); };
        if (!std::any_of(rig.children[joint].begin(), rig.children[joint].end(), goesOn)) continue;
        name.parts.values.fill(kSurelyNot);
        name.parts[says(joint, Concept::arm) ? Part::hand : Part::foot] = kEndOfLimb;
        name.helper = false;
    }
}

// What hangs on a weapon is a part of it. A joint that parts of the body hang on is none, whatever its name says.
void readHeldThings(RigFeatures& rig) {
    const auto isOfBody = [&](int joint) {
        const auto& parts = rig.names[joint].parts.values;
        return std::any_of(parts.begin(), parts.end(), [](float score) { return score >= kMaybe; });
    };
    std::vector<bool> carriesBody(rig.names.size(), false);
    for (int joint = rig.count() - 1; joint >= 0; --joint) {
        carriesBody[joint] = carriesBody[joint] || isOfBody(joint);
        if (rig.parents[joint] != kNoJoint && carriesBody[joint]) carriesBody[rig.parents[joint]] = true;
    }
    for (int joint = 0; joint < rig.count(); ++joint) {
        const int parent = rig.parents[joint];
        const bool onHeld = parent != kNoJoint && rig.names[parent].held;
        rig.names[joint].held = !carriesBody[joint] && (rig.names[joint].held || onHeld);
        if (onHeld && rig.names[joint].held) rig.names[joint].parts.values.fill(kOfOtherPart);
    }
}

}  // namespace

void readNamesInTree(RigFeatures& rig) {
    readEndsAsLimbs(rig);
    readNamesOfEnds(rig);
    readNumberedEnds(rig);
    readCountedArms(rig);
    readForearmsAboveArms(rig);
    readShouldersAsArms(rig);
    readNamesInChains(rig);
    readFlatShoulders(rig);
    leaveNamesToPivots(rig);
    leaveBlocksToGroups(rig);
    leaveLimbsToWearers(rig);
    leaveNameToHead(rig);
    flattenNumberedLimbs(rig);
    readLimbEnds(rig);
    readHeldThings(rig);
}

}  // namespace lutka::animation
