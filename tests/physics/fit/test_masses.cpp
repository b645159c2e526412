#include "physics/fit/fit_ragdoll.hpp"
#include "physics/fit/masses.hpp"

#include <numeric>
#include <string>

#include "physics/collision/shape.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::physics;

namespace {

RagdollProfile bipedWithMasses(const FitOptions& options) {
    const auto biped = test::makeBiped();
    return fitRagdoll(biped, test::mapOfBiped(biped), options).value();
}

double sumOf(const RagdollProfile& profile) {
    return std::accumulate(profile.bodies.begin(), profile.bodies.end(), 0.0,
                           [](double sum, const BodyProfile& body) { return sum + body.massKg; });
}

float largestRatio(const RagdollProfile& profile) {
    float largest = 1.0F;
    for (const ConstraintProfile& c : profile.constraints) {
        const float ratio = profile.bodies[c.parent].massKg / profile.bodies[c.child].massKg;
        largest = std::max({largest, ratio, 1.0F / ratio});
    }
    return largest;
}

BodyShape capsule(float radius, float halfLength) {
    BodyShape shape;
    shape.radius = radius;
    shape.halfLength = halfLength;
    return shape;
}

// The moments by cutting the shape's bounding box into small cubes.
vec3 inertiaBySum(const BodyShape& shape, float mass) {
    constexpr int kCells = 60;
    const vec3 reach(supportExtent(shape, {1, 0, 0}), supportExtent(shape, {0, 1, 0}), supportExtent(shape, {0, 0, 1}));
    double inside = 0;
    double x = 0;
    double y = 0;
    double z = 0;
    for (int i = 0; i < kCells * kCells * kCells; ++i) {
        const vec3 cell(i % kCells, i / kCells % kCells, i / kCells / kCells);
        const vec3 p = reach * (2.0F * (cell + 0.5F) / static_cast<float>(kCells) - 1.0F);
        if (signedDistance(shape, p) > 0.0F) continue;
        inside += 1;
        x += p.y * p.y + p.z * p.z;
        y += p.x * p.x + p.z * p.z;
        z += p.x * p.x + p.y * p.y;
    }
    return {mass * x / inside, mass * y / inside, mass * z / inside};
}

}  // namespace

TEST_CASE("each table's shares sum to one within its rounding") {
    for (const MassTable table : {MassTable::deLevaMale, MassTable::deLevaFemale, MassTable::winter}) {
        float sum = 0.0F;
        for (int role = 0; role < animation::kRoleCount; ++role)
            sum += segmentMassShare(table, animation::roleAt(role));
        CHECK(sum == Approx(1.0F).margin(5e-4));
    }
}

TEST_CASE("the total mass is exact for every preset, table and set of bodies") {
    for (const MassPreset preset :
         {MassPreset::anatomical, MassPreset::balanced, MassPreset::uniform, MassPreset::volume}) {
        for (const MassTable table : {MassTable::deLevaMale, MassTable::deLevaFemale, MassTable::winter}) {
            for (const bool more : {false, true}) {
                FitOptions options;
                options.massPreset = preset;
                options.massTable = table;
                options.totalMassKg = 61.7F;
                options.shoulderBodies = options.neckBody = options.allTrunkBodies = more;
                CHECK(std::abs(sumOf(bipedWithMasses(options)) - options.totalMassKg) <= 1e-6 * options.totalMassKg);
            }
        }
    }
}

TEST_CASE("anatomical masses are de Leva's for a man of 75 kg") {
    const RagdollProfile profile = bipedWithMasses({});
    const auto mass = [&](Role role) { return profile.bodies[bodyOf(profile, role)].massKg; };
    // The table's shares sum to 0.9999, which scaling makes up for.
    CHECK(mass(Role::hips) == Approx(75 * 0.1117).epsilon(1e-3));
    CHECK(mass(Role::spine) == Approx(75 * 0.1633).epsilon(1e-3));
    CHECK(mass(Role::chest) == Approx(75 * 0.1596).epsilon(1e-3));
    CHECK(mass(Role::head) == Approx(75 * 0.0694).epsilon(1e-3));
    CHECK(mass(Role::leftUpperLeg) == Approx(75 * 0.1416).epsilon(1e-3));
    CHECK(mass(Role::rightFoot) == Approx(75 * 0.0137).epsilon(1e-3));
    CHECK(largestRatio(profile) < 6.0F);
}

