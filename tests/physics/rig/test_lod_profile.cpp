#include "physics/rig/lod_profile.hpp"

#include <glm/geometric.hpp>

#include "core/random.hpp"
#include "support/catch.hpp"
#include "support/counting_new.hpp"
#include "support/dolls.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using physics::BodyState;
using physics::LodLevel;
using physics::LodProfile;
using physics::RagdollProfile;
using physics::Rig;

namespace {

struct Doll {
    animation::Character character = test::makeBiped();
    RagdollProfile profile = test::makeDoll();
    Rig rig;

    Doll() {
        auto bound = physics::bindRig(profile, character.skeleton);
        REQUIRE(bound.ok());
        rig = std::move(bound).value();
    }

    // Bent in every joint, with any velocities, its constraints closed.
    [[nodiscard]] std::vector<BodyState> thrown(std::uint64_t seed) const {
        Random random(seed);
        std::vector<RigidTransform> pose = character.skeleton.bindModelFromJoint;
        for (RigidTransform& frame : pose) {
            const vec3 axis(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.1F, 1));
            frame.rotation = frame.rotation * glm::angleAxis(random.uniform(-0.6F, 0.6F), glm::normalize(axis));
        }
        std::vector<BodyState> bodies(profile.bodies.size());
        physics::bodiesFromPose(rig, pose, {glm::angleAxis(0.8F, vec3(0, 0.6F, 0.8F)), {1, 2, -3}}, bodies);
        for (BodyState& body : bodies) {
            body.linearVelocity = {random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)};
            body.angularVelocity = {random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(-4, 4)};
        }
        return bodies;
    }

    [[nodiscard]] std::vector<RigidTransform> pose(std::span<const BodyState> bodies) const {
        std::vector<RigidTransform> worldFromBody;
        for (const BodyState& body : bodies)
            worldFromBody.push_back(body.worldFromBody);
        std::vector<RigidTransform> out(character.skeleton.parents.size());
        physics::poseFromBodies(rig, character.skeleton, worldFromBody, {}, out);
        return out;
    }
};

struct Sums {
    double mass = 0;
    glm::dvec3 centre{0};
    glm::dmat3 inertia{0};  // about the centre, model axes
};

Sums sumsOf(const RagdollProfile& profile, const std::vector<RigidTransform>& modelFromBody) {
    Sums sums;
    for (std::size_t i = 0; i < profile.bodies.size(); ++i) {
        sums.mass += static_cast<double>(profile.bodies[i].massKg);
        sums.centre += static_cast<double>(profile.bodies[i].massKg) * glm::dvec3(modelFromBody[i].translation);
    }
    sums.centre /= sums.mass;
    for (std::size_t i = 0; i < profile.bodies.size(); ++i) {
        const glm::dmat3 r(glm::mat3_cast(modelFromBody[i].rotation));
        const glm::dvec3 moments(profile.bodies[i].inertia);
        const glm::dmat3 own = r * glm::dmat3(moments.x, 0, 0, 0, moments.y, 0, 0, 0, moments.z) * glm::transpose(r);
        const glm::dvec3 d = glm::dvec3(modelFromBody[i].translation) - sums.centre;
        sums.inertia += own + static_cast<double>(profile.bodies[i].massKg) *
                                  (glm::dot(d, d) * glm::dmat3(1.0) - glm::outerProduct(d, d));
    }
    return sums;
}

double largest(const glm::dmat3& m) {
    double worst = 0;
    for (int i = 0; i < 9; ++i)
        worst = std::max(worst, std::abs(m[i / 3][i % 3]));
    return worst;
}

float largestGap(const RagdollProfile& profile, std::span<const BodyState> bodies) {
    float worst = 0;
    for (const physics::ConstraintProfile& c : profile.constraints)
        worst = std::max(worst, glm::distance(bodies[c.parent].worldFromBody * c.parentFromFrame.translation,
                                              bodies[c.child].worldFromBody * c.childFromFrame.translation));
    return worst;
}

std::vector<RigidTransform> bindOf(const LodProfile& lod, const Rig& rig) {
    std::vector<RigidTransform> modelFromLod;
    for (const int upper : lod.upper)
        modelFromLod.push_back(rig.bindModelFromBody[upper] * inverse(lod.lodFromBody[upper]));
    return modelFromLod;
}

}  // namespace

TEST_CASE("merged ragdolls are valid, smaller and bind to the same skeleton") {
    const Doll doll;
    const std::pair<LodLevel, std::size_t> expected[] = {{LodLevel::limbs, 11}, {LodLevel::block, 7}};
    for (const auto& [level, bodies] : expected) {
        const LodProfile lod = makeLodProfile(doll.profile, doll.rig, level);
        CHECK(lod.profile.bodies.size() == bodies);
        CHECK(physics::validate(lod.profile).empty());
        const auto bound = physics::bindRig(lod.profile, doll.character.skeleton);
        REQUIRE(bound.ok());
        const std::vector<RigidTransform> bind = bindOf(lod, doll.rig);
        for (std::size_t i = 0; i < bodies; ++i)
            CHECK(glm::distance(bind[i].translation, bound.value().bindModelFromBody[i].translation) < 1e-5F);
    }
}

