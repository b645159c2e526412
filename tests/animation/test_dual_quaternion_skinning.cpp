#include "animation/dual_quaternion_skinning.hpp"

#include <glm/geometric.hpp>

#include "core/random.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::animation;

namespace {

constexpr float kRadius = 0.05F;  // of the forearm
constexpr float kLength = 0.3F;

/// A tube along x from a joint at 0 to a joint at kLength, weighted evenly from the one to the other.
SkinnedMesh makeForearm() {
    SkinnedMesh mesh;
    for (int ring = 0; ring <= 10; ++ring) {
        const float along = static_cast<float>(ring) / 10.0F;
        const bool firstIsStronger = along <= 0.5F;
        for (int side = 0; side < 8; ++side) {
            const float angle = static_cast<float>(side) * kPi / 4.0F;
            const vec3 out(0, std::cos(angle), std::sin(angle));
            mesh.positions.push_back(kRadius * out + vec3(along * kLength, 0, 0));
            mesh.normals.push_back(out);
            const std::uint16_t strong = firstIsStronger ? 0 : 1;
            const auto weak = static_cast<std::uint16_t>(1 - strong);
            const float weight = std::max(along, 1.0F - along);
            mesh.joints.push_back({strong, weak, 0, 0});
            mesh.weights.push_back({weight, 1.0F - weight, 0, 0});
        }
    }
    return mesh;
}

std::vector<SkinMatrix> twisted(float angle) {
    const std::vector<RigidTransform> bind = {{}, {quat(1, 0, 0, 0), vec3(kLength, 0, 0)}};
    std::vector<RigidTransform> pose = bind;
    pose[1].rotation = glm::angleAxis(angle, vec3(1, 0, 0));
    std::vector<SkinMatrix> palette(2);
    skinMatrices(bind, pose, palette);
    return palette;
}

float thinnest(const std::vector<vec3>& positions) {
    float least = 1e9F;
    for (const vec3& position : positions)
        least = std::min(least, std::hypot(position.y, position.z));
    return least;
}

RigidTransform randomMotion(Random& random) {
    const quat rotation(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.1F, 1));
    return {glm::normalize(rotation), {random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)}};
}

}  // namespace

TEST_CASE("a dual quaternion moves points as the matrix that it was made from") {
    Random random(3);
    for (int i = 0; i < 100; ++i) {
        const RigidTransform motion = randomMotion(random);
        const std::vector<RigidTransform> bind(1);
        std::vector<SkinMatrix> palette(1);
        skinMatrices(bind, std::vector<RigidTransform>{motion}, palette);
        SkinnedMesh mesh;
        mesh.positions = {{0.3F, -0.7F, 1.1F}};
        mesh.normals = {{0.6F, 0, 0.8F}};
        mesh.joints = {{0, 0, 0, 0}};
        mesh.weights = {{1, 0, 0, 0}};
        std::vector<vec3> position(1);
        std::vector<vec3> normal(1);
        skinVerticesDual(mesh, palette, position, normal);
        CHECK(glm::distance(position[0], motion * mesh.positions[0]) < 1e-5F);
        CHECK(glm::distance(normal[0], motion.rotation * mesh.normals[0]) < 1e-5F);
    }
}

TEST_CASE("a forearm twisted by 170 degrees keeps its thickness, where linear blending wrings it") {
    const SkinnedMesh forearm = makeForearm();
    const auto palette = twisted(radians(170));
    std::vector<vec3> dual(forearm.positions.size());
    std::vector<vec3> normals(dual.size());
    std::vector<vec3> linear(dual.size());
    skinVertices(SkinningMethod::dualQuaternion, forearm, palette, dual, normals);
    skinVertices(SkinningMethod::linear, forearm, palette, linear, {});
    CHECK(thinnest(dual) > 0.999F * kRadius);
    CHECK(thinnest(linear) < 0.1F * kRadius);  // cos(85°)
    for (std::size_t i = 0; i < dual.size(); ++i) {
        CHECK(glm::distance(normals[i], vec3(0, dual[i].y, dual[i].z) / kRadius) < 1e-3F);
        CHECK(dual[i].x == Approx(forearm.positions[i].x).margin(1e-5));
    }
}

TEST_CASE("the twist runs evenly along the arm, the short way round whatever the quaternions' signs") {
    const SkinnedMesh forearm = makeForearm();
    // Angles on both sides of half a turn and of the whole one, where the sign of a quaternion changes.
    for (const float angleDeg : {-350.0F, -170.0F, -30.0F, 30.0F, 170.0F, 190.0F, 350.0F}) {
        std::vector<vec3> positions(forearm.positions.size());
        skinVerticesDual(forearm, twisted(radians(angleDeg)), positions, {});
        const float shortWay = std::remainder(angleDeg, 360.0F);
        for (std::size_t ring = 0; ring <= 10; ++ring) {
            const vec3& first = positions[ring * 8];
            const float turned = degrees(std::atan2(first.z, first.y));
            // The blend of two rotations: its angle is that of the weighted sum of unit quaternions.
            const float share = static_cast<float>(ring) / 10.0F;
            const float half = 0.5F * radians(shortWay);
            const float exact = 2.0F * degrees(std::atan2(share * std::sin(half), 1 - share + share * std::cos(half)));
            CHECK(turned == Approx(exact).margin(0.05));
        }
    }
}

TEST_CASE("dual quaternions move with the whole figure: skinning and a rigid motion may change places") {
    const Character biped = test::makeBiped();
    Random random(8);
    std::vector<RigidTransform> pose = biped.skeleton.bindModelFromJoint;
    for (RigidTransform& joint : pose)
        joint = joint * RigidTransform{glm::normalize(quat(1, random.uniform(-1, 1), 0.2F, 0)), vec3(0)};
    const RigidTransform motion = randomMotion(random);
    std::vector<RigidTransform> moved = pose;
    for (RigidTransform& joint : moved)
        joint = motion * joint;
    const SkinnedMesh& mesh = biped.meshes[0];
    std::vector<SkinMatrix> palette(pose.size());
    std::vector<vec3> here(mesh.positions.size());
    std::vector<vec3> there(mesh.positions.size());
    skinMatrices(biped.skeleton.bindModelFromJoint, pose, palette);
    skinVerticesDual(mesh, palette, here, {});
    skinMatrices(biped.skeleton.bindModelFromJoint, moved, palette);
    skinVerticesDual(mesh, palette, there, {});
    float worst = 0.0F;
    for (std::size_t i = 0; i < here.size(); ++i)
        worst = std::max(worst, glm::distance(motion * here[i], there[i]));
    CHECK(worst < 1e-4F);
}
