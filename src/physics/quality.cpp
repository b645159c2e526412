#include "physics/quality.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "physics/shape.hpp"
#include "physics/shape_distance.hpp"
#include "physics/swing_twist.hpp"

namespace lutka::physics {
namespace {

constexpr double kSecondsAfterContact = 3.0;  // samples for the 99th percentile and the mean end here
constexpr float kTouching = 0.002F;           // metres: nearer than this is contact
constexpr float kNearMesh = 0.3F;             // metres: how far from a mesh a body's distance matters
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

bool isFinite(const BodyState& state) {
    return lutka::isFinite(state.worldFromBody) && lutka::isFinite(state.linearVelocity) &&
           lutka::isFinite(state.angularVelocity);
}

// Half m v² plus half I w² (I in the body's principal axes).
double kineticEnergy(const BodyState& state, float massKg, const vec3& inertia) {
    const vec3 turn = glm::conjugate(state.worldFromBody.rotation) * state.angularVelocity;
    return 0.5 * static_cast<double>(massKg * glm::dot(state.linearVelocity, state.linearVelocity) +
                                     glm::dot(inertia, turn * turn));
}

float boundingRadius(const BodyShape& shape) {
    if (shape.kind == BodyShape::Kind::box) return glm::length(shape.halfExtents);
    return shape.radius + (shape.kind == BodyShape::Kind::capsule ? shape.halfLength : 0.0F);
}

// A box, sphere or capsule as what a body's shape would be.
BodyShape solidOf(const StaticShape& geometry) {
    BodyShape solid;
    solid.kind = geometry.kind == StaticShape::Kind::box      ? BodyShape::Kind::box
                 : geometry.kind == StaticShape::Kind::sphere ? BodyShape::Kind::sphere
                                                              : BodyShape::Kind::capsule;
    solid.halfExtents = geometry.halfExtents;
    solid.radius = geometry.radius;
    solid.halfLength = geometry.halfLength;
    return solid;
}

// The least signed distance from a mesh along a segment. The distance changes by no more than the way along the
// segment, so that samples and halving steps around the least of them miss it by little.
float leastAlong(const TriangleMesh& mesh, const Segment& segment, float range) {
    constexpr int kSteps = 12;
    const auto distanceAt = [&](float t) {
        const MeshDistance distance = mesh.distanceTo(segment.at(t), range);
        return distance.found ? distance.distance : range;
    };
    const float length = glm::length(segment.end - segment.start);
    float best = 0.0F;
    float least = distanceAt(0.0F);
    if (length <= 0.0F || least > length + kNearMesh) return least;
    for (int i = 1; i <= kSteps; ++i) {
        const float t = static_cast<float>(i) / kSteps;
        const float distance = distanceAt(t);
        if (distance < least) {
            least = distance;
            best = t;
        }
    }
    for (float step = 0.5F / kSteps; step * length > 1e-4F; step *= 0.5F) {
        for (const float t : {best - step, best + step}) {
            const float distance = distanceAt(std::clamp(t, 0.0F, 1.0F));
            if (distance >= least) continue;
            least = distance;
            best = std::clamp(t, 0.0F, 1.0F);
            break;
        }
    }
    return least;
}

// Round shapes exactly; boxes by their corners and the mesh's vertices.
float distanceToMesh(const BodyShape& shape, const RigidTransform& meshFromBody, const TriangleMesh& mesh) {
    const float reach = boundingRadius(shape);
    const float range = 2.0F * reach + kNearMesh;
    const vec3 gap =
        glm::max(glm::max(mesh.low() - meshFromBody.translation, meshFromBody.translation - mesh.high()), vec3(0));
    if (glm::length(gap) > range) return glm::length(gap) - reach;
    if (shape.kind != BodyShape::Kind::box) {
        const float half = shape.kind == BodyShape::Kind::capsule ? shape.halfLength : 0.0F;
        const Segment core{meshFromBody * vec3(0, -half, 0), meshFromBody * vec3(0, half, 0)};
        return leastAlong(mesh, core, range) - shape.radius;
    }
    float least = range;
    for (int corner = 0; corner < 8; ++corner) {
        const vec3 sign((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1, (corner & 4) != 0 ? 1 : -1);
        const MeshDistance distance = mesh.distanceTo(meshFromBody * (sign * shape.halfExtents), range);
        if (distance.found) least = std::min(least, distance.distance);
    }
    const RigidTransform bodyFromMesh = inverse(meshFromBody);
    mesh.forEachIn(meshFromBody.translation - reach, meshFromBody.translation + reach, [&](int triangle) {
        for (const int corner : mesh.triangles()[triangle])
            least = std::min(least, signedDistance(shape, bodyFromMesh * mesh.vertices()[corner]));
    });
    return least;
}

// The lowest corner of what faces up; the top where nothing does.
float lowestFloorOf(const TriangleMesh& mesh, const RigidTransform& worldFromMesh, const vec3& up) {
    float lowest = std::numeric_limits<float>::max();
    float highest = -lowest;
    const vec3 upInMesh = glm::conjugate(worldFromMesh.rotation) * up;
    for (std::size_t i = 0; i < mesh.triangles().size(); ++i) {
        const bool floor = glm::dot(mesh.normals()[i], upInMesh) > 0.5F;
        for (const int corner : mesh.triangles()[i]) {
            const float height = glm::dot(mesh.vertices()[corner], upInMesh);
            if (floor) lowest = std::min(lowest, height);
            highest = std::max(highest, height);
        }
    }
    return std::min(lowest, highest);
}

// The lowest of the static shapes' upper surfaces along `up`: the potential energy's zero.
float lowestSurface(std::span<const StaticShape> statics, const vec3& up) {
    float lowest = std::numeric_limits<float>::max();
    for (const StaticShape& shape : statics) {
        float top = glm::dot(shape.worldFromShape.translation, up);
        if (shape.kind == StaticShape::Kind::box) {
            const vec3 upInBox = glm::conjugate(shape.worldFromShape.rotation) * up;
            top += glm::dot(glm::abs(upInBox), shape.halfExtents);
        } else if (shape.kind == StaticShape::Kind::mesh) {
            top += lowestFloorOf(*shape.mesh, shape.worldFromShape, up);
        } else if (shape.kind != StaticShape::Kind::plane) {
            top += supportExtent(solidOf(shape), glm::conjugate(shape.worldFromShape.rotation) * up);
        }
        lowest = std::min(lowest, top);
    }
    return statics.empty() ? 0.0F : lowest;
}

}  // namespace

ConstraintState measureConstraint(const ConstraintProfile& constraint, const RigidTransform& worldFromParent,
                                  const RigidTransform& worldFromChild) {
    const RigidTransform parentFrame = worldFromParent * constraint.parentFromFrame;
    const RigidTransform childFrame = worldFromChild * constraint.childFromFrame;
    const quat q = glm::conjugate(parentFrame.rotation) * childFrame.rotation;
    ConstraintState state;
    state.separationM = glm::distance(parentFrame.translation, childFrame.translation);
    if (constraint.kind == ConstraintProfile::Kind::hinge) {
        state.hingeAngle = std::remainder(2.0F * std::atan2(q.z, q.w), 2.0F * kPi);
        state.violation =
            std::max({0.0F, constraint.hinge.lower - state.hingeAngle, state.hingeAngle - constraint.hinge.upper});
        return state;
    }
    const SwingTwist parts = swingTwist(q);
    state.swing = parts.swing;
    state.twist = parts.twist;
    const float outness = std::hypot(parts.swing.y / constraint.cone.swingY, parts.swing.z / constraint.cone.swingZ);
    // The ray from the centre leaves the ellipse at |swing| / outness.
    const float swingExcess = outness > 1.0F ? glm::length(parts.swing) * (1.0F - 1.0F / outness) : 0.0F;
    state.violation = std::max(swingExcess, std::abs(parts.twist) - constraint.cone.twist);
    state.violation = std::max(state.violation, 0.0F);
    return state;
}

float distanceToStatic(const BodyShape& shape, const RigidTransform& worldFromBody, const StaticShape& geometry) {
    if (geometry.kind == StaticShape::Kind::mesh)
        return distanceToMesh(shape, inverse(geometry.worldFromShape) * worldFromBody, *geometry.mesh);
    if (geometry.kind != StaticShape::Kind::plane)
        return distanceBetween(shape, worldFromBody, solidOf(geometry), geometry.worldFromShape);
    const vec3 normal = geometry.worldFromShape.rotation * vec3(0, 1, 0);
    const float height = glm::dot(normal, worldFromBody.translation - geometry.worldFromShape.translation);
    return height - supportExtent(shape, glm::conjugate(worldFromBody.rotation) * normal);
}

struct QualityMeter::State {
    State(const World& observed, std::span<const StaticShape> geometry, const vec3& pull)
        : world(observed), statics(geometry.begin(), geometry.end()), gravity(pull) {
        const float strength = glm::length(gravity);
        up = strength > 0.0F ? -gravity / strength : vec3(0, 1, 0);
        datum = lowestSurface(statics, up);
        leastEnergy = sampleWorld(false);
        quality.initialEnergyJ = static_cast<float>(leastEnergy);
    }

