#include "animation/segments/appendages.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

#include "animation/humanoid/crowds.hpp"
#include "animation/segments/segment_sides.hpp"
#include "animation/segments/segment_tree.hpp"
#include "core/letter_case.hpp"

namespace lutka::animation {
namespace {

constexpr float kLeastReach = 0.035F;  // of the figure's longest extent
constexpr float kShortest = 0.03F;     // likewise, of a segment

// Vectors and not lists of initialisers: what such a list points to does not outlive the expression everywhere (clang).
struct KindWords {
    AppendageKind kind;
    std::vector<std::string_view> words;      // of a name, whole
    std::vector<std::string_view> fragments;  // anywhere in the name
};

// In this order: a ponytail is hair, a coat's tail is cape.
const std::array<KindWords, 7>& kindWords() {
    static const std::array<KindWords, 7> kWords{
        KindWords{AppendageKind::hair,
                  {"bang", "bangs", "braid", "fringe", "kami", "ahoge", "plait"},
                  {"hair", "ponytail", "pigtail", "twintail", "sidelock"}},
        KindWords{AppendageKind::cape, {"cape", "coat", "scarf", "mantle", "ribbon", "sash"}, {"cloak", "coattail"}},
        KindWords{AppendageKind::skirt, {"dress", "robe", "hakama", "kilt"}, {"skirt"}},
        KindWords{AppendageKind::tail, {"tail"}, {"tail_", "tail."}},
        KindWords{AppendageKind::ears, {"ear", "ears", "mimi"}, {}},
        KindWords{AppendageKind::wings, {"wing", "wings", "feather"}, {}},
        KindWords{AppendageKind::weapon,
                  {"gun", "axe", "staff", "bow", "knife", "blade", "spear", "club", "prop", "wand", "pistol", "mace"},
                  {"weapon", "sword", "rifle", "shield", "dagger", "hammer"}}};
    return kWords;
}

std::optional<AppendageKind> kindByName(const std::string& name, const NameEvidence& evidence) {
    const std::string lower = lowerCased(name);
    for (const KindWords& entry : kindWords()) {
        const bool word = std::any_of(evidence.words.begin(), evidence.words.end(), [&](const std::string& one) {
            return std::find(entry.words.begin(), entry.words.end(), one) != entry.words.end();
        });
        const bool part = std::any_of(entry.fragments.begin(), entry.fragments.end(), [&](std::string_view fragment) {
            return lower.find(fragment) != std::string::npos;
        });
        if (word || part) return entry.kind;
    }
    return std::nullopt;
}

class AppendageSearch {
  public:
    AppendageSearch(const Character& character, const HumanoidMap& map)
        : character_(character), map_(map), rig_(readRig(character, true)), measures_(measureRig(rig_)) {
        roleOf_.assign(static_cast<std::size_t>(rig_.count()), -1);
        holdsRole_.assign(static_cast<std::size_t>(rig_.count()), false);
        for (int index = 0; index < kRoleCount; ++index) {
            const int joint = map.jointOf(roleAt(index));
            if (joint == kNoJoint) continue;
            roleOf_[joint] = index;
            for (int at = joint; at != kNoJoint; at = rig_.parents[at])
                holdsRole_[at] = true;
        }
    }

    [[nodiscard]] std::vector<Appendage> find() const {
        std::vector<Appendage> found;
        for (int joint = 0; joint < rig_.count(); ++joint) {
            const int parent = rig_.parents[joint];
            if (holdsRole_[joint] || parent == kNoJoint) continue;
            // Below a part, or below an appendage that was too small itself: a hat's feather.
            const bool top = holdsRole_[parent] || isSkipped(parent);
            if (!top || isSkipped(joint)) continue;
            found.push_back({kindOf(joint), joint, jointsWithSkin(joint), partAbove(joint)});
        }
        return found;
    }

    [[nodiscard]] const RigFeatures& rig() const { return rig_; }
    [[nodiscard]] const RigMeasures& measures() const { return measures_; }

  private:
    [[nodiscard]] vec3 standing(int joint) const { return map_.standardFromModel * rig_.positions[joint]; }

    // The part whose joint is nearest above. What hangs on none (a hat on the root) is the part's whose joint its skin
    // lies nearest to (an armature of its own may stand at the origin); joints above the hips are theirs.
    [[nodiscard]] Role partAbove(int joint) const {
        for (int at = joint; at != kNoJoint; at = rig_.parents[at])
            if (roleOf_[at] >= 0) return roleAt(roleOf_[at]);
        if (holdsRole_[joint]) return Role::hips;
        const vec3 place = middleOfSkin(joint).value_or(rig_.positions[joint]);
        int nearest = kNoJoint;
        for (int other = 0; other < rig_.count(); ++other) {
            if (roleOf_[other] < 0) continue;
            const bool nearer = nearest == kNoJoint || glm::distance(rig_.positions[other], place) <
                                                           glm::distance(rig_.positions[nearest], place);
            if (nearer) nearest = other;
        }
        return nearest == kNoJoint ? Role::hips : roleAt(roleOf_[nearest]);
    }