TEST_CASE("merging keeps mass, centre of mass and inertia, of the doll and of each group") {
    const Doll doll;
    for (const LodLevel level : {LodLevel::limbs, LodLevel::block}) {
        const LodProfile lod = makeLodProfile(doll.profile, doll.rig, level);
        const Sums before = sumsOf(doll.profile, doll.rig.bindModelFromBody);
        const Sums after = sumsOf(lod.profile, bindOf(lod, doll.rig));
        CHECK(after.mass == Approx(before.mass).epsilon(1e-6));
        CHECK(glm::distance(after.centre, before.centre) < 1e-5);
        CHECK(largest(after.inertia - before.inertia) < 1e-4 * largest(before.inertia));
        for (std::size_t group = 0; group < lod.upper.size(); ++group) {
            RagdollProfile members;
            std::vector<RigidTransform> places;
            for (std::size_t i = 0; i < doll.profile.bodies.size(); ++i) {
                if (lod.bodyOf[i] != static_cast<int>(group)) continue;
                members.bodies.push_back(doll.profile.bodies[i]);
                places.push_back(doll.rig.bindModelFromBody[i]);
            }
            RagdollProfile merged;
            merged.bodies.push_back(lod.profile.bodies[group]);
            const Sums parts = sumsOf(members, places);
            const Sums whole = sumsOf(merged, {bindOf(lod, doll.rig)[group]});
            CHECK(largest(whole.inertia - parts.inertia) < 1e-4 * largest(parts.inertia));
        }
    }
}

TEST_CASE("a merged body hangs on its uppermost member's joint with that joint's limits") {
    const Doll doll;
    const LodProfile lod = makeLodProfile(doll.profile, doll.rig, LodLevel::limbs);
    for (const physics::ConstraintProfile& kept : lod.profile.constraints) {
        const int upper = lod.upper[kept.child];
        const physics::ConstraintProfile& full = doll.profile.constraints[upper - 1];
        CHECK(kept.kind == full.kind);
        CHECK(kept.hinge.upper == full.hinge.upper);
        CHECK(kept.cone.swingY == full.cone.swingY);
        CHECK(kept.cone.twist == full.cone.twist);
        CHECK(kept.frictionNm == full.frictionNm);
    }
    std::vector<BodyState> bind;
    for (const RigidTransform& frame : bindOf(lod, doll.rig))
        bind.push_back({frame, {}, {}});
    CHECK(largestGap(lod.profile, bind) < 1e-5F);
}

TEST_CASE("switching to merged bodies and back changes nothing that is drawn") {
    const Doll doll;
    for (const LodLevel level : {LodLevel::limbs, LodLevel::block}) {
        const LodProfile lod = makeLodProfile(doll.profile, doll.rig, level);
        for (std::uint64_t seed = 1; seed <= 10; ++seed) {
            const std::vector<BodyState> before = doll.thrown(seed);
            std::vector<BodyState> merged(lod.profile.bodies.size());
            std::vector<quat> lodFromMember(before.size());
            std::vector<BodyState> after(before.size());
            fullToLod(lod, doll.profile, before, merged, lodFromMember);
            lodToFull(lod, doll.profile, merged, lodFromMember, after);
            CHECK(largestGap(lod.profile, merged) < 1e-5F);
            CHECK(largestGap(doll.profile, after) < 1e-5F);
            const std::vector<RigidTransform> drawn = doll.pose(before);
            const std::vector<RigidTransform> shown = doll.pose(after);
            float worst = 0;
            for (std::size_t joint = 0; joint < drawn.size(); ++joint) {
                worst = std::max(worst, glm::distance(drawn[joint].translation, shown[joint].translation));
                worst = std::max(worst, glm::distance(drawn[joint] * vec3(0.2F), shown[joint] * vec3(0.2F)));
            }
            CHECK(worst < 2e-5F);
        }
    }
}

TEST_CASE("switching keeps momentum, and of a doll that moves rigidly every velocity") {
    const Doll doll;
    for (const LodLevel level : {LodLevel::limbs, LodLevel::block}) {
        const LodProfile lod = makeLodProfile(doll.profile, doll.rig, level);
        std::vector<BodyState> before = doll.thrown(3);
        std::vector<BodyState> merged(lod.profile.bodies.size());
        std::vector<quat> lodFromMember(before.size());
        fullToLod(lod, doll.profile, before, merged, lodFromMember);
        const auto momentum = [](const RagdollProfile& profile, std::span<const BodyState> bodies) {
            vec3 sum(0);
            for (std::size_t i = 0; i < bodies.size(); ++i)
                sum += profile.bodies[i].massKg * bodies[i].linearVelocity;
            return sum;
        };
        CHECK(glm::distance(momentum(doll.profile, before), momentum(lod.profile, merged)) < 1e-3F);

        const vec3 spin(0.5F, -2.0F, 1.0F);
        std::vector<BodyState> bind(before.size());
        physics::bodiesFromPose(doll.rig, doll.character.skeleton.bindModelFromJoint, {}, bind);
        for (BodyState& body : bind) {
            body.angularVelocity = spin;
            body.linearVelocity = vec3(1, 2, 3) + glm::cross(spin, body.worldFromBody.translation);
        }
        std::vector<BodyState> after(bind.size());
        fullToLod(lod, doll.profile, bind, merged, lodFromMember);
        lodToFull(lod, doll.profile, merged, lodFromMember, after);
        for (std::size_t i = 0; i < bind.size(); ++i) {
            CHECK(glm::distance(after[i].linearVelocity, bind[i].linearVelocity) < 1e-3F);
            CHECK(glm::distance(after[i].angularVelocity, bind[i].angularVelocity) < 1e-3F);
        }
    }
}
