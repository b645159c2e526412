#include "physics/world/quality.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "physics/collision/shape.hpp"
#include "physics/collision/static_distance.hpp"
#include "physics/profile/constraint_state.hpp"

namespace lutka::physics {
namespace {

constexpr double kSecondsAfterContact = 3.0;  // samples for the 99th percentile and the mean end here
constexpr float kTouching = 0.002F;           // metres: nearer than this is contact
constexpr float kSettledSpeed = 0.01F;        // m/s

constexpr unsigned kShift = 16;  // bits of a float that a bin does not tell apart
constexpr int binOf(float value) {
    return static_cast<int>(std::bit_cast<std::uint32_t>(value) >> kShift);
}
constexpr float middleOf(int bin) {
    return std::bit_cast<float>((static_cast<std::uint32_t>(bin) << kShift) + (1U << (kShift - 1)));
}

// Counts values in bins that grow by less than 1 %, so that a percentile of millions of samples needs no memory. A bin
// is a float's exponent and the first seven bits of its fraction: a logarithm for each sample cost more than measuring
// it.
class Histogram {
  public:
    void add(float value) {
        ++count_;
        if (!(value < kHighest)) {  // so far off, or not a number, that its place no longer matters
            ++counts_[kBins - 1];
            sum_ += static_cast<double>(kHighest);
            return;
        }
        sum_ += static_cast<double>(value);
        if (value <= kLowest) {
            ++counts_[0];
            return;
        }
        ++counts_[1 + binOf(value) - kFirst];
    }
    // The value that a share of the samples does not exceed, to 1 %; 0 without samples.
    [[nodiscard]] float percentile(double share) const {
        std::int64_t below = 0;
        for (int bin = 0; bin < kBins; ++bin) {
            below += counts_[bin];
            if (count_ > 0 && static_cast<double>(below) >= share * static_cast<double>(count_))
                return bin == 0 ? 0.0F : middleOf(bin - 1 + kFirst);
        }
        return 0.0F;
    }
    [[nodiscard]] float mean() const {
        return count_ > 0 ? static_cast<float>(sum_ / static_cast<double>(count_)) : 0.0F;
    }

  private:
    static constexpr float kLowest = 1e-7F;
    static constexpr float kHighest = 1e4F;
    static constexpr int kFirst = binOf(kLowest);
    static constexpr int kBins = binOf(kHighest) - kFirst + 2;
    std::array<std::int64_t, kBins> counts_{};
    std::int64_t count_ = 0;
    double sum_ = 0;
};

// Half m v² plus half I w² (I in the body's principal axes).
double kineticEnergy(const BodyState& state, float massKg, const vec3& inertia) {
    const vec3 turn = glm::conjugate(state.worldFromBody.rotation) * state.angularVelocity;
    return 0.5 * static_cast<double>(massKg * glm::dot(state.linearVelocity, state.linearVelocity) +
                                     glm::dot(inertia, turn * turn));
}

}  // namespace

struct QualityMeter::State {
    State(const WorldView& observed, std::span<const StaticShape> geometry, const vec3& pull)
        : world(observed), statics(geometry.begin(), geometry.end()), gravity(pull) {
        const float strength = glm::length(gravity);
        up = strength > 0.0F ? -gravity / strength : vec3(0, 1, 0);
        datum = lowestSurface(statics, up);
        leastEnergy = sampleWorld(false);
        quality.initialEnergyJ = static_cast<float>(leastEnergy);
    }

    // Takes the figures of all dolls (when `figures`) and returns the mechanical energy of all dynamic bodies, joules.
    double sampleWorld(bool figures);
    void sampleDoll(DollId doll);
    // The pairs of bodies that may collide.
    const std::vector<std::pair<int, int>>& pairsOf(const RagdollProfile& profile);
    double energyOf(const BodyState& state, float massKg, const vec3& inertia) const {
        const float height = glm::dot(state.worldFromBody.translation, up) - datum;
        return kineticEnergy(state, massKg, inertia) + static_cast<double>(massKg * glm::length(gravity) * height);
    }

    const WorldView& world;
    std::vector<StaticShape> statics;
    vec3 gravity;
    vec3 up;
    float datum = 0.0F;