    // Neither an appendage nor above a role's joint.
    [[nodiscard]] bool isSkipped(int joint) const {
        if (holdsRole_[joint]) return false;
        const NameEvidence& name = rig_.names[joint];
        const std::optional<AppendageKind> kind = kindByName(character_.skeleton.names[joint], name);
        if (!rig_.skinned || !rig_.carriesSkin(joint) || measures_.reach[joint] < kLeastReach * measures_.size)
            return true;
        if (kind) return false;
        if (name.face || name.helper || name.finger || isAlongLimb(joint)) return true;
        // Fingers and toes are parts of hands and feet; what reaches far beyond them is held.
        const Role part = partAbove(joint);
        const bool end = isEitherSide(part, Role::leftHand) || isEitherSide(part, Role::leftFoot) ||
                         isEitherSide(part, Role::leftToes);
        constexpr float kBeyondFingers = 0.2F;
        return end && measures_.reach[joint] < kBeyondFingers * measures_.size;
    }

    // Twist joints and muscles lie on the way from one part's joint to the next.
    [[nodiscard]] bool isAlongLimb(int joint) const {
        constexpr float kAside = 0.1F;
        const Role part = partAbove(joint);
        const int upper = map_.jointOf(part);
        if (upper == kNoJoint || sideOf(part) == Side::center) return false;
        for (int index = 0; index < kRoleCount; ++index) {
            const int lower = map_.jointOf(roleAt(index));
            if (lower == kNoJoint || parentRole(roleAt(index)) != part) continue;
            const vec3 way = rig_.positions[lower] - rig_.positions[upper];
            const float square = glm::dot(way, way);
            if (square <= 0.0F) continue;
            const vec3 offset = rig_.positions[joint] - rig_.positions[upper];
            const float along = glm::dot(offset, way) / square;
            const float aside = glm::length(offset - along * way);
            if (along > -0.1F && along < 1.1F && aside < kAside * std::sqrt(square)) return true;
        }
        return false;
    }

    [[nodiscard]] int jointsWithSkin(int top) const {
        int number = 0;
        for (int joint = 0; joint < rig_.count(); ++joint)
            number += rig_.isAncestorOrSelf(top, joint) && rig_.carriesSkin(joint) ? 1 : 0;
        return number;
    }

    [[nodiscard]] AppendageKind kindOf(int joint) const {
        for (int at = joint; at < rig_.count(); ++at) {
            if (!rig_.isAncestorOrSelf(joint, at)) continue;
            if (const auto named = kindByName(character_.skeleton.names[at], rig_.names[at])) return *named;
        }
        return kindByPlace(joint);
    }

    // Of what the joint and those below it move.
    [[nodiscard]] std::optional<vec3> middleOfSkin(int joint) const {
        vec3 sum(0);
        float number = 0.0F;
        for (const RigFeatures::Vertex& vertex : rig_.vertices) {
            if (!rig_.isAncestorOrSelf(joint, vertex.joint)) continue;
            sum += vertex.position;
            number += 1.0F;
        }
        return number > 0.0F ? std::optional<vec3>(sum / number) : std::nullopt;
    }

    // The middle of its skin, against the joint, in the standard stance's axes.
    [[nodiscard]] vec3 way(int joint) const {
        const std::optional<vec3> middle = middleOfSkin(joint);
        return middle ? map_.standardFromModel * *middle - standing(joint) : vec3(0);
    }

    [[nodiscard]] AppendageKind kindByPlace(int joint) const {
        constexpr float kMiddle = 0.03F;
        const Role part = partAbove(joint);
        const vec3 out = way(joint);
        const float length = std::max(glm::length(out), 1e-6F);
        const bool middle =
            std::abs(standing(joint).x - standing(map_.jointOf(Role::hips)).x) < kMiddle * measures_.size;
        if (isEitherSide(part, Role::leftHand)) return AppendageKind::weapon;
        if (part == Role::head || part == Role::neck) return AppendageKind::hair;
        if (part == Role::hips || isSpine(part)) {
            if (part == Role::hips && middle && out.z < -0.3F * length) return AppendageKind::tail;
            if (part == Role::hips && out.y < -0.5F * length) return AppendageKind::skirt;
            if (out.y < -0.5F * length && out.z < 0.0F) return AppendageKind::cape;
            if (!middle && std::abs(out.x) > 0.5F * length) return AppendageKind::wings;
        }
        return AppendageKind::other;
    }

