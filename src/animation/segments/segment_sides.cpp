#include "animation/segments/segment_sides.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <string_view>

#include "animation/humanoid/mirror_planes.hpp"

namespace lutka::animation {
namespace {

constexpr float kPairApart = 0.03F;     // of the size, between a joint and its counterpart's mirror image
constexpr float kInTheMiddle = 0.02F;   // of the size, from the plane
constexpr float kRounding = 1e-5F;      // of the size: of places in a file, through units and rotations
constexpr float kSteepestPlane = 0.3F;  // of the normal's y: a mirror plane stands upright
constexpr float kLeastAgreement = 0.3F;

bool hasWord(const NameEvidence& name, std::initializer_list<std::string_view> words) {
    return std::any_of(name.words.begin(), name.words.end(), [&](const std::string& word) {
        return std::find(words.begin(), words.end(), word) != words.end();
    });
}

std::optional<MirrorPlane> uprightPlane(const RigFeatures& rig) {
    for (const MirrorPlane& plane : findMirrorPlanes(rig)) {
        if (std::abs(plane.normal.y) < kSteepestPlane && plane.agreement >= kLeastAgreement) return plane;
    }
    return std::nullopt;
}

// From tail and hips to head and neck, level; zero where no name tells.
vec3 headingByNames(const RigFeatures& rig) {
    vec3 front(0);
    vec3 back(0);
    int fronts = 0;
    int backs = 0;
    for (int joint = 0; joint < rig.count(); ++joint) {
        const NameEvidence& name = rig.names[joint];
        if (hasWord(name, {"head", "jaw", "neck", "snout", "skull", "beak"})) {
            front += rig.positions[joint];
            ++fronts;
        } else if (name.tail || hasWord(name, {"tail", "pelvis", "hips", "hip"})) {
            back += rig.positions[joint];
            ++backs;
        }
    }
    if (fronts == 0 || backs == 0) return vec3(0);
    const vec3 way = front / static_cast<float>(fronts) - back / static_cast<float>(backs);
    return {way.x, 0, way.z};
}

// The rotation into the standard stance, exactly none where the rig stands in it.
quat stanceOf(const RigFeatures& rig, const std::optional<MirrorPlane>& plane, float size) {
    const vec3 heading = headingByNames(rig);
    const bool told = glm::length(heading) > 0.05F * size;
    vec3 ahead = told ? glm::normalize(heading) : vec3(0, 0, 1);
    if (plane) {
        const vec3 across = glm::normalize(vec3(plane->normal.x, 0, plane->normal.z));
        const vec3 along = glm::cross(across, vec3(0, 1, 0));
        // A front across the mirror plane is none.
        const float forward = glm::dot(along, ahead);
        ahead = forward < 0.0F ? -along : along;
    }
    constexpr float kSame = 0.02F;
    if (glm::distance(ahead, vec3(0, 0, 1)) < kSame) return {1, 0, 0, 0};
    const vec3 left = glm::cross(vec3(0, 1, 0), ahead);
    return glm::conjugate(rotationFromXY(left, vec3(0, 1, 0)));
}

class Sides {
  public:
    Sides(const RigFeatures& rig, float size, const quat& standardFromModel, float middle,
          std::vector<Segment>& segments)
        : rig_(rig), size_(size), standard_(standardFromModel), middle_(middle), segments_(segments) {}

    void findCounterparts() {
        for (int segment = 0; segment < count(); ++segment) {
            if (segments_[segment].mirror < 0) pair(segment);
        }
        for (int segment = 0; segment < count(); ++segment) {
            Segment& own = segments_[segment];
            if (own.mirror < 0 && std::abs(place(segment).x) < kInTheMiddle * size_ && parentInMiddle(segment))
                own.mirror = segment;
        }
    }

    void tellKinds() {
        for (int segment = 0; segment < count(); ++segment)
            segments_[segment].kind = kindOf(segment);
    }

  private:
    [[nodiscard]] int count() const { return static_cast<int>(segments_.size()); }
    [[nodiscard]] vec3 place(int segment) const {
        const vec3 at = standard_ * rig_.positions[segments_[segment].joint];
        return {at.x - middle_, at.y, at.z};
    }
    [[nodiscard]] bool parentInMiddle(int segment) const {
        const int parent = segments_[segment].parent;
        return parent < 0 || segments_[parent].mirror == parent;
    }

    // Their parents are counterparts, or one and the same in the middle.
    [[nodiscard]] bool hangAlike(int a, int b) const {
        const int above = segments_[a].parent;
        const int other = segments_[b].parent;
        return above == other || (above >= 0 && segments_[above].mirror == other);
    }

    [[nodiscard]] bool namedAlike(int a, int b) const {
        const NameEvidence& own = rig_.names[segments_[a].joint];
        const NameEvidence& other = rig_.names[segments_[b].joint];
        return own.side != Side::center && other.side != Side::center && own.side != other.side &&
               own.words == other.words && own.numbers == other.numbers;
    }

