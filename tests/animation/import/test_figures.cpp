// Files with several figures: which there are, and which is taken.

#include <algorithm>

#include "animation/humanoid/map_humanoid.hpp"
#include "animation/import/checks.hpp"
#include "animation/import/figure_file.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::animation;
using namespace lutka::test;

namespace {

float tallness(const Character& character) {
    float low = 1e9F;
    float high = -1e9F;
    for (const vec3& p : bindVertices(character)) {
        low = std::min(low, p.y);
        high = std::max(high, p.y);
    }
    return high - low;
}

// A box of that size on one joint, with a skin of its own.
Character boxOnJoint(const std::string& joint, const vec3& size, const vec3& place) {
    Character box;
    box.skeleton.names = {joint};
    box.skeleton.parents = {kNoJoint};
    box.skeleton.bindModelFromJoint = {{quat(1, 0, 0, 0), place}};
    box.skeleton.nodeParentFromJoint = box.skeleton.bindModelFromJoint;
    SkinnedMesh mesh;
    for (int corner = 0; corner < 8; ++corner) {
        const vec3 sign(corner & 1 ? 0.5F : -0.5F, corner & 2 ? 0.5F : -0.5F, corner & 4 ? 0.5F : -0.5F);
        mesh.positions.push_back(place + sign * size);
        mesh.joints.push_back({0, 0, 0, 0});
        mesh.weights.push_back({1, 0, 0, 0});
    }
    mesh.indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                    2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    box.meshes.push_back(std::move(mesh));
    return box;
}

ImportOptions takingFigure(int number) {
    ImportOptions options;
    options.figure = number;
    return options;
}

}  // namespace

TEST_CASE("a file's figures are listed, the largest is taken unless another is asked for") {
    const TemporaryFolder folder;
    makePair().saveBinary(folder / "pair.glb");
    const float height = tallness(makeBiped());
    const Character plain = imported(folder / "pair.glb");
    checkInvariants(plain);
    REQUIRE(plain.figures.size() == 2);
    CHECK(plain.figures[0].name == "Anna");
    CHECK(plain.figures[1].name == "Bert");
    CHECK(plain.figures[1].vertices == 2 * plain.figures[0].vertices);
    CHECK(plain.figure == 1);
    CHECK(tallness(plain) == Approx(0.8F * height));
    CHECK(warns(plain, "Anna (--figure 1)"));

    const Character anna = imported(folder / "pair.glb", takingFigure(1));
    checkInvariants(anna);
    CHECK(anna.figure == 0);
    CHECK(tallness(anna) == Approx(height));
    CHECK(warns(anna, "Bert (--figure 2)"));
    CHECK(bindVertices(imported(folder / "pair.glb", takingFigure(2))) == bindVertices(plain));
}

TEST_CASE("the figure that is taken is the one whose joints are mapped, though others have their names") {
    const TemporaryFolder folder;
    makePair().saveBinary(folder / "pair.glb");
    for (const int number : {1, 2}) {
        INFO(number);
        const Character character = imported(folder / "pair.glb", takingFigure(number));
        const HumanoidMap map = mapHumanoid(character, {});
        REQUIRE(map.humanoid);
        const std::vector<int>& joints = character.figures[number - 1].joints;
        for (const auto& binding : map.roles) {
            if (binding) CHECK(std::binary_search(joints.begin(), joints.end(), binding->joint));
        }
    }
}

TEST_CASE("a figure that is not there is a usage error that says how many there are") {
    const TemporaryFolder folder;
    makePair().saveBinary(folder / "pair.glb");
    makePostRig().saveBinary(folder / "post.glb");
    for (const int number : {0, -1, 3}) {
        const Result<Character> result = importCharacter(folder / "pair.glb", takingFigure(number));
        REQUIRE_FALSE(result.ok());
        CHECK(result.error().code == ErrorCode::usage);
        CHECK_THAT(result.error().message, Catch::Contains("holds 2"));
        CHECK_THAT(result.error().location, Catch::Contains("pair.glb"));
    }
    CHECK(importCharacter(folder / "post.glb", takingFigure(1)).ok());
    CHECK_FALSE(importCharacter(folder / "post.glb", takingFigure(2)).ok());
}

TEST_CASE("a hat on joints of its own goes with the figure that it sits on") {
    const TemporaryFolder folder;
    GltfFile file = makePair();
    for (const float x : {0.0F, 2.0F}) {
        const std::string name = x > 1.0F ? "Bert's hat" : "Anna's hat";
        const int joint = file.addNode(name, -1, mat4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, 1.6F, 0, 1));
        const int mesh = addPostMesh(file, makePost(), mat4(0.1F, 0, 0, 0, 0, 0.1F, 0, 0, 0, 0, 0.1F, 0, 0, 0, 0, 1));
        file.json["meshes"][mesh]["name"] = name;
        const int node = file.addNode("hat", -1);
        file.json["nodes"][node]["mesh"] = mesh;
        file.json["nodes"][node]["skin"] = addSkin(file, {joint, joint, joint}, std::vector<mat4>(3, mat4(1.0F)));
    }
    file.saveBinary(folder / "hats.glb");
    for (const int number : {1, 2}) {
        const Character character = imported(folder / "hats.glb", takingFigure(number));
        const auto has = [&](const std::string& name) {
            return std::any_of(character.meshes.begin(), character.meshes.end(),
                               [&](const SkinnedMesh& mesh) { return mesh.name == name; });
        };
        CHECK(character.figures.size() == 2);
        CHECK(has("Anna's hat") == (number == 1));
        CHECK(has("Bert's hat") == (number == 2));
    }
}

