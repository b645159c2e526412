#include "physics/world/quality.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>
#include <utility>

#include "physics/collision/shape.hpp"
#include "physics/collision/static_distance.hpp"
#include "physics/profile/constraint_state.hpp"
#include "physics/world/body_energy.hpp"
#include "physics/world/doll_overlap.hpp"
#include "physics/world/histogram.hpp"
#include "physics/world/lasting_peak.hpp"

namespace lutka::physics {
namespace {

constexpr double kSecondsAfterContact = 3.0;  // samples for the 99th percentile and the mean end here
constexpr float kTouching = 0.002F;           // metres: nearer than this is contact
constexpr float kSettledSpeed = 0.01F;        // m/s
constexpr double kFrame = 0.999 / 60.0;       // seconds, but for the rounding of the samples' times
constexpr double kLasting = 1.999 / 60.0;     // two frames

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
    // How far dolls are in each other, once a frame: they move little in less.
    void sampleOverlaps();
    // What each of the doll's joints kept up of its violation.
    std::vector<LastingPeak>& peaksOf(DollId doll, std::size_t joints);
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
    struct DollPeaks {
        DollId doll;
        std::vector<LastingPeak> joints;
    };
    std::vector<DollPeaks> peaks;  // by the index of a doll's handle
    std::map<const RagdollProfile*, std::vector<std::pair<int, int>>> pairs;
    DollOverlap overlap;
    Histogram overlaps;             // of bodies of different dolls that touch or nearly do
    double lastOverlap = -1;        // seconds since release
    std::vector<BodyState> bodies;  // of the doll at hand
    bool touching = false;          // some body is in contact with something static, in the present sample
    bool settled = false;           // all dolls rest, in the present sample
    double leastEnergy = 0;
    std::optional<double> firstContact;
    std::optional<double> restingSince;
    double now = 0;        // seconds since release
    bool counting = true;  // whether the present sample goes into the percentiles
};

void QualityMeter::State::sampleDoll(DollId doll) {
    const RagdollProfile& profile = world.profileOf(doll);
    std::vector<LastingPeak>& held = peaksOf(doll, profile.constraints.size());
    for (std::size_t i = 0; i < profile.constraints.size(); ++i) {
        const ConstraintProfile& constraint = profile.constraints[i];
        const ConstraintState state = measureConstraint(constraint, bodies[constraint.parent].worldFromBody,
                                                        bodies[constraint.child].worldFromBody);
        const float violation = degrees(state.violation);
        quality.jointSeparationM.max = std::max(quality.jointSeparationM.max, state.separationM);
        quality.limitViolationDeg.max = std::max(quality.limitViolationDeg.max, violation);
        quality.limitViolationDeg.lasting = std::max(quality.limitViolationDeg.lasting, held[i].add(now, violation));
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

std::vector<LastingPeak>& QualityMeter::State::peaksOf(DollId doll, std::size_t joints) {
    const auto index = static_cast<std::size_t>(doll.index);
    if (peaks.size() <= index) peaks.resize(index + 1);
    DollPeaks& known = peaks[index];
    if (known.doll != doll) known = {doll, std::vector<LastingPeak>(joints, LastingPeak(kLasting))};
    return known.joints;
}

void QualityMeter::State::sampleOverlaps() {
    if (lastOverlap >= 0 && now < lastOverlap + kFrame) return;
    lastOverlap = now;
    overlap.clear();
    const std::span<const DollId> dolls = world.dolls();
    if (dolls.size() < 2) return;
    for (std::size_t i = 0; i < dolls.size(); ++i) {
        const RagdollProfile& profile = world.profileOf(dolls[i]);
        bodies.resize(profile.bodies.size());
        world.getBodies(dolls[i], bodies);
        if (!std::all_of(bodies.begin(), bodies.end(), [](const BodyState& body) { return isFinite(body); })) continue;
        overlap.add(static_cast<int>(i), profile, bodies);
    }
    for (const float depth : overlap.depths())
        overlaps.add(depth);
    quality.dollPenetrationM.max = std::max(quality.dollPenetrationM.max, overlap.deepest());
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
    return energy - world.dragWork() - world.motorWork() - world.impulseWork();
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
    s.now = secondsSinceRelease;
    s.counting = !s.firstContact || secondsSinceRelease <= *s.firstContact + kSecondsAfterContact;
    const double energy = s.sampleWorld(true);
    s.sampleOverlaps();
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
    quality.dollPenetrationM.p99 = std::min(state_->overlaps.percentile(0.99), quality.dollPenetrationM.max);
    if (state_->restingSince) quality.settleSeconds = static_cast<float>(*state_->restingSince - *state_->firstContact);
    return quality;
}

}  // namespace lutka::physics
