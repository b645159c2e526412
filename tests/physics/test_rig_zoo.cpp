#include <algorithm>
#include <fstream>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "animation/humanoid/map_humanoid.hpp"
#include "animation/import/import_character.hpp"
#include "physics/fit_ragdoll.hpp"
#include "physics/rig.hpp"
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

TEST_CASE("the bind pose of every humanoid of the zoo comes back through its bodies", "[rig][zoo]") {
    if (!test::zooIsThere()) return;
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
        ++checked;
    }
    CHECK(checked >= 10);
}
