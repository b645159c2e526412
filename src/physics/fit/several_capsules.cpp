#include "physics/fit/several_capsules.hpp"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <tuple>

#include "physics/fit/skin_sample.hpp"

namespace lutka::physics {
namespace {

constexpr std::size_t kMostUnionPoints = 250;
constexpr float kUnionClearly = 0.65F;  // of the distance that one capsule leaves
constexpr float kThirdClearly = 0.8F;   // of the distance that two leave
constexpr float kShareWon = 0.1F;       // of the skin
constexpr float kWellCovered = 0.97F;   // of the skin: nothing to win
constexpr float kVolumeLost = 0.02F;    // of what the skin encloses, at most
constexpr int kAlongX = 0;
constexpr int kAlongY = 1;

// A capsule along one of the axes, or a pair of them that are mirror images in the plane x = 0.
struct Member {
    vec3 center{0, 0, 0};
    int axis = kAlongY;
    float half = 0.0F;
    float radius = 0.0F;
    bool isPair = false;
};
using Members = std::vector<Member>;

vec3 acrossMiddle(const vec3& point) {
    return {-point.x, point.y, point.z};
}

// Distance from the surface of a capsule about `center`; negative inside.
float distanceFrom(const Member& member, const vec3& center, const vec3& point) {
    vec3 apart = point - center;
    apart[member.axis] = std::max(0.0F, std::abs(apart[member.axis]) - member.half);
    return glm::length(apart) - member.radius;
}

float distanceFrom(const Members& members, const vec3& point) {
    float least = 1e9F;
    for (const Member& member : members) {
        least = std::min(least, distanceFrom(member, member.center, point));
        if (member.isPair) least = std::min(least, distanceFrom(member, acrossMiddle(member.center), point));
    }
    return least;
}

class UnionSearch {
  public:
    UnionSearch(const std::vector<SkinPoint>& points, const CapsuleBounds& bounds)
        : bounds_(bounds), sample_(points, inverse(bounds.standardFromAxes), kMostUnionPoints) {
        std::tie(low_, high_) = sample_.quantiles(0.01F, 0.99F);
    }

    template <class Shape>
    [[nodiscard]] float cost(const Shape& shape) const {
        return sample_.cost(bounds_.cutoff, shape);
    }

    template <class Shape>
    [[nodiscard]] float shareNear(const Shape& shape) const {
        return sample_.shareWithin(bounds_.nearM, shape);
    }

    // Of what lies between the skin and the upright through its middle: capsules that cling to the skin may leave the
    // body hollow.
    template <class Shape>
    [[nodiscard]] float shareInside(const Shape& shape) const {
        constexpr std::array kWays{0.2F, 0.4F, 0.6F, 0.8F};  // from the upright; a way's share grows with it
        vec3 middle(0);
        float area = 0.0F;
        for (const SkinPoint& point : sample_.points()) {
            middle += point.area * point.position;
            area += point.area;
        }
        middle /= std::max(area, 1e-12F);
        float inside = 0.0F;
        float whole = 0.0F;
        for (const SkinPoint& point : sample_.points()) {
            const vec3 within(middle.x, point.position.y, middle.z);
            for (const float way : kWays) {
                whole += point.area * way;
                if (distanceFrom(shape, glm::mix(within, point.position, way)) <= 0.0F) inside += point.area * way;
            }
        }
        return whole > 0.0F ? inside / whole : 0.0F;
    }

    // The one along an axis that fills the skin's box.
    [[nodiscard]] Member filling(int axis) const {
        const vec3 half = 0.5F * (high_ - low_);
        Member member;
        member.axis = axis;
        member.center = 0.5F * (low_ + high_);
        member.radius = 0.5F * (half[(axis + 1) % 3] + half[(axis + 2) % 3]);
        member.half = half[axis] - member.radius;
        return member;
    }

    // `members` and one along `axis` where most skin lies outside of them.
    [[nodiscard]] Members withAnother(Members members, int axis, bool isPair) const {
        vec3 sum(0);
        float weight = 0.0F;
        for (const SkinPoint& point : sample_.points()) {
            const float outside = point.area * std::max(0.0F, distanceFrom(members, point.position));
            const bool otherSide = isPair && point.position.x < 0.0F;
            sum += outside * (otherSide ? acrossMiddle(point.position) : point.position);
            weight += outside;
        }
        Member member;
        member.axis = axis;
        member.center = weight > 0.0F ? sum / weight : members.front().center;
        member.radius = 0.6F * members.front().radius;
        member.half = axis == members.front().axis ? members.front().half : 0.0F;
        member.isPair = isPair;
        members.push_back(member);
        return run(std::move(members));
    }

    [[nodiscard]] Members run(Members best) const {
        for (Member& member : best)
            settle(member);
        float least = cost(best);
        const vec3 size = high_ - low_;
        float step = 0.12F * std::max({size.x, size.y, size.z});
        const float finest = 0.02F * step;
        for (; step > finest; step *= 0.5F) {
            constexpr int kSweeps = 6;
            for (int sweep = 0; sweep < kSweeps; ++sweep)
                if (!improve(best, least, step)) break;
        }
        return best;
    }

