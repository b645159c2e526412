#include <filesystem>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "animation/export/write_glb.hpp"
#include "animation/pose.hpp"
#include "support/catch.hpp"
#include "support/command.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::animation;
using namespace lutka::test;

namespace {

// The biped that rises by `height` in a second, a second a frame.
Clip rising(const Skeleton& skeleton, float height) {
    std::vector<RigidTransform> pose(skeleton.parents.size());
    modelToLocal(skeleton, skeleton.bindModelFromJoint, pose);
    Clip clip;
    clip.name = "rise";
    clip.framesPerSecond = 1.0F;
    clip.frameCount = 2;
    clip.parentFromJoint.append(pose);
    pose[0].translation.y += height;
    clip.parentFromJoint.append(pose);
    return clip;
}

nlohmann::json jsonOf(const std::string& file) {
    const std::string bytes = fileText(file);
    const auto at = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>(bytes[i])); };
    const std::size_t length = at(12) | at(13) << 8U | at(14) << 16U | at(15) << 24U;
    return nlohmann::json::parse(bytes.substr(20, length));
}

}  // namespace

TEST_CASE("figures of a crowd share meshes, materials and bind matrices, and move in one animation") {
    const ScratchFolder folder;
    Character biped = makeBiped();
    Texture white{"white", 1, 1, {255, 255, 255, 255}};
    biped.textures.push_back(white);
    biped.materials.front().baseColorTexture = 0;
    const Character other = biped;
    const std::vector<Clip> clips = {rising(biped.skeleton, 1), rising(biped.skeleton, 2), rising(other.skeleton, 3)};
    const std::vector<GlbFigure> figures = {{&biped, &clips[0], {}},
                                            {&biped, &clips[1], {quat(1, 0, 0, 0), vec3(2, 0, 0)}},
                                            {&other, &clips[2], {quat(1, 0, 0, 0), vec3(4, 0, 0)}}};
    const std::string file = folder / "crowd.glb";
    REQUIRE(writeGlbCrowd(file, "crowd", figures).ok());
    const auto json = jsonOf(file);
    const std::size_t meshes = biped.meshes.size();
    CHECK(json["meshes"].size() == 2 * meshes);  // of two characters, not of three figures
    CHECK(json["materials"].size() == 2 * biped.materials.size());
    CHECK(json["textures"].size() == 2);
    REQUIRE(json["skins"].size() == 3);
    CHECK(json["skins"][0]["inverseBindMatrices"] == json["skins"][1]["inverseBindMatrices"]);
    CHECK(json["skins"][0]["inverseBindMatrices"] != json["skins"][2]["inverseBindMatrices"]);
    REQUIRE(json["animations"].size() == 1);
    REQUIRE(json["animations"][0]["channels"].size() == 3);
    std::set<int> targets;
    for (const auto& channel : json["animations"][0]["channels"])
        targets.insert(channel["target"]["node"].get<int>());
    CHECK(targets.size() == 3);
    // Materials and textures of the second character are its own.
    CHECK(json["meshes"][meshes]["primitives"][0]["material"] == biped.materials.size());
    CHECK(json["materials"][biped.materials.size()]["pbrMetallicRoughness"]["baseColorTexture"]["index"] == 1);
    int skinned = 0;
    for (const auto& node : json["nodes"])
        skinned += node.contains("skin") && node.contains("mesh") ? 1 : 0;
    CHECK(skinned == static_cast<int>(3 * meshes));
}
