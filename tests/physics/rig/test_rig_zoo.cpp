#include <algorithm>
#include <fstream>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "animation/humanoid/map_humanoid.hpp"
#include "animation/import/import_character.hpp"
#include "core/random.hpp"
#include "physics/fit/fit_ragdoll.hpp"
#include "physics/rig/doll_poser.hpp"
#include "physics/rig/rig.hpp"
#include "support/catch.hpp"
#include "support/zoo.hpp"

using namespace lutka;

namespace {

// The models of the zoo, by their truth files; mapping tells which are humanoids.
std::vector<std::filesystem::path> models() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(LUTKA_ZOO_DIR)) {
        std::ifstream truth(entry.path() / "truth.json");
        if (!truth) continue;
        const nlohmann::json document = nlohmann::json::parse(truth, nullptr, false);
        if (document.is_object() && document.contains("file"))
            files.push_back(entry.path() / document["file"].get<std::string>());
    }
    std::sort(files.begin(), files.end());
    return files;
}

// Poses eight dolls with bent joints at once and each alone; the largest difference of any number of a palette.
float worstOfManyAtOnce(const physics::Rig& rig, const animation::Skeleton& skeleton) {
    constexpr std::size_t dolls = 8;
    const std::size_t joints = skeleton.parents.size();
    Random random(23);
    std::vector<RigidTransform> worldFromBody;
    std::vector<physics::BodyState> bodies(rig.jointOfBody.size());
    for (std::size_t doll = 0; doll < dolls; ++doll) {
        std::vector<RigidTransform> pose = skeleton.bindModelFromJoint;
        for (RigidTransform& frame : pose)
            frame.rotation = frame.rotation * glm::angleAxis(random.uniform(-1.0F, 1.0F), vec3(0, 0, 1));
        physics::bodiesFromPose(rig, pose, {}, bodies);
        for (const physics::BodyState& body : bodies)
            worldFromBody.push_back(body.worldFromBody);
    }
    const TaskPool pool;
    const std::vector<RigidTransform> worldFromModel(dolls);
    std::vector<animation::SkinMatrix> palettes(dolls * joints);
    physics::DollPoser(rig, skeleton, pool)
        .run({{}, worldFromBody, 1.0F, worldFromModel, {}, {}}, std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7}, palettes);
    float worst = 0;
    std::vector<RigidTransform> pose(joints);
    std::vector<animation::SkinMatrix> palette(joints);
    for (std::size_t doll = 0; doll < dolls; ++doll) {
        physics::poseFromBodies(rig, skeleton, std::span(worldFromBody).subspan(doll * bodies.size(), bodies.size()),
                                {}, pose);
        skinMatrices(skeleton.bindModelFromJoint, pose, palette);
        for (std::size_t joint = 0; joint < joints; ++joint) {
            for (int row = 0; row < 3; ++row)
                worst =
                    std::max(worst, glm::distance(palettes[doll * joints + joint].rows[row], palette[joint].rows[row]));
        }
    }
    return worst;
}

// Largest distance that a joint's origin, or a point at an arm's length from it, is from the bind pose.
float worstOffset(const animation::Skeleton& skeleton, const std::vector<RigidTransform>& pose, float arm) {
    float worst = 0;
    for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
        const RigidTransform& bind = skeleton.bindModelFromJoint[joint];
        for (const vec3& point : {vec3(0), vec3(arm, 0, 0), vec3(0, arm, 0)})
            worst = std::max(worst, glm::distance(pose[joint] * point, bind * point));
    }
    return worst;
}

}  // namespace

TEST_CASE("the bind pose of every humanoid of the zoo comes back through its bodies, alone and beside others",
          "[rig][zoo]") {
    NEEDS_ZOO();
    const RigidTransform somewhere{glm::angleAxis(0.7F, glm::normalize(vec3(1, 2, 3))), {4, -1, 2}};
    int checked = 0;
    for (const std::filesystem::path& file : models()) {
        INFO(file.filename().string());
        animation::ImportOptions options;
        options.loadTextures = false;
        const auto character = importCharacter(file, options);
        if (!character.ok()) continue;  // importing has tests of its own
        const animation::HumanoidMap map = mapHumanoid(character.value());
        if (!map.humanoid) continue;
        const auto profile = physics::fitRagdoll(character.value(), map);
        REQUIRE(profile.ok());
        const animation::Skeleton& skeleton = character.value().skeleton;
        const auto rig = physics::bindRig(profile.value(), skeleton);
        REQUIRE(rig.ok());
        std::vector<physics::BodyState> bodies(profile.value().bodies.size());
        physics::bodiesFromPose(rig.value(), skeleton.bindModelFromJoint, somewhere, bodies);
        std::vector<RigidTransform> worldFromBody;
        for (const physics::BodyState& body : bodies)
            worldFromBody.push_back(body.worldFromBody);
        std::vector<RigidTransform> pose(skeleton.bindModelFromJoint.size());
        physics::poseFromBodies(rig.value(), skeleton, worldFromBody, somewhere, pose);
        const float height = profile.value().heightM;
        CHECK(worstOffset(skeleton, pose, 0.1F * height) < 1e-4F * height);
        CHECK(worstOfManyAtOnce(rig.value(), skeleton) < 5e-5F * std::max(height, 1.0F));
        ++checked;
    }
    CHECK(checked >= 10);
}
