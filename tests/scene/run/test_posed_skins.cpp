#include "scene/run/posed_skins.hpp"

#include <cstring>
#include <glm/geometric.hpp>

#include "scene/draw/draw_simulation.hpp"
#include "support/catch.hpp"
#include "support/counting_new.hpp"
#include "support/ragdolls.hpp"

using namespace lutka;
using namespace lutka::scene;

namespace {

// A figure with a tail joint more than makeBiped(), so that two kinds of dolls have palettes of unlike length.
std::unique_ptr<RagdollAsset> tailedRagdoll() {
    animation::Character character = test::makeBiped();
    animation::Skeleton& skeleton = character.skeleton;
    skeleton.names.push_back("tail");
    skeleton.parents.push_back(0);
    skeleton.bindModelFromJoint.push_back(skeleton.bindModelFromJoint[0] * RigidTransform{{}, {0, 0, -0.2F}});
    skeleton.nodeParentFromJoint.push_back({{}, {0, 0, -0.2F}});
    skeleton.skinWeight.push_back(0.0F);
    auto asset = makeRagdoll(std::move(character));
    REQUIRE(asset);
    return std::move(asset).value();
}

struct SkinnedCrowd {
    std::unique_ptr<RagdollAsset> plain = test::bipedRagdoll();
    std::unique_ptr<RagdollAsset> tailed = tailedRagdoll();
    std::unique_ptr<Simulation> simulation;

