#include "physics/fit/box_search.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <utility>

#include "physics/collision/shape_distance.hpp"
#include "physics/fit/fit_shapes.hpp"
#include "physics/fit/skin_sample.hpp"

namespace lutka::physics {
namespace {

constexpr std::size_t kMostBoxPoints = 400;
constexpr float kProtrusion = 1.5F;           // of the weight of skin outside: a round part has a box's corners
constexpr float kBoxClearly = 0.5F;           // of the distance that the capsule leaves
constexpr float kBoxNear = 0.9F;              // of the skin
constexpr float kBoxItself = 0.25F;           // of that distance: the skin is a box
constexpr float kBoxRounded = 0.12F;          // of its thinnest half: what a box leaves of a round part is more
constexpr float kHopeless = 1.5F;             // of that distance, by the box of quantiles
constexpr float kBoxWon = 0.15F;              // of the skin, that the capsule leaves
constexpr float kBoxThickness = 0.4F;         // of its second side: plates slip through one another
constexpr int kTurns = 18;                    // in a quarter: every five degrees
constexpr float kUprightWorthTrying = 0.98F;  // of the cost along the limb, by the boxes of quantiles
constexpr float kUprightClearly = 0.7F;       // of the cost along the limb
constexpr float kBoxTail = 0.01F;             // of the skin, that a box of quantiles leaves out on each side

// A box about `center` along the axes of the points.
struct BoxTrial {
    vec3 center{0, 0, 0};
    vec3 half{0, 0, 0};
};

float distanceFrom(const BoxTrial& box, const vec3& point) {
    return distanceFromBox(point - box.center, box.half);
}

bool isPlate(vec3 half) {
    std::sort(&half.x, &half.x + 3);
    return half.x < kBoxThickness * half.y;
}

class BoxSearch {
  public:
    BoxSearch(const std::vector<SkinPoint>& points, const quat& standardFromAxes, const BoxBounds& bounds)
        : bounds_(bounds),
          standardFromAxes_(standardFromAxes),
          sample_(points, {glm::conjugate(standardFromAxes), vec3(0)}, kMostBoxPoints) {}

    [[nodiscard]] BoxTrial boxOfQuantiles() const {
        const auto [low, high] = sample_.quantiles(kBoxTail, 1.0F - kBoxTail);
        return settled({0.5F * (low + high), 0.5F * (high - low)});
    }

    template <class Shape>
    [[nodiscard]] float cost(const Shape& shape) const {
        return sample_.cost(bounds_.cutoff, shape, kProtrusion);
    }

    template <class Shape>
    [[nodiscard]] float shareNear(const Shape& shape) const {
        return sample_.shareWithin(bounds_.nearM, shape);
    }

    // A capsule in the search's axes.
    [[nodiscard]] Capsule inAxes(const Capsule& capsule) const {
        const quat axesFromStandard = glm::conjugate(standardFromAxes_);
        return {axesFromStandard * capsule.start, axesFromStandard * capsule.end, capsule.radius};
    }

    [[nodiscard]] BoxTrial run() const {
        BoxTrial best = boxOfQuantiles();
        float least = cost(best);
        constexpr int kRounds = 6;
        constexpr int kSweeps = 4;
        float step = 0.1F * std::max({best.half.x, best.half.y, best.half.z});
        for (int round = 0; round < kRounds; ++round, step *= 0.5F) {
            for (int sweep = 0; sweep < kSweeps; ++sweep)
                if (!improve(best, least, step)) break;
        }
        return best;
    }

    [[nodiscard]] PlacedBox inStandard(const BoxTrial& box) const {
        return {{standardFromAxes_, standardFromAxes_ * box.center}, box.half};
    }

  private:
    // One sweep over all parameters; whether any step helped.
    bool improve(BoxTrial& best, float& least, float step) const {
        bool better = false;
        for (int move = 0; move < 12; ++move) {
            BoxTrial trial = best;
            vec3& part = move < 6 ? trial.center : trial.half;
            part[move / 2 % 3] += move % 2 == 0 ? step : -step;
            trial = settled(trial);
            const float trialCost = cost(trial);
            if (trialCost >= least) continue;
            least = trialCost;
            best = trial;
            better = true;
        }
        return better;
    }

    [[nodiscard]] BoxTrial settled(BoxTrial box) const {
        box.half = glm::clamp(box.half, vec3(bounds_.smallestHalf), vec3(bounds_.largestHalf));
        if (!bounds_.symmetric) return box;
        vec3 middle = standardFromAxes_ * box.center;
        middle.x = bounds_.middleX;
        box.center = glm::conjugate(standardFromAxes_) * middle;
        return box;
    }

    BoxBounds bounds_;
    quat standardFromAxes_;
    SkinSample sample_;  // in the box's axes
};

// Of the turns about `turnAxis` the one whose box of quantiles is nearest.
std::pair<BoxSearch, float> nearestTurn(const std::vector<SkinPoint>& points, const quat& standardFromAxes,
                                        const BoxBounds& bounds) {
    std::optional<BoxSearch> nearest;
    float least = 0.0F;
    for (int turn = 0; turn < kTurns; ++turn) {
        const float angle = static_cast<float>(turn) * (0.5F * kPi / kTurns);
        BoxSearch search(points, standardFromAxes * glm::angleAxis(angle, bounds.turnAxis), bounds);
        const float cost = search.cost(search.boxOfQuantiles());
        if (nearest && cost >= least) continue;
        nearest = std::move(search);
        least = cost;
    }
    return {std::move(*nearest), least};
}

// Whether the skin is that box, and not the capsule.
bool standsForSkin(const BoxSearch& search, const BoxTrial& box, const Capsule& capsule) {
    const Capsule other = search.inAxes(capsule);
    const float near = search.shareNear(box);
    const float left = search.cost(box);
    const bool wins = near >= search.shareNear(other) + kBoxWon;
    const bool clearly = left <= (wins ? kBoxClearly : kBoxItself) * search.cost(other);
    const float thinnest = std::min({box.half.x, box.half.y, box.half.z});
    return clearly && left <= kBoxRounded * thinnest && near >= kBoxNear && !isPlate(box.half);
}

}  // namespace

std::optional<PlacedBox> fitBox(const std::vector<SkinPoint>& points, const Capsule& capsule, const BoxBounds& bounds) {
    const auto [along, least] = nearestTurn(points, bounds.standardFromAxes, bounds);
    // Most limbs are round: their box of quantiles is so much farther from the skin that no search makes it the nearer.
    if (least > kHopeless * along.cost(along.inAxes(capsule))) return std::nullopt;
    const BoxTrial box = along.run();
    if (!standsForSkin(along, box, capsule)) return std::nullopt;
    if (bounds.alsoUpright) {
        const auto [upright, uprightLeast] = nearestTurn(points, quat(1, 0, 0, 0), bounds);
        if (uprightLeast < kUprightWorthTrying * least) {
            const BoxTrial other = upright.run();
            if (upright.cost(other) < kUprightClearly * along.cost(box)) return upright.inStandard(other);
        }
    }
    return along.inStandard(box);
}

}  // namespace lutka::physics