TEST_CASE("a mesh that has nothing to do with the skeleton does not give the figure its height") {
    const TemporaryFolder folder;
    // The bare skeleton of a man, and a post at his hips: tiny, or on no joint and five times his size.
    for (const bool large : {false, true}) {
        INFO(large);
        GltfFile file;
        const Character biped = makeBiped();
        addFigure(file, biped, "Anna");
        const int joints = biped.skeleton.jointCount();
        file.json["meshes"].clear();
        file.json["nodes"].back().erase("mesh");
        file.json["nodes"].back().erase("skin");
        file.json.erase("skins");
        const float size = large ? 5.0F : 0.01F;
        const int mesh =
            addPostMesh(file, makePost(), mat4(size, 0, 0, 0, 0, size, 0, 0, 0, 0, size, 0, 0, 0, 0, 1), false);
        const int node = large ? file.addNode("crate", -1) : 1;  // the armature's first joint
        file.json["nodes"][node]["mesh"] = mesh;
        if (large) {
            nlohmann::json bones;
            for (int joint = 0; joint < joints; ++joint)
                bones[biped.skeleton.names[joint]] = {{"node", joint + 1}};
            file.json["extensions"]["VRMC_vrm"] = {{"specVersion", "1.0"}, {"humanoid", {{"humanBones", bones}}}};
            file.json["extensionsUsed"] = {"VRMC_vrm"};
        }
        file.saveBinary(folder / "bare.glb");
        const Character character = imported(folder / "bare.glb");
        CHECK(character.units.metresPerFileUnit == 1.0F);
        CHECK(mapHumanoid(character, {}).humanoid);
        CHECK(character.meshes.size() == (large ? 0 : 1));
        CHECK(warns(character, large ? "crate" : "hardly any of the skeleton's joints"));
    }
}

TEST_CASE("a second character of other names is one, too, though its arms cross the first one's") {
    const TemporaryFolder folder;
    Character other = makeBiped();
    for (std::string& name : other.skeleton.names)
        name = "mixamorig:" + name;
    GltfFile file;
    addFigure(file, makeBiped(), "Anna");
    addFigure(file, other, "Bert", vec3(1.1F, 0, 0));
    file.saveBinary(folder / "crossing.glb");
    const Character character = imported(folder / "crossing.glb");
    REQUIRE(character.figures.size() == 2);
    CHECK(bindVertices(character).size() == makeBiped().meshes[0].positions.size());
}

TEST_CASE("a prop with a joint and a skin of its own is left out, a hat stays") {
    const TemporaryFolder folder;
    struct Case {
        const char* joint;
        vec3 size;
        vec3 place;
        bool stays;
    };
    for (const Case& prop :
         {Case{"Ground", {8, 0.1F, 8}, {0, -0.05F, 0}, false}, Case{"Crate", {1, 1, 1}, {2.2F, 0.5F, 0}, false},
          Case{"Hat", {0.3F, 0.2F, 0.3F}, {0, 1.85F, 0}, true}}) {
        INFO(prop.joint);
        GltfFile file;
        addFigure(file, makeBiped(), "Anna");
        addFigure(file, boxOnJoint(prop.joint, prop.size, prop.place), std::string(prop.joint) + " armature");
        file.saveBinary(folder / "prop.glb");
        const Character character = imported(folder / "prop.glb");
        CHECK(character.figures.size() == 1);
        CHECK(character.meshes.size() == (prop.stays ? 2 : 1));
        CHECK(warns(character, "left out: " + std::string(prop.joint)) != prop.stays);
        if (!prop.stays) CHECK(tallness(character) == Approx(tallness(makeBiped())));
    }
}

TEST_CASE("a mesh that the file hides is no skin of the figure, unless all of it is hidden") {
    const TemporaryFolder folder;
    const Character biped = makeBiped();
    GltfFile plain;
    addFigure(plain, biped, "Anna");
    plain.saveBinary(folder / "plain.glb");
    const std::vector<vec3> skin = bindVertices(imported(folder / "plain.glb"));

    // A copy below the same armature, bound to the same joints, that a node above it hides.
    GltfFile caged = plain;
    auto& nodes = caged.json["nodes"];
    nlohmann::json body;
    for (const nlohmann::json& node : nodes) {
        if (node.contains("skin")) body = node;
    }
    body["name"] = "Cage";
    const int closet = caged.addNode("Closet", -1);
    nodes.push_back(body);
    const int copy = static_cast<int>(nodes.size()) - 1;
    nodes[closet]["children"] = {copy};
    caged.saveBinary(folder / "twice.glb");
    CHECK(bindVertices(imported(folder / "twice.glb")).size() == 2 * skin.size());
    nodes[closet]["extensions"]["KHR_node_visibility"]["visible"] = false;
    caged.saveBinary(folder / "caged.glb");
    const Character hidden = imported(folder / "caged.glb");
    CHECK(bindVertices(hidden) == skin);
    CHECK(warns(hidden, "1 mesh is hidden in the file and was left out: Cage"));

    for (nlohmann::json& node : nodes) {
        if (node.contains("skin")) node["extensions"]["KHR_node_visibility"]["visible"] = false;
    }
    caged.saveBinary(folder / "all.glb");
    const Character all = imported(folder / "all.glb");
    CHECK(bindVertices(all).size() == 2 * skin.size());
    CHECK_FALSE(warns(all, "hidden"));
}