    Quality quality;
    Histogram separations;
    Histogram violations;  // degrees
    std::map<const RagdollProfile*, std::vector<std::pair<int, int>>> pairs;
    std::vector<BodyState> bodies;  // of the doll at hand
    bool touching = false;          // some body is in contact with something static, in the present sample
    bool settled = false;           // all dolls rest, in the present sample
    double leastEnergy = 0;
    std::optional<double> firstContact;
    std::optional<double> restingSince;
    bool counting = true;  // whether the present sample goes into the percentiles
};

void QualityMeter::State::sampleDoll(DollId doll) {
    const RagdollProfile& profile = world.profileOf(doll);
    for (const ConstraintProfile& constraint : profile.constraints) {
        const ConstraintState state = measureConstraint(constraint, bodies[constraint.parent].worldFromBody,
                                                        bodies[constraint.child].worldFromBody);
        const float violation = degrees(state.violation);
        quality.jointSeparationM.max = std::max(quality.jointSeparationM.max, state.separationM);
        quality.limitViolationDeg.max = std::max(quality.limitViolationDeg.max, violation);
        if (!counting) continue;
        separations.add(state.separationM);
        violations.add(violation);
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        for (const StaticShape& geometry : statics) {
            const float distance = distanceToStatic(profile.bodies[i].shape, bodies[i].worldFromBody, geometry);
            quality.floorPenetrationM = std::max(quality.floorPenetrationM, -distance);
            touching = touching || distance < kTouching;
        }
    }
    for (const auto& [a, b] : pairsOf(profile)) {
        const vec3 offset = bodies[a].worldFromBody.translation - bodies[b].worldFromBody.translation;
        const float reach = boundingRadius(profile.bodies[a].shape) + boundingRadius(profile.bodies[b].shape);
        if (glm::dot(offset, offset) > reach * reach) continue;
        const float distance = distanceBetween(profile.bodies[a].shape, bodies[a].worldFromBody,
                                               profile.bodies[b].shape, bodies[b].worldFromBody);
        quality.selfPenetrationM = std::max(quality.selfPenetrationM, -distance);
    }
}

double QualityMeter::State::sampleWorld(bool figures) {
    double energy = 0;
    double squares = 0;
    int moving = 0;
    std::int64_t broken = 0;
    touching = false;
    settled = true;
    for (const DollId doll : world.dolls()) {
        const RagdollProfile& profile = world.profileOf(doll);
        bodies.resize(profile.bodies.size());
        world.getBodies(doll, bodies);
        const std::int64_t brokenBefore = broken;
        float fastest = 0;
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            if (!isFinite(bodies[i])) {  // counted; it must not spoil the sums
                ++broken;
                continue;
            }
            energy += energyOf(bodies[i], profile.bodies[i].massKg, world.inertiaOf(doll, static_cast<int>(i)));
            const float speed = glm::length(bodies[i].linearVelocity);
            squares += static_cast<double>(speed * speed);
            fastest = std::max(fastest, speed);
        }
        moving += static_cast<int>(bodies.size());
        const bool whole = broken == brokenBefore;
        settled = settled && whole && (world.isAsleep(doll) || fastest < kSettledSpeed);
        // The other figures of a broken doll mean nothing, and those of a sleeping one are in already.
        const bool asItWas = !counting && world.isAsleep(doll);
        if (figures && whole && !asItWas) sampleDoll(doll);
    }
    for (const PropId prop : world.props()) {
        const DynamicProp& settings = world.propOf(prop);
        const BodyState state = world.propState(prop);
        if (!isFinite(state)) {
            ++broken;
            continue;
        }
        energy += energyOf(state, settings.massKg, shapeInertia(settings.shape, settings.massKg));
    }
    quality.nonFinite += broken;
    quality.residualSpeedMps = moving > 0 ? static_cast<float>(std::sqrt(squares / moving)) : 0.0F;
    return energy - world.dragWork() - world.motorWork();
}

const std::vector<std::pair<int, int>>& QualityMeter::State::pairsOf(const RagdollProfile& profile) {
    const auto known = pairs.find(&profile);
    if (known != pairs.end()) return known->second;
    std::set<std::pair<int, int>> excluded(profile.filteredPairs.begin(), profile.filteredPairs.end());
    for (const ConstraintProfile& constraint : profile.constraints)
        excluded.emplace(std::min(constraint.parent, constraint.child), std::max(constraint.parent, constraint.child));
    std::vector<std::pair<int, int>>& colliding = pairs[&profile];
    for (int a = 0; a < static_cast<int>(profile.bodies.size()); ++a) {
        for (int b = a + 1; b < static_cast<int>(profile.bodies.size()); ++b) {
            if (!excluded.contains({a, b})) colliding.emplace_back(a, b);
        }
    }
    return colliding;
}

QualityMeter::QualityMeter(const WorldView& world, std::span<const StaticShape> statics, const vec3& gravity)
    : state_(std::make_unique<State>(world, statics, gravity)) {}

QualityMeter::~QualityMeter() = default;

void QualityMeter::sample(double secondsSinceRelease) {
    State& s = *state_;
    s.counting = !s.firstContact || secondsSinceRelease <= *s.firstContact + kSecondsAfterContact;
    const double energy = s.sampleWorld(true);
    if (s.touching && !s.firstContact) s.firstContact = secondsSinceRelease;
    s.leastEnergy = std::min(s.leastEnergy, energy);
    s.quality.energyGrowthJ = std::max(s.quality.energyGrowthJ, static_cast<float>(energy - s.leastEnergy));
    if (!s.settled || !s.firstContact)
        s.restingSince.reset();
    else if (!s.restingSince)
        s.restingSince = secondsSinceRelease;
}

Quality QualityMeter::result() const {
    Quality quality = state_->quality;
    quality.jointSeparationM.p99 = std::min(state_->separations.percentile(0.99), quality.jointSeparationM.max);
    quality.jointSeparationM.mean = state_->separations.mean();
    quality.limitViolationDeg.p99 = std::min(state_->violations.percentile(0.99), quality.limitViolationDeg.max);
    if (state_->restingSince) quality.settleSeconds = static_cast<float>(*state_->restingSince - *state_->firstContact);
    return quality;
}

}  // namespace lutka::physics
