#include "animation/pose_batch.hpp"

#include <cstring>
#include <glm/geometric.hpp>
#include <numeric>

#include "animation/pose.hpp"
#include "core/random.hpp"
#include "support/catch.hpp"
#include "support/counting_new.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::animation;

namespace {

struct Instances {
    Skeleton skeleton = test::makeBiped().skeleton;
    std::size_t joints = skeleton.parents.size();
    std::size_t count;
    std::vector<RigidTransform> locals;
    std::vector<int> all;

    explicit Instances(std::size_t instances) : count(instances), all(instances) {
        std::iota(all.begin(), all.end(), 0);
        Random random(11);
        for (std::size_t i = 0; i < count * joints; ++i) {
            RigidTransform frame = skeleton.nodeParentFromJoint[i % joints];
            const quat turn(random.uniform(0.5F, 1.0F), random.uniform(-0.4F, 0.4F), random.uniform(-0.4F, 0.4F),
                            random.uniform(-0.4F, 0.4F));
            frame.rotation = frame.rotation * glm::normalize(turn);
            locals.push_back(frame);
        }
    }
};

struct Poses {
    explicit Poses(const Instances& from) : palettes(from.locals.size()), frames(from.locals.size()) {}
    std::vector<SkinMatrix> palettes;
    std::vector<RigidTransform> frames;

    [[nodiscard]] bool same(const Poses& other) const {
        return std::memcmp(palettes.data(), other.palettes.data(), palettes.size() * sizeof palettes[0]) == 0 &&
               std::memcmp(frames.data(), other.frames.data(), frames.size() * sizeof frames[0]) == 0;
    }
};

// Largest difference of any number of two palettes.
float difference(std::span<const SkinMatrix> a, std::span<const SkinMatrix> b) {
    float worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 4; ++column)
                worst = std::max(worst, std::abs(a[i].rows[row][column] - b[i].rows[row][column]));
        }
    }
    return worst;
}

}  // namespace

TEST_CASE("a batch gives each instance the pose and the palette that it would get alone") {
    for (const std::size_t count : {1, 3, 8, 13}) {
        const Instances instances(count);
        const TaskPool pool;
        PoseBatch batch(instances.skeleton, pool);
        Poses got(instances);
        batch.run(instances.all, instances.locals, got.palettes, got.frames);
        Poses expected(instances);
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t at = i * instances.joints;
            const auto frames = std::span(expected.frames).subspan(at, instances.joints);
            localToModel(instances.skeleton, std::span(instances.locals).subspan(at, instances.joints), frames);
            skinMatrices(instances.skeleton.bindModelFromJoint, frames,
                         std::span(expected.palettes).subspan(at, instances.joints));
        }
        CHECK(difference(got.palettes, expected.palettes) < 1e-5F);
        float worst = 0;
        for (std::size_t i = 0; i < got.frames.size(); ++i) {
            worst = std::max(worst, glm::distance(got.frames[i].translation, expected.frames[i].translation));
            worst = std::max(worst, glm::length(got.frames[i].rotation - expected.frames[i].rotation));
        }
        CHECK(worst < 1e-5F);
    }
}

TEST_CASE("a batch gives the same bits on every instruction set and at every number of threads") {
    const Instances instances(100);
    Poses reference(instances);
    {
        const TaskPool pool;
        PoseBatch batch(instances.skeleton, pool);
        batch.useInstructionSet(InstructionSet::baseline);
        batch.run(instances.all, instances.locals, reference.palettes, reference.frames);
    }
    for (const int threads : {1, 2, 3}) {
        const TaskPool pool(threads);
        PoseBatch batch(instances.skeleton, pool);
        Poses got(instances);
        batch.run(instances.all, instances.locals, got.palettes, got.frames);
        CHECK(got.same(reference));
    }
}

TEST_CASE("a batch leaves the instances that are not asked for and allocates nothing") {
    const Instances instances(20);
    const TaskPool pool;
    PoseBatch batch(instances.skeleton, pool);
    Poses everything(instances);
    batch.run(instances.all, instances.locals, everything.palettes, everything.frames);
    Poses some(instances);
    const Poses untouched(instances);
    const std::vector<int> odd{1, 3, 5, 7, 9, 11, 13, 15, 17, 19};
    const std::size_t before = test::allocationCount();
    batch.run(odd, instances.locals, some.palettes, some.frames);
    CHECK(test::allocationCount() == before);
    for (std::size_t i = 0; i < some.palettes.size(); ++i) {
        const bool wanted = i / instances.joints % 2 == 1;
        const SkinMatrix& expected = wanted ? everything.palettes[i] : untouched.palettes[i];
        CHECK(std::memcmp(&some.palettes[i], &expected, sizeof expected) == 0);
    }
}

TEST_CASE("a batch may write model-space frames over the relative ones") {
    const Instances instances(9);
    const TaskPool pool;
    PoseBatch batch(instances.skeleton, pool);
    Poses apart(instances);
    batch.run(instances.all, instances.locals, apart.palettes, apart.frames);
    std::vector<RigidTransform> inPlace = instances.locals;
    batch.run(instances.all, inPlace, apart.palettes, inPlace);
    CHECK(std::memcmp(inPlace.data(), apart.frames.data(), inPlace.size() * sizeof inPlace[0]) == 0);
}