    // How far aside what hangs on a segment's joint is, where that stands in the middle: of hips that have a joint for
    // each leg.
    [[nodiscard]] float asideBelow(int segment) const {
        const int top = segments_[segment].joint;
        const float own = place(segment).x;
        if (std::abs(own) > kInTheMiddle * size_) return own;
        float sum = 0.0F;
        int below = 0;
        for (int joint = 0; joint < rig_.count(); ++joint) {
            if (joint == top || !rig_.isAncestorOrSelf(top, joint) || !rig_.carriesSkin(joint)) continue;
            sum += (standard_ * rig_.positions[joint]).x - middle_;
            ++below;
        }
        return below > 0 ? sum / static_cast<float>(below) : own;
    }

    // The signs of places that differ from zero by rounding tell no sides.
    [[nodiscard]] bool acrossTheMiddle(float x, float otherX) const {
        return x * otherX < 0.0F && std::min(std::abs(x), std::abs(otherX)) > kRounding * size_;
    }

    // The likeliest counterpart of a segment that has none: by its place across the plane, else by its name.
    void pair(int segment) {
        int best = -1;
        float least = kPairApart * size_;
        const vec3 own = place(segment);
        bool left = own.x > 0.0F;
        for (int other = segment + 1; other < count(); ++other) {
            if (segments_[other].mirror >= 0 || !hangAlike(segment, other)) continue;
            const vec3 at = place(other);
            float apart = glm::distance(vec3(-own.x, own.y, own.z), at);
            const bool alike = namedAlike(segment, other);
            if (alike) apart = std::min(apart, 0.5F * kPairApart * size_);
            const float x = alike ? asideBelow(segment) : own.x;
            if (!acrossTheMiddle(x, alike ? asideBelow(other) : at.x) || apart >= least) continue;
            least = apart;
            best = other;
            left = x > 0.0F;
        }
        if (best < 0) return;
        segments_[segment].mirror = best;
        segments_[best].mirror = segment;
        segments_[segment].side = left ? Side::left : Side::right;
        segments_[best].side = left ? Side::right : Side::left;
    }

    [[nodiscard]] Segment::Kind kindOf(int segment) const {
        const Segment& own = segments_[segment];
        if (own.parent < 0) return Segment::Kind::trunk;
        if (own.mirror < 0 || own.mirror == segment)
            return carriesLimb(segment) ? Segment::Kind::trunk : Segment::Kind::chain;
        const Segment& above = segments_[own.parent];
        const bool fromMiddle = above.mirror < 0 || above.mirror == own.parent;
        return fromMiddle ? Segment::Kind::limbRoot : Segment::Kind::limb;
    }

    // Whether a pair hangs on it, or on something in the middle below it.
    [[nodiscard]] bool carriesLimb(int segment) const {
        for (int below = segment + 1; below < count(); ++below) {
            if (segments_[below].parent != segment) continue;
            const bool paired = segments_[below].mirror >= 0 && segments_[below].mirror != below;
            if (paired || carriesLimb(below)) return true;
        }
        return false;
    }

    const RigFeatures& rig_;
    float size_;
    quat standard_;
    float middle_;
    std::vector<Segment>& segments_;
};

}  // namespace

quat findSides(const RigFeatures& rig, float size, std::vector<Segment>& segments) {
    const std::optional<MirrorPlane> plane = uprightPlane(rig);
    const quat standard = stanceOf(rig, plane, size);
    if (plane) {
        Sides sides(rig, size, standard, (standard * plane->middle).x, segments);
        sides.findCounterparts();
        sides.tellKinds();
        return standard;
    }
    for (Segment& segment : segments)
        segment.kind = segment.parent < 0 ? Segment::Kind::trunk : Segment::Kind::chain;
    return standard;
}

void pairSegments(const RigFeatures& rig, float size, const quat& standardFromModel, float middle,
                  std::vector<Segment>& segments) {
    Sides(rig, size, standardFromModel, middle, segments).findCounterparts();
}

void orderSegments(std::vector<Segment>& segments) {
    std::vector<std::vector<int>> children(segments.size());
    std::vector<int> pending;
    for (int i = static_cast<int>(segments.size()); i-- > 0;) {
        if (segments[i].parent >= 0)
            children[segments[i].parent].push_back(i);  // last first, as a stack wants them
        else
            pending.push_back(i);
    }
    std::vector<int> order;
    while (!pending.empty()) {
        const int next = pending.back();
        pending.pop_back();
        order.push_back(next);
        std::vector<int>& below = children[next];
        std::stable_partition(below.begin(), below.end(),
                              [&](int child) { return segments[child].side == Side::right; });
        pending.insert(pending.end(), below.begin(), below.end());
    }
    std::vector<int> place(segments.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        place[order[i]] = static_cast<int>(i);
    std::vector<Segment> ordered;
    ordered.reserve(segments.size());
    for (const int index : order) {
        Segment& segment = ordered.emplace_back(segments[index]);
        if (segment.parent >= 0) segment.parent = place[segment.parent];
        if (segment.mirror >= 0) segment.mirror = place[segment.mirror];
    }
    segments = std::move(ordered);
}

}  // namespace lutka::animation
