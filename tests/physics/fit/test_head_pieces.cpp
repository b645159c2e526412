#include <cmath>
#include <cstdint>

#include "physics/fit/fit_ragdoll.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::physics;

namespace {

// A sheet in front of the face, from the height of the mouth to below the chest: narrow rows above, wide ones below.
void addBeard(animation::Character& biped) {
    constexpr std::uint32_t kColumns = 16;
    constexpr std::uint32_t kRows = 24;
    const int head = test::mapOfBiped(biped).jointOf(Role::head);
    const vec3 joint = biped.skeleton.bindModelFromJoint[head].translation;
    animation::SkinnedMesh& mesh = biped.meshes[0];
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::uint32_t i = 0; i < kColumns * kRows; ++i) {
        const float down = static_cast<float>(i / kColumns) / static_cast<float>(kRows - 1);
        const float across = static_cast<float>(i % kColumns) / static_cast<float>(kColumns - 1) - 0.5F;
        // Most of its points lie near the head, most of its area far below.
        const float low = 0.08F - 0.9F * down * down * down;
        mesh.positions.push_back(joint + vec3(0.34F * across, low, 0.11F));
        mesh.normals.emplace_back(0, 0, 1);
        mesh.joints.push_back({static_cast<std::uint16_t>(head)});
        mesh.weights.push_back({1.0F});
        if (i < kColumns || i % kColumns == 0) continue;
        for (const std::uint32_t index : {i, i - 1, i - kColumns, i - 1, i - kColumns - 1, i - kColumns})
            mesh.indices.push_back(first + index);
    }
    mesh.uvs.clear();
    mesh.tangents.clear();
    mesh.fileOrder.clear();
}

// A brim about the head's middle and a cone above it: larger than the head.
void addHat(animation::Character& biped) {
    constexpr std::uint32_t kCorners = 16;
    const int head = test::mapOfBiped(biped).jointOf(Role::head);
    const vec3 joint = biped.skeleton.bindModelFromJoint[head].translation;
    animation::SkinnedMesh& mesh = biped.meshes[0];
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    std::uint32_t ring = 0;
    for (const vec2& at :
         {vec2(0.35F, 0.11F), vec2(0.23F, 0.11F), vec2(0.11F, 0.11F), vec2(0.07F, 0.22F), vec2(0.02F, 0.36F)}) {
        for (std::uint32_t corner = 0; corner < kCorners; ++corner) {
            const float angle = 2.0F * kPi * static_cast<float>(corner) / kCorners;
            mesh.positions.push_back(joint + vec3(at.x * std::cos(angle), at.y, at.x * std::sin(angle)));
            mesh.normals.emplace_back(0, 1, 0);
            mesh.joints.push_back({static_cast<std::uint16_t>(head)});
            mesh.weights.push_back({1.0F});
            if (ring == 0) continue;
            const std::uint32_t at0 = first + ring * kCorners;
            const std::uint32_t next = (corner + 1) % kCorners;
            for (const std::uint32_t index : {at0 + corner, at0 + next, at0 + next - kCorners, at0 + corner,
                                              at0 + next - kCorners, at0 + corner - kCorners})
                mesh.indices.push_back(index);
        }
        ++ring;
    }
    mesh.uvs.clear();
    mesh.tangents.clear();
    mesh.fileOrder.clear();
}

BodyShape headOf(const animation::Character& biped) {
    const auto fitted = fitRagdoll(biped, test::mapOfBiped(biped), {});
    REQUIRE(fitted);
    for (const BodyProfile& body : fitted.value().bodies)
        if (body.role == Role::head) return body.shape;
    FAIL("a biped has a head");
    return {};
}

}  // namespace

TEST_CASE("a beard that hangs from the face tells nothing of the head's shape") {
    animation::Character biped = test::makeBiped();
    const BodyShape bare = headOf(biped);
    addBeard(biped);
    const BodyShape bearded = headOf(biped);
    CHECK(bearded.radius == Approx(bare.radius).epsilon(0.03));
    CHECK(bearded.halfLength == Approx(bare.halfLength).margin(0.01));
}

TEST_CASE("a hat that is larger than the head is not taken for the skull") {
    animation::Character biped = test::makeBiped();
    const BodyShape bare = headOf(biped);
    addHat(biped);
    const BodyShape hatted = headOf(biped);
    CHECK(hatted.radius == Approx(bare.radius).epsilon(0.15));
    CHECK(hatted.halfLength == Approx(bare.halfLength).margin(0.03));
}