    // Takes the figures of all dolls (when `figures`) and returns the mechanical energy of all dynamic bodies, joules.
    double sampleWorld(bool figures);
    void sampleDoll(int doll);
    // The pairs of bodies that may collide.
    const std::vector<std::pair<int, int>>& pairsOf(const RagdollProfile& profile);
    double energyOf(const BodyState& state, float massKg, const vec3& inertia) const {
        const float height = glm::dot(state.worldFromBody.translation, up) - datum;
        return kineticEnergy(state, massKg, inertia) + static_cast<double>(massKg * glm::length(gravity) * height);
    }

    const World& world;
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

void QualityMeter::State::sampleDoll(int doll) {
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
    for (int doll = 0; doll < world.dollCount(); ++doll) {
        const RagdollProfile& profile = world.profileOf(doll);
        bodies.resize(profile.bodies.size());
        world.getBodies(doll, bodies);
        const std::int64_t brokenBefore = broken;
        float fastest = 0;
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            broken += isFinite(bodies[i]) ? 0 : 1;
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
    for (int prop = 0; prop < world.propCount(); ++prop) {
        const DynamicProp& settings = world.propOf(prop);
        const BodyState state = world.propState(prop);
        broken += isFinite(state) ? 0 : 1;
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

QualityMeter::QualityMeter(const World& world, std::span<const StaticShape> statics, const vec3& gravity)
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