    [[nodiscard]] std::vector<Capsule> inStandard(const Members& members) const {
        std::vector<Capsule> capsules;
        for (const Member& member : members) {
            vec3 half(0);
            half[member.axis] = member.half;
            const auto add = [&](const vec3& center) {
                capsules.push_back({bounds_.standardFromAxes * (center - half),
                                    bounds_.standardFromAxes * (center + half), member.radius});
            };
            add(member.center);
            if (member.isPair) add(acrossMiddle(member.center));
        }
        return capsules;
    }

  private:
    // One sweep over all parameters; whether any step helped.
    bool improve(Members& best, float& least, float step) const {
        bool better = false;
        for (std::size_t i = 0; i < best.size(); ++i) {
            for (int move = 0; move < 10; ++move) {
                Members trial = best;
                Member& member = trial[i];
                const std::array<float*, 5> parameters{&member.radius, &member.half, &member.center.x, &member.center.y,
                                                       &member.center.z};
                *parameters[move / 2] += move % 2 == 0 ? step : -step;
                settle(member);
                const float trialCost = cost(trial);
                if (trialCost >= least) continue;
                least = trialCost;
                best = std::move(trial);
                better = true;
            }
        }
        return better;
    }

    // Keeps a capsule with the skin: it may stand out of the skin's box by a tenth of its radius, so that it does not
    // slip through where the part is open towards its neighbours.
    void settle(Member& member) const {
        const vec3 room = 0.5F * (high_ - low_);
        member.radius = std::clamp(member.radius, bounds_.smallestRadius, bounds_.largestRadius);
        const float thinnest = std::min({room.x, room.y, room.z});
        member.radius = std::max(std::min(member.radius, 1.1F * thinnest), bounds_.smallestRadius);
        const float spare = 0.1F * member.radius;
        member.half = std::clamp(member.half, 0.0F, std::max(0.0F, room[member.axis] + spare - member.radius));
        for (int axis = 0; axis < 3; ++axis) {
            const float reach = member.radius - spare + (axis == member.axis ? member.half : 0.0F);
            const float slack = std::max(0.0F, room[axis] - reach);
            const float middle = 0.5F * (low_[axis] + high_[axis]);
            member.center[axis] = std::clamp(member.center[axis], middle - slack, middle + slack);
        }
        if (!bounds_.symmetric) return;
        if (!member.isPair)
            member.center.x = 0.0F;
        else
            member.center.x = std::max(member.center.x, 0.0F);
    }

    CapsuleBounds bounds_;
    SkinSample sample_;  // in the axes
    vec3 low_{0, 0, 0};
    vec3 high_{0, 0, 0};
};

}  // namespace

std::optional<std::vector<Capsule>> fitSeveralCapsules(const std::vector<SkinPoint>& points, const Capsule& single,
                                                       const CapsuleBounds& bounds, int most) {
    const UnionSearch search(points, bounds);
    const RigidTransform axesFromStandard = inverse(bounds.standardFromAxes);
    const Capsule alone{axesFromStandard * single.start, axesFromStandard * single.end, single.radius};
    const float near = search.shareNear(alone);
    if (near + kShareWon > kWellCovered) return std::nullopt;
    const float inside = search.shareInside(alone);
    float limit = kUnionClearly * search.cost(alone);  // what a union may cost at most
    float least = limit;                               // the best one's cost
    Members best;
    const auto consider = [&](Members members) {
        const float cost = search.cost(members);
        if (cost > std::min(limit, least) || search.shareNear(members) < near + kShareWon) return;
        if (search.shareInside(members) < inside - kVolumeLost) return;
        best = std::move(members);
        least = cost;
    };
    for (const int main : {kAlongY, kAlongX}) {
        for (int axis = 0; axis < 3; ++axis)
            consider(search.withAnother({search.filling(main)}, axis, false));
    }
    const Members two = best;
    if (!two.empty()) limit = kThirdClearly * least;
    for (const int main : {kAlongY, kAlongX}) {
        for (int axis = 0; axis < 3; ++axis) {
            if (most < 3) break;
            if (bounds.symmetric && axis != kAlongX) consider(search.withAnother({search.filling(main)}, axis, true));
            if (!two.empty()) consider(search.withAnother(two, axis, false));
        }
    }
    if (best.empty()) return std::nullopt;
    std::vector<Capsule> capsules = search.inStandard(best);
    const bool pairs = std::any_of(best.begin(), best.end(), [](const Member& member) { return member.isPair; });
    const auto volume = [](const Capsule& c) {
        return c.radius * c.radius * (4.0F / 3.0F * c.radius + glm::distance(c.start, c.end));
    };
    // Of a symmetric body the one in the middle comes first, whatever its size.
    if (!pairs) {
        std::stable_sort(capsules.begin(), capsules.end(),
                         [&](const Capsule& a, const Capsule& b) { return volume(a) > volume(b); });
    }
    return capsules;
}

}  // namespace lutka::physics
