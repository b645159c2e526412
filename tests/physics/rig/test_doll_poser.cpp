#include "physics/rig/doll_poser.hpp"

#include <cstring>
#include <glm/geometric.hpp>
#include <numeric>

#include "core/random.hpp"
#include "support/catch.hpp"
#include "support/counting_new.hpp"
#include "support/dolls.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using animation::SkinMatrix;
using physics::BodyState;
using physics::DollPoser;
using physics::Rig;

namespace {

// Dolls of makeBiped() with added joints between bodies (a spine joint that shares the bend, a twist helper of the
// forearm), thrown about in two states.
struct Dolls {
    animation::Skeleton skeleton;
    Rig rig;
    std::size_t count;
    std::vector<RigidTransform> previous;
    std::vector<RigidTransform> present;
    std::vector<RigidTransform> worldFromModel;
    std::vector<int> all;

    explicit Dolls(std::size_t dolls) : count(dolls), all(dolls) {
        animation::Character biped = test::makeBiped();
        skeleton = biped.skeleton;
        auto bound = physics::bindRig(test::makeDoll(), skeleton);
        REQUIRE(bound.ok());
        rig = std::move(bound).value();
        std::iota(all.begin(), all.end(), 0);
        Random random(17);
        for (std::size_t doll = 0; doll < count; ++doll) {
            worldFromModel.push_back({anyTurn(random, 3.0F), anyPoint(random)});
            scatter(random, previous);
            scatter(random, present);
        }
    }

    [[nodiscard]] std::size_t joints() const { return skeleton.parents.size(); }
    [[nodiscard]] DollPoser::Source at(float alpha) const { return {previous, present, alpha, worldFromModel, {}, {}}; }

  private:
    static quat anyTurn(Random& random, float angle) {
        const vec3 axis(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.1F, 1));
        return glm::angleAxis(random.uniform(-angle, angle), glm::normalize(axis));
    }
    static vec3 anyPoint(Random& random) {
        return {random.uniform(-3, 3), random.uniform(0, 2), random.uniform(-3, 3)};
    }
    void scatter(Random& random, std::vector<RigidTransform>& to) const {
        std::vector<RigidTransform> pose = skeleton.bindModelFromJoint;
        for (RigidTransform& frame : pose)
            frame.rotation = frame.rotation * anyTurn(random, 1.2F);
        std::vector<BodyState> bodies(rig.jointOfBody.size());
        physics::bodiesFromPose(rig, pose, {anyTurn(random, 3.0F), anyPoint(random)}, bodies);
        for (const BodyState& body : bodies)
            to.push_back(body.worldFromBody);
    }
};

// One of the rig's follower joints becomes a chain between two bodies, so that shared bends and twists are tested too.
void addChain(Rig& rig, int joint, int upper, int lower, float share, const vec3& twistAxis) {
    Rig::Joint& chain = rig.joints[joint];
    chain.drive = physics::JointDrive::chain;
    chain.upperBody = upper;
    chain.body = lower;
    chain.share = share;
    chain.twistAxis = twistAxis;
}

int firstFollower(const Rig& rig, int after) {
    for (int joint = after + 1; joint < static_cast<int>(rig.joints.size()); ++joint)
        if (rig.joints[joint].drive == physics::JointDrive::follower && rig.joints[joint].base >= 0) return joint;
    return -1;
}

struct Skins {
    explicit Skins(const Dolls& dolls) : palettes(dolls.count * dolls.joints()), frames(dolls.count * dolls.joints()) {}
    std::vector<SkinMatrix> palettes;
    std::vector<RigidTransform> frames;
};

// What poseFromBodies() and skinMatrices() give.
Skins oneByOne(const Dolls& dolls, float alpha) {
    Skins skins(dolls);
    const std::size_t bodies = dolls.rig.jointOfBody.size();
    std::vector<RigidTransform> mixed(bodies);
    for (std::size_t doll = 0; doll < dolls.count; ++doll) {
        for (std::size_t b = 0; b < bodies; ++b)
            mixed[b] = interpolate(dolls.previous[doll * bodies + b], dolls.present[doll * bodies + b], alpha);
        const auto frames = std::span(skins.frames).subspan(doll * dolls.joints(), dolls.joints());
        physics::poseFromBodies(dolls.rig, dolls.skeleton, mixed, dolls.worldFromModel[doll], frames);
        skinMatrices(dolls.skeleton.bindModelFromJoint, frames,
                     std::span(skins.palettes).subspan(doll * dolls.joints(), dolls.joints()));
    }
    return skins;
}