TEST_CASE("of many hidden meshes the first eight are named, each once") {
    const TemporaryFolder folder;
    GltfFile file;
    addFigure(file, makeBiped(), "Anna");
    auto& nodes = file.json["nodes"];
    nlohmann::json body;
    for (const nlohmann::json& node : nodes) {
        if (node.contains("skin")) body = node;
    }
    body["extensions"]["KHR_node_visibility"]["visible"] = false;
    std::string told;
    for (int i = 0; i < 20; ++i) {
        body["name"] = "Dress " + std::to_string(i / 2);
        nodes[0]["children"].push_back(nodes.size());
        nodes.push_back(body);
        if (i < 16 && i % 2 == 0) told += (i == 0 ? "" : ", ") + std::string(body["name"]);
    }
    file.saveBinary(folder / "dresses.glb");
    CHECK(
        warns(imported(folder / "dresses.glb"), "10 meshes are hidden in the file and were left out: " + told + " …"));
}

TEST_CASE("a hidden body stays where only its eyelashes or a thing without a skin is shown") {
    const TemporaryFolder folder;
    Character biped = makeBiped();
    biped.meshes.push_back(biped.meshes[0]);
    const auto head = static_cast<std::uint16_t>(findJoint(biped.skeleton, "head"));
    for (auto& joints : biped.meshes[1].joints)
        joints = {head, head, head, head};
    GltfFile file;
    addFigure(file, biped, "Anna");
    auto& nodes = file.json["nodes"];
    std::vector<std::size_t> skins;
    for (std::size_t node = 0; node < nodes.size(); ++node) {
        if (nodes[node].contains("skin")) skins.push_back(node);
    }
    REQUIRE(skins.size() == 2);
    const auto hide = [&](std::size_t skin, bool hidden) {
        nodes[skins[skin]]["extensions"]["KHR_node_visibility"]["visible"] = !hidden;
    };
    hide(0, true);
    file.saveBinary(folder / "lashes.glb");
    const Character lashes = imported(folder / "lashes.glb");
    CHECK(lashes.meshes.size() == 2);
    CHECK(warns(lashes, "hidden in the file but kept"));
    hide(0, false);
    hide(1, true);
    file.saveBinary(folder / "body.glb");
    CHECK(imported(folder / "body.glb").meshes.size() == 1);

    // All skin is hidden, and a thing that a joint carries is shown.
    hide(0, true);
    const nlohmann::json axe = {{"name", "Axe"}, {"mesh", nodes[skins[1]]["mesh"]}};
    nodes[1]["children"].push_back(nodes.size());
    nodes.push_back(axe);
    file.saveBinary(folder / "axe.glb");
    CHECK(imported(folder / "axe.glb").meshes.size() == 3);
}

TEST_CASE("a mesh that a clip shows is not left out, though the file begins with it hidden") {
    const TemporaryFolder folder;
    GltfFile file;
    addFigure(file, makeBiped(), "Anna");
    auto& nodes = file.json["nodes"];
    const std::size_t dress = nodes.size();
    nodes.push_back(nodes[dress - 1]);
    nodes[dress]["name"] = "Dress";
    const int closet = file.addNode("Closet", 0);
    nodes[closet]["children"] = {dress};
    nodes[closet]["extensions"]["KHR_node_visibility"]["visible"] = false;
    const std::vector<float> times = {0, 1};
    const std::vector<std::uint8_t> shown = {0, 1};
    const std::vector<float> turn = {0, 0, 0, 1, 0, 0, 0, 1};
    file.addTurn("dress", closet, times, file.addFloats(turn, "VEC4"), "STEP");
    file.json["animations"][0]["samplers"][0]["output"] =
        file.addComponents(std::span<const std::uint8_t>(shown), 5121, "SCALAR", 2, false);
    const auto pointTo = [&](std::size_t node) {
        const std::string pointer = "/nodes/" + std::to_string(node) + "/extensions/KHR_node_visibility/visible";
        file.json["animations"][0]["channels"][0]["target"] = {
            {"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}};
        file.saveBinary(folder / "dress.glb");
        return imported(folder / "dress.glb");
    };
    CHECK(pointTo(static_cast<std::size_t>(closet)).meshes.size() == 2);
    // Below a node that stays hidden nothing is shown.
    const Character hidden = pointTo(dress);
    CHECK(hidden.meshes.size() == 1);
    CHECK(warns(hidden, "Dress"));
}
