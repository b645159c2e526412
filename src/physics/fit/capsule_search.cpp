#include "physics/fit/capsule_search.hpp"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

#include "core/quantile.hpp"
#include "physics/fit/fit_shapes.hpp"

namespace lutka::physics {
namespace {

constexpr std::size_t kMostPoints = 400;

}  // namespace

CapsuleSearch::CapsuleSearch(const std::vector<SkinPoint>& points, const RigidTransform& standardFromSearch,
                             float smallestRadius, float largestRadius, float cutoff)
    : sample_(points, inverse(standardFromSearch), kMostPoints),
      standardFromSearch_(standardFromSearch),
      smallestRadius_(smallestRadius),
      largestRadius_(largestRadius),
      cutoff_(cutoff) {}

float CapsuleSearch::cost(const CapsuleTrial& trial) const {
    return sample_.cost(cutoff_, trial);
}

float CapsuleSearch::cost(const Capsule& capsule) const {
    const vec3 start = toSearch(capsule.start);
    const vec3 end = toSearch(capsule.end);
    return cost(CapsuleTrial{0.5F * (start + end), 0.5F * glm::distance(start, end), capsule.radius});
}

Capsule CapsuleSearch::run(const CapsuleTrial& start, const std::function<void(CapsuleTrial&)>& settle) const {
    constexpr int kRounds = 6;
    constexpr int kSweepsPerRound = 4;
    const auto settled = [&](CapsuleTrial trial) {
        trial.radius = std::clamp(trial.radius, smallestRadius_, largestRadius_);
        trial.halfLength = std::max(0.0F, trial.halfLength);
        settle(trial);
        trial.radius = std::max(trial.radius, smallestRadius_);
        return trial;
    };
    CapsuleTrial best = settled(start);
    float least = cost(best);
    float step = 0.3F * best.radius;
    for (int round = 0; round < kRounds; ++round, step *= 0.5F) {
        for (int sweep = 0; sweep < kSweepsPerRound; ++sweep) {
            bool better = false;
            for (int move = 0; move < 10; ++move) {
                CapsuleTrial trial = best;
                const std::array<float*, 5> parameters{&trial.radius, &trial.halfLength, &trial.center.x,
                                                       &trial.center.y, &trial.center.z};
                *parameters[move / 2] += move % 2 == 0 ? step : -step;
                trial = settled(trial);
                const float trialCost = cost(trial);
                if (trialCost < least) {
                    least = trialCost;
                    best = trial;
                    better = true;
                }
            }
            if (!better) break;
        }
    }
    const vec3 half(0, best.halfLength, 0);
    return {standardFromSearch_ * (best.center - half), standardFromSearch_ * (best.center + half), best.radius};
}

float CapsuleSearch::radiusAboutAxis(float fromY, float toY) const {
    std::vector<SkinPoint> between;
    for (const SkinPoint& point : sample_.points()) {
        if (point.position.y >= fromY && point.position.y <= toY) between.push_back(point);
    }
    if (between.empty()) return smallestRadius_;
    return quantileOf(between, 0.5F, [](const SkinPoint& p) { return std::hypot(p.position.x, p.position.z); });
}

std::pair<vec3, vec3> CapsuleSearch::quantiles(float low, float high) const {
    return sample_.quantiles(low, high);
}

CapsuleTrial CapsuleSearch::boundingTrial() const {
    const auto [low, high] = quantiles(0.06F, 0.94F);
    CapsuleTrial trial;
    trial.center = 0.5F * (low + high);
    trial.radius = 0.25F * (high.x - low.x + high.z - low.z);
    trial.halfLength = std::max(0.0F, 0.5F * (high.y - low.y) - trial.radius);
    return trial;
}

vec3 CapsuleSearch::inSearch(const vec3& standardDirection) const {
    return glm::conjugate(standardFromSearch_.rotation) * standardDirection;
}

vec3 CapsuleSearch::toSearch(const vec3& standardPoint) const {
    return inverse(standardFromSearch_) * standardPoint;
}

vec3 CapsuleSearch::inStandard(const vec3& searchPoint) const {
    return standardFromSearch_ * searchPoint;
}

}  // namespace lutka::physics