float difference(const Skins& a, const Skins& b) {
    float worst = 0;
    for (std::size_t i = 0; i < a.palettes.size(); ++i) {
        for (int row = 0; row < 3; ++row)
            worst = std::max(worst, glm::distance(a.palettes[i].rows[row], b.palettes[i].rows[row]));
        worst = std::max(worst, glm::distance(a.frames[i].translation, b.frames[i].translation));
        const float sign = glm::dot(a.frames[i].rotation, b.frames[i].rotation) < 0.0F ? -1.0F : 1.0F;
        worst = std::max(worst, glm::length(a.frames[i].rotation - b.frames[i].rotation * sign));
    }
    return worst;
}

bool sameBits(const Skins& a, const Skins& b) {
    return std::memcmp(a.palettes.data(), b.palettes.data(), a.palettes.size() * sizeof a.palettes[0]) == 0 &&
           std::memcmp(a.frames.data(), b.frames.data(), a.frames.size() * sizeof a.frames[0]) == 0;
}

}  // namespace

TEST_CASE("many dolls at once get the skins that they would get alone") {
    for (const std::size_t count : {1, 7, 8, 21}) {
        Dolls dolls(count);
        const int bend = firstFollower(dolls.rig, -1);
        const int twist = firstFollower(dolls.rig, bend);
        REQUIRE(twist >= 0);
        addChain(dolls.rig, bend, 0, 1, 0.4F, vec3(0));
        addChain(dolls.rig, twist, 0, 2, 0.7F, glm::normalize(vec3(1, 2, -1)));
        const TaskPool pool;
        DollPoser poser(dolls.rig, dolls.skeleton, pool);
        for (const float alpha : {0.0F, 0.3F, 1.0F}) {
            Skins got(dolls);
            poser.run(dolls.at(alpha), dolls.all, got.palettes, got.frames);
            INFO(count << " dolls at " << alpha);
            CHECK(difference(got, oneByOne(dolls, alpha)) < 2e-5F);
        }
    }
}

TEST_CASE("many dolls at once get the same bits on every instruction set and at every number of threads") {
    const Dolls dolls(60);
    const TaskPool one;
    DollPoser narrow(dolls.rig, dolls.skeleton, one);
    narrow.useInstructionSet(InstructionSet::baseline);
    Skins reference(dolls);
    narrow.run(dolls.at(0.25F), dolls.all, reference.palettes, reference.frames);
    for (const int threads : {1, 2, 3}) {
        const TaskPool pool(threads);
        DollPoser poser(dolls.rig, dolls.skeleton, pool);
        Skins got(dolls);
        poser.run(dolls.at(0.25F), dolls.all, got.palettes, got.frames);
        CHECK(sameBits(got, reference));
    }
}

TEST_CASE("posing many dolls allocates nothing and leaves those that sleep as they were") {
    const Dolls dolls(19);
    const TaskPool pool;
    DollPoser poser(dolls.rig, dolls.skeleton, pool);
    Skins all(dolls);
    Skins some(dolls);
    const Skins untouched(dolls);
    poser.run(dolls.at(1.0F), dolls.all, all.palettes, all.frames);
    const std::vector<int> awake{0, 2, 3, 11, 18};
    const std::size_t before = test::allocationCount();
    poser.run(dolls.at(1.0F), awake, some.palettes, some.frames);
    poser.run(dolls.at(1.0F), awake, some.palettes);
    CHECK(test::allocationCount() == before);
    for (std::size_t i = 0; i < some.palettes.size(); ++i) {
        const int doll = static_cast<int>(i / dolls.joints());
        const bool wanted = std::find(awake.begin(), awake.end(), doll) != awake.end();
        const Skins& expected = wanted ? all : untouched;
        CHECK(std::memcmp(&some.palettes[i], &expected.palettes[i], sizeof(SkinMatrix)) == 0);
    }
}