    explicit SkinnedCrowd(int count, int threads = 1, physics::SolverKind solver = physics::SolverKind::crowd) {
        auto scenario = makeScenario({.name = "spread", .count = count, .seed = 5}, *plain);
        REQUIRE(scenario);
        for (std::size_t doll = 0; doll < scenario.value().dolls.size(); doll += 3)
            scenario.value().dolls[doll].asset = 1;
        SimulationOptions options;
        options.world.threads = threads;
        options.world.solver = solver;
        options.measure = false;
        auto made = Simulation::create({plain.get(), tailed.get()}, std::move(scenario).value(), options);
        REQUIRE(made);
        simulation = std::move(made).value();
    }
    void step(int steps) const {
        for (int i = 0; i < steps; ++i)
            simulation->step();
    }
    [[nodiscard]] bool asleep() const {
        for (int doll = 0; doll < simulation->dollCount(); ++doll)
            if (!simulation->isAsleep(doll)) return false;
        return true;
    }
    void stepUntilAsleep() const {
        for (int i = 0; i < 1500 && !asleep(); ++i)
            simulation->step();
        REQUIRE(asleep());
        step(2);  // the last ones' previous state is their present one too
    }
    [[nodiscard]] std::vector<animation::SkinMatrix> palettes() const {
        // The same call again: everything is in place.
        const PosedSkins& skins = simulation->poseSkins(1.0F);
        std::vector<animation::SkinMatrix> all;
        for (int doll = 0; doll < simulation->dollCount(); ++doll)
            all.insert(all.end(), skins.palette(doll).begin(), skins.palette(doll).end());
        return all;
    }
};

bool sameBits(std::span<const animation::SkinMatrix> a, std::span<const animation::SkinMatrix> b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

// The farthest that a row of a palette or a joint is from what Simulation::pose() and skinMatrices() give.
float differenceToOneByOne(Simulation& simulation, const PosedSkins& skins, float alpha) {
    float worst = 0;
    for (int doll = 0; doll < simulation.dollCount(); ++doll) {
        const animation::Skeleton& skeleton = simulation.assetOf(doll).character.skeleton;
        std::vector<RigidTransform> pose(skeleton.parents.size());
        std::vector<animation::SkinMatrix> palette(pose.size());
        simulation.pose(doll, alpha, pose);
        animation::skinMatrices(skeleton.bindModelFromJoint, pose, palette);
        REQUIRE(skins.palette(doll).size() == palette.size());
        for (std::size_t joint = 0; joint < pose.size(); ++joint) {
            worst =
                std::max(worst, glm::distance(skins.modelFromJoint(doll)[joint].translation, pose[joint].translation));
            for (int row = 0; row < 3; ++row)
                worst = std::max(worst, glm::distance(skins.palette(doll)[joint].rows[row], palette[joint].rows[row]));
        }
    }
    return worst;
}

}  // namespace

TEST_CASE("the skins of a scene are those of its dolls one by one, at every moment between two steps") {
    const SkinnedCrowd crowd(20);
    for (const int steps : {0, 1, 25, 200}) {
        crowd.step(steps);
        for (const float alpha : {0.3F, 1.0F, 0.0F}) {
            INFO(steps << " more steps, alpha " << alpha);
            const PosedSkins& skins = crowd.simulation->poseSkins(alpha);
            CHECK(differenceToOneByOne(*crowd.simulation, skins, alpha) < 2e-5F);
        }
    }
}

TEST_CASE("dolls that sleep are not posed again until they are woken") {
    for (const auto solver : {physics::SolverKind::crowd, physics::SolverKind::bullet}) {
        INFO(physics::solverName(solver));
        const SkinnedCrowd crowd(12, 1, solver);
        CHECK(crowd.simulation->poseSkins(0.5F).posed() == 12);
        crowd.stepUntilAsleep();
        CHECK(crowd.simulation->poseSkins(0.5F).posed() == 12);
        const auto before = crowd.palettes();
        CHECK(crowd.simulation->poseSkins(1.0F).posed() == 0);
        crowd.step(1);
        CHECK(crowd.simulation->poseSkins(0.25F).posed() == 0);
        CHECK(sameBits(crowd.palettes(), before));

        // Straight up, away from its neighbours.
        crowd.simulation->world().applyImpulse(crowd.simulation->world().dolls()[4], 0, {0, 40, 0},
                                               crowd.simulation->worldFromBody(4)[0].translation);
        crowd.step(1);
        const PosedSkins& skins = crowd.simulation->poseSkins(0.25F);
        CHECK(skins.posed() == 1);
        CHECK(differenceToOneByOne(*crowd.simulation, skins, 0.25F) < 2e-5F);
        CHECK_FALSE(sameBits(crowd.palettes(), before));
    }
}

TEST_CASE("a paused scene is posed once for each moment that is shown") {
    const SkinnedCrowd crowd(5);
    crowd.step(10);
    Simulation& simulation = *crowd.simulation;
    CHECK(simulation.poseSkins(0.5F).posed() == 5);
    CHECK(simulation.poseSkins(0.5F).posed() == 0);
    CHECK(simulation.poseSkins(0.6F).posed() == 5);
    CHECK(simulation.poseSkins(1.0F).posed() == 5);
    CHECK(simulation.poseSkins(1.0F).posed() == 0);
}

TEST_CASE("whatever places dolls is seen, and in the step after it too") {
    const SkinnedCrowd crowd(6);
    crowd.stepUntilAsleep();
    Simulation& simulation = *crowd.simulation;
    const auto isRight = [&](float alpha) {
        const PosedSkins& skins = simulation.poseSkins(alpha);
        return differenceToOneByOne(simulation, skins, alpha) < 2e-5F;
    };
    REQUIRE(isRight(0.5F));
    std::vector<physics::BodyState> bodies(simulation.assetOf(2).profile.bodies.size());
    simulation.getBodies(2, bodies);
    for (physics::BodyState& body : bodies)
        body.worldFromBody.translation.y += 0.5F;
    simulation.world().setBodies(simulation.world().dolls()[2], bodies);
    simulation.refresh();
    CHECK(isRight(0.5F));

    std::vector<RigidTransform> frame;
    for (int doll = 0; doll < simulation.dollCount(); ++doll)
        for (RigidTransform body : simulation.worldFromBody(doll)) {
            body.translation.x += 1.0F;
            frame.push_back(body);
        }
    simulation.preview(frame);
    CHECK(isRight(0.5F));
    for (RigidTransform& body : frame)
        body.translation.z += 0.1F;
    simulation.show(frame);
    CHECK(isRight(0.5F));
    simulation.show(frame);  // rests where the last frame came to
    CHECK(isRight(0.5F));
    simulation.refresh();
    CHECK(isRight(0.5F));
    simulation.reset();
    CHECK(isRight(0.5F));
    CHECK(isRight(1.0F));
}

TEST_CASE("skins have the same bits at every number of threads and whenever they were drawn") {
    const SkinnedCrowd one(40);
    const SkinnedCrowd three(40, 3);
    for (int i = 0; i < 30; ++i) {
        one.step(1);
        three.step(1);
        // Only one of them is drawn on the way.
        static_cast<void>(three.simulation->poseSkins(0.1F * static_cast<float>(i % 10)));
    }
    CHECK(sameBits(one.palettes(), three.palettes()));
    one.stepUntilAsleep();
    three.stepUntilAsleep();
    static_cast<void>(three.simulation->poseSkins(0.4F));
    CHECK(sameBits(one.palettes(), three.palettes()));
}

TEST_CASE("drawing a scene allocates nothing once its frame has grown, and tells how many dolls it posed") {
    const SkinnedCrowd crowd(30);
    const std::vector<render::CharacterHandle> characters{{0}, {1}};
    SimulationDrawer drawer;
    render::FrameDescription frame;
    const auto draw = [&](float alpha) {
        frame.clear();
        drawer.draw(*crowd.simulation, characters, {}, alpha, 1.0F, frame);
    };
    draw(1.0F);
    CHECK(drawer.posedDolls() == 30);
    crowd.step(1);
    const std::size_t before = test::allocationCount();
    draw(0.5F);
    CHECK(test::allocationCount() == before);
    CHECK(drawer.posedDolls() == 30);
    draw(0.5F);
    CHECK(test::allocationCount() == before);
    CHECK(drawer.posedDolls() == 0);
    REQUIRE(frame.characters.size() == 30);
    CHECK(frame.characters[3].character.index == 1);
    CHECK(frame.characters[3].palette.size() == crowd.tailed->character.skeleton.parents.size());
}
