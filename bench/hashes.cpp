// hashes [SOLVER]: what a crowd of dolls does in a second, as state hashes: a line for every solver (or the one),
// instruction set and number of threads, "SOLVER SET THREADS HASH HASH HASH HASH", a hash every quarter of a second.
// tools/determinism compares the lines of builds. The first line is the hash of the figure that all of them simulate.
#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/random.hpp"
#include "physics/bullet/bullet_world.hpp"
#include "physics/crowd/crowd_world.hpp"
#include "physics/rig/rig.hpp"
#include "support/dolls.hpp"
#include "support/rigs.hpp"

namespace {

using namespace lutka;
using physics::BodyState;
using physics::SolverKind;

constexpr float kFrame = 1.0F / 60.0F;
constexpr int kDolls = 136;  // one heap of so many batches that the crowd solver splits a job over threads
constexpr int kRow = 6;
constexpr int kRounds = 4;
constexpr int kStepsARound = 15;

struct Cast {
    physics::RagdollProfile light = test::makeDoll();
    physics::RagdollProfile heavy = test::makeDoll();
    std::vector<BodyState> standing;

    Cast() {
        for (physics::BodyProfile& body : heavy.bodies)
            body.massKg *= 1.1F;
        const animation::Skeleton skeleton = test::makeBiped().skeleton;
        standing.resize(light.bodies.size());
        bodiesFromPose(physics::bindRig(light, skeleton).value(), skeleton.bindModelFromJoint, {}, standing);
    }
};

physics::StaticShape box(const vec3& centre, const vec3& halfExtents) {
    physics::StaticShape shape;
    shape.kind = physics::StaticShape::Kind::box;
    shape.worldFromShape.translation = centre;
    shape.halfExtents = halfExtents;
    return shape;
}

// A floor with a step, a ball, dolls that fall in a heap, one that is pulled up and one whose joint a motor bends.
void fill(physics::World& world, const Cast& cast) {
    world.addStatic({});
    world.addStatic(box({0, 0.1F, 0}, {1, 0.1F, 1}));
    physics::DynamicProp ball;
    ball.shape.radius = 0.2F;
    ball.massKg = 5.0F;
    ball.state.worldFromBody.translation = {0, 6, 0.1F};
    world.addProp(ball);
    Random random(11);
    std::vector<physics::DollId> dolls;
    for (int i = 0; i < kDolls; ++i) {
        std::vector<BodyState> bodies = cast.standing;
        const vec3 at{0.5F * static_cast<float>(i % kRow) + random.uniform(-0.1F, 0.1F),
                      1.9F * static_cast<float>(i / (kRow * kRow)),
                      0.4F * static_cast<float>(i / kRow % kRow) + random.uniform(-0.1F, 0.1F)};
        for (BodyState& body : bodies) {
            body.worldFromBody.translation += at;
            body.linearVelocity = {random.uniform(-1, 1), 0, random.uniform(-1, 1)};
        }
        dolls.push_back(world.addDoll(i % 2 == 0 ? cast.light : cast.heavy, bodies));
    }
    const vec3 hand = cast.standing[6].worldFromBody.translation;
    world.addDrag({dolls[3], 6, {0, 0, 0}, hand + vec3(0, 3, 0), 600.0F});
    world.setMotor(dolls[5], 4, physics::JointMotor{{1, 0, 0, 0}, 1.0F, 60.0F, 4.0F});
}

std::uint64_t hashOf(const physics::World& world, const Cast& cast) {
    std::uint64_t hash = kHashStart;
    std::vector<BodyState> bodies(cast.standing.size());
    for (const physics::DollId doll : world.dolls()) {
        world.getBodies(doll, bodies);
        hash = hashBytes(bodies.data(), bodies.size() * sizeof(BodyState), hash);
    }
    const BodyState ball = world.propState(world.props()[0]);
    return hashBytes(&ball, sizeof ball, hash);
}

std::unique_ptr<physics::World> worldOf(SolverKind solver, int threads, std::optional<InstructionSet> set) {
    physics::WorldSettings settings;
    settings.solver = solver;
    settings.threads = threads;
    physics::crowd::CrowdTuning tuning;
    tuning.instructionSet = set;
    return solver == SolverKind::crowd ? physics::createCrowdWorld(settings, tuning)
                                       : physics::createBulletWorld(settings);
}

void run(SolverKind solver, const char* setName, std::optional<InstructionSet> set, int threads, const Cast& cast) {
    const auto world = worldOf(solver, threads, set);
    fill(*world, cast);
    std::string line = fmt::format("{} {} {}", physics::solverName(solver), setName, threads);
    for (int round = 0; round < kRounds; ++round) {
        for (int step = 0; step < kStepsARound; ++step)
            world->step(kFrame);
        line += fmt::format(" {:016x}", hashOf(*world, cast));
    }
    fmt::print("{}\n", line);
}

}  // namespace

int main(int argc, char** argv) {
    const Cast cast;
    const auto wanted = [&](SolverKind solver) { return argc < 2 || physics::solverName(solver) == argv[1]; };
    fmt::print("profile - - {:016x}\n", hashBytes(cast.standing.data(), cast.standing.size() * sizeof(BodyState)));
    constexpr std::pair<const char*, InstructionSet> sets[] = {
        {"sse2", InstructionSet::baseline}, {"avx2", InstructionSet::avx2}, {"avx512", InstructionSet::avx512}};
    for (const int threads : {1, 2, 4, 8}) {
        for (const auto& [name, set] : sets)
            if (wanted(SolverKind::crowd) && hasInstructionSet(set)) run(SolverKind::crowd, name, set, threads, cast);
        if (wanted(SolverKind::bullet)) run(SolverKind::bullet, "-", std::nullopt, threads, cast);
    }
    if (wanted(SolverKind::stock)) run(SolverKind::stock, "-", std::nullopt, 1, cast);
    return 0;
}