    const Character& character_;
    const HumanoidMap& map_;
    RigFeatures rig_;
    RigMeasures measures_;
    std::vector<int> roleOf_;      // one a joint: index of its role, or -1
    std::vector<bool> holdsRole_;  // one a joint: it or one below it plays a role
};

// All branches behind each other.
std::vector<Segment> branches(const AppendageSearch& search, const Character& character,
                              std::span<const Appendage> wanted, float shortest) {
    std::vector<Segment> all;
    for (const Appendage& appendage : wanted) {
        const int first = static_cast<int>(all.size());
        std::vector<Segment> branch =
            segmentBranch(search.rig(), search.measures(), character.skeleton.names, appendage.joint, shortest);
        for (Segment& segment : branch) {
            if (segment.parent >= 0) segment.parent += first;
            segment.kind = appendage.kind == AppendageKind::weapon ? Segment::Kind::held : Segment::Kind::chain;
            all.push_back(std::move(segment));
        }
    }
    return all;
}

// The character without the crowds of things beside it, which hang on no part of the figure. The joints that play a
// role stay.
std::optional<WithoutCrowds> withoutCrowds(const Character& character, const HumanoidMap& map) {
    std::vector<int> kept;
    for (const auto& binding : map.roles)
        if (binding) kept.push_back(binding->joint);
    return leaveOutCrowds(character, kept);
}

HumanoidMap mapOf(const WithoutCrowds& few, HumanoidMap map) {
    for (auto& binding : map.roles)
        if (binding) binding->joint = few.placeOf(binding->joint);
    return map;
}

void makeNamesUnique(std::vector<Segment>& segments) {
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const std::string base = segments[i].name;
        const auto taken = [&] {
            return roleFromName(segments[i].name) ||
                   std::any_of(segments.begin(), segments.begin() + static_cast<std::ptrdiff_t>(i),
                               [&](const Segment& other) { return other.name == segments[i].name; });
        };
        for (int number = 2; taken(); ++number)
            segments[i].name = base + " " + std::to_string(number);
    }
}

// Of a character without crowds.
std::vector<Segment> segmentsOfWhole(const Character& character, const HumanoidMap& map,
                                     std::span<const AppendageKind> kinds, int mostSegments) {
    constexpr float kCoarser = 1.2F;
    const AppendageSearch search(character, map);
    std::vector<Appendage> wanted = search.find();
    std::erase_if(wanted,
                  [&](const Appendage& one) { return std::find(kinds.begin(), kinds.end(), one.kind) == kinds.end(); });
    const float size = search.measures().size;
    float shortest = kShortest * size;
    const auto most = static_cast<std::size_t>(mostSegments);
    std::vector<Segment> segments = branches(search, character, wanted, shortest);
    for (; segments.size() > most && shortest < size; shortest *= kCoarser)
        segments = branches(search, character, wanted, shortest);
    // One body each was too many still: the first ones have it.
    if (segments.size() > most) segments.resize(most);
    makeNamesUnique(segments);
    const int hips = map.jointOf(Role::hips);
    if (hips != kNoJoint)
        pairSegments(search.rig(), size, map.standardFromModel,
                     (map.standardFromModel * search.rig().positions[hips]).x, segments);
    orderSegments(segments);
    return segments;
}

}  // namespace

std::string_view appendageName(AppendageKind kind) {
    static constexpr std::array<std::string_view, 8> kNames{"tail",  "ears",  "hair",   "cape",
                                                            "skirt", "wings", "weapon", "other"};
    return kNames[static_cast<std::size_t>(kind)];
}

std::optional<AppendageKind> appendageNamed(std::string_view name) {
    for (const AppendageKind kind : kAppendageKinds)
        if (appendageName(kind) == name) return kind;
    return std::nullopt;
}

std::vector<Appendage> findAppendages(const Character& character, const HumanoidMap& map) {
    if (!map.humanoid) return {};
    const auto few = withoutCrowds(character, map);
    if (!few) return AppendageSearch(character, map).find();
    const HumanoidMap fewMap = mapOf(*few, map);
    std::vector<Appendage> found = AppendageSearch(few->character, fewMap).find();
    for (Appendage& appendage : found)
        appendage.joint = few->originalOf(appendage.joint);
    return found;
}

std::vector<Segment> appendageSegments(const Character& character, const HumanoidMap& map,
                                       std::span<const AppendageKind> kinds, int mostSegments) {
    if (!map.humanoid || kinds.empty() || mostSegments < 1) return {};
    const auto few = withoutCrowds(character, map);
    if (!few) return segmentsOfWhole(character, map, kinds, mostSegments);
    std::vector<Segment> segments = segmentsOfWhole(few->character, mapOf(*few, map), kinds, mostSegments);
    for (Segment& segment : segments) {
        segment.joint = few->originalOf(segment.joint);
        segment.end = few->originalOf(segment.end);
    }
    return segments;
}

}  // namespace lutka::animation