TEST_CASE("balanced masses draw the ratios together and uniform ones make them equal") {
    FitOptions balanced;
    balanced.massPreset = MassPreset::balanced;
    CHECK(largestRatio(bipedWithMasses(balanced)) ==
          Approx(std::sqrt(largestRatio(bipedWithMasses({})))).epsilon(1e-3));
    FitOptions uniform;
    uniform.massPreset = MassPreset::uniform;
    CHECK(largestRatio(bipedWithMasses(uniform)) == Approx(1.0F).epsilon(1e-5));
}

TEST_CASE("by volume every body has the same density") {
    FitOptions options;
    options.massPreset = MassPreset::volume;
    const RagdollProfile profile = bipedWithMasses(options);
    const float density = profile.bodies[0].massKg / shapeVolume(profile.bodies[0].shape);
    for (const BodyProfile& body : profile.bodies)
        CHECK(body.massKg / shapeVolume(body.shape) == Approx(density).epsilon(1e-4));
}

TEST_CASE("inertia and volume agree with a sum over small cubes") {
    BodyShape box;
    box.kind = BodyShape::Kind::box;
    box.halfExtents = {0.1F, 0.2F, 0.05F};
    BodyShape sphere;
    sphere.kind = BodyShape::Kind::sphere;
    sphere.radius = 0.12F;
    for (const BodyShape& shape : {capsule(0.05F, 0.2F), capsule(0.1F, 0.0F), capsule(0.09F, 0.03F), box, sphere}) {
        const vec3 closed = shapeInertia(shape, 3.0F);
        const vec3 summed = inertiaBySum(shape, 3.0F);
        CHECK(closed.x == Approx(summed.x).epsilon(0.01));
        CHECK(closed.y == Approx(summed.y).epsilon(0.01));
        CHECK(closed.z == Approx(summed.z).epsilon(0.01));
    }
    CHECK(shapeVolume(capsule(0.1F, 0.0F)) == Approx(4.0 / 3.0 * kPi * 1e-3));
    CHECK(shapeVolume(capsule(0.1F, 0.5F)) == Approx(4.0 / 3.0 * kPi * 1e-3 + kPi * 0.01));
    CHECK(shapeInertia(capsule(0.1F, 0.0F), 1.0F).x == Approx(0.4 * 0.01));
}

TEST_CASE("distances between shapes are those of their surfaces") {
    const RigidTransform origin;
    const RigidTransform aside{quat(1, 0, 0, 0), {0.5F, 0, 0}};
    const RigidTransform lying{glm::angleAxis(kPi / 2, vec3(0, 0, 1)), {0.5F, 0, 0}};
    CHECK(distanceBetween(capsule(0.1F, 0.3F), origin, capsule(0.1F, 0.3F), aside) == Approx(0.3));
    CHECK(distanceBetween(capsule(0.1F, 0.3F), origin, capsule(0.1F, 0.3F), lying) == Approx(0.0).margin(1e-6));
    BodyShape box;
    box.kind = BodyShape::Kind::box;
    box.halfExtents = {0.1F, 0.2F, 0.3F};
    CHECK(distanceBetween(capsule(0.1F, 0.3F), origin, box, aside) == Approx(0.3));
    CHECK(distanceBetween(box, aside, capsule(0.1F, 0.3F), origin) == Approx(0.3));
    CHECK(distanceBetween(box, origin, box, aside) == Approx(0.3));
    CHECK(distanceBetween(box, origin, box, {quat(1, 0, 0, 0), {0.15F, 0, 0}}) == Approx(-0.05));
}

TEST_CASE(
    "bodies without a role are raised to shares of their neighbours, more above than below, and the total stays") {
    RagdollProfile chain;
    chain.totalMassKg = 0.0F;
    for (const float mass : {0.01F, 50.0F, 0.02F}) {
        BodyProfile& body = chain.bodies.emplace_back();
        body.name = "body " + std::to_string(chain.bodies.size());
        body.massKg = mass;
        chain.totalMassKg += mass;
        if (chain.bodies.size() == 1) continue;
        ConstraintProfile& joint = chain.constraints.emplace_back();
        joint.child = static_cast<int>(chain.bodies.size()) - 1;
        joint.parent = joint.child - 1;
    }
    raiseLightSegments(chain);
    CHECK(chain.bodies[0].massKg / chain.bodies[1].massKg == Approx(0.7F));
    CHECK(chain.bodies[2].massKg / chain.bodies[1].massKg == Approx(0.2F));
    CHECK(chain.bodies[0].massKg + chain.bodies[1].massKg + chain.bodies[2].massKg == Approx(chain.totalMassKg));
}
