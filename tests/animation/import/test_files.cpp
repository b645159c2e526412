// Files that are broken, refused, oddly named, in odd units or without their pictures.

#include <cstring>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <sstream>

#include "animation/import/checks.hpp"
#include "animation/import/gltf_file.hpp"
#include "core/files.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::animation;
using namespace lutka::test;

namespace {

// A box 100 × 60 × 180 (x, y, z) on the floor of a Z-up scene, as an ASCII FBX with these global settings.
std::string boxFbx(int upAxis, int upSign, double unit) {
    std::ostringstream out;
    out << "; FBX 7.4.0 project file\n"
           "FBXHeaderExtension:  {\n FBXHeaderVersion: 1003\n FBXVersion: 7400\n}\n"
           "GlobalSettings:  {\n Version: 1000\n Properties70:  {\n"
        << "  P: \"UpAxis\", \"int\", \"Integer\", \"\"," << upAxis << "\n"
        << "  P: \"UpAxisSign\", \"int\", \"Integer\", \"\"," << upSign << "\n"
        << "  P: \"UnitScaleFactor\", \"double\", \"Number\", \"\"," << unit << "\n"
        << " }\n}\n"
           "Objects:  {\n"
           " Geometry: 1, \"Geometry::Box\", \"Mesh\" {\n"
           "  Vertices: *24 {\n   a: -50,-30,0,50,-30,0,50,30,0,-50,30,0,"
           "-50,-30,180,50,-30,180,50,30,180,-50,30,180\n  }\n"
           "  PolygonVertexIndex: *24 {\n   a: 0,3,2,-2,4,5,6,-8,0,1,5,-5,1,2,6,-6,2,3,7,-7,3,0,4,-8\n  }\n"
           "  GeometryVersion: 124\n }\n"
           " Model: 2, \"Model::Box\", \"Mesh\" {\n  Version: 232\n }\n"
           "}\n"
           "Connections:  {\n C: \"OO\",2,0\n C: \"OO\",1,2\n}\n";
    return out.str();
}

Error refusal(const std::filesystem::path& file) {
    const Result<Character> result = importCharacter(file);
    REQUIRE_FALSE(result.ok());
    CHECK(result.error().code == ErrorCode::input);
    CHECK(result.error().location == file.string());
    return result.error();
}

float heightOf(const Character& character) {
    float low = std::numeric_limits<float>::max();
    float high = std::numeric_limits<float>::lowest();
    for (const vec3& p : bindVertices(character)) {
        low = std::min(low, p.y);
        high = std::max(high, p.y);
    }
    return high - low;
}

}  // namespace

TEST_CASE("a missing file, a folder and a text are refused with a reason") {
    const TemporaryFolder folder;
    CHECK(refusal(folder / "none.fbx").message == "there is no such file");
    CHECK(refusal(folder / ".").message == "is a folder, not a model");
    std::ofstream(folder / "poem.fbx") << "no model at all";
    CHECK_FALSE(refusal(folder / "poem.fbx").message.empty());
    std::ofstream(folder / "poem.xyz") << "no model at all";
    CHECK_FALSE(refusal(folder / "poem.xyz").message.empty());
    std::ofstream(folder / "empty.glb") << "";
    CHECK_FALSE(refusal(folder / "empty.glb").message.empty());
}

TEST_CASE("a model whose other half is in a file that is missing is refused with that file's name and place") {
    const TemporaryFolder folder;
    // The header of a model of Half-Life, one bone and one part, without pictures: those are in heroT.mdl.
    constexpr std::size_t size = 244;
    std::string header(size, '\0');
    const auto put = [&](std::size_t at, std::int32_t value) { std::memcpy(header.data() + at, &value, sizeof value); };
    std::memcpy(header.data(), "IDST", 4);
    put(4, 10);                                   // version
    for (const std::size_t end : {72, 144, 208})  // of the file, bones, parts
        put(end, size);
    for (const std::size_t count : {140, 204})
        put(count, 1);
    std::ofstream(folder / "hero.mdl", std::ios::binary) << header;
    const Error error = refusal(folder / "hero.mdl");
    CHECK(error.message.find("heroT.mdl") != std::string::npos);
    CHECK(error.mend.find("put heroT.mdl beside") != std::string::npos);
}

TEST_CASE("glTF 1.0 is refused by its version, also where that is a number") {
    const TemporaryFolder folder;
    for (const nlohmann::json& version : {nlohmann::json(1), nlohmann::json(1.1), nlohmann::json("1.0")}) {
        GltfFile file = makePostRig();
        file.json["asset"]["version"] = version;
        file.saveText(folder / "rig.gltf");
        CHECK(refusal(folder / "rig.gltf").message.find("is glTF 1") != std::string::npos);
    }
}

TEST_CASE("required extensions that can't be read are refused by name with a mend") {
    const TemporaryFolder folder;
    for (const char* extension : {"EXT_mesh_gpu_instancing", "ACME_geometry"}) {
        INFO(extension);
        GltfFile file = makePostRig();
        file.json["extensionsRequired"] = {extension};
        file.json["extensionsUsed"] = {extension};
        file.saveText(folder / "rig.gltf");
        file.saveBinary(folder / "rig.glb");
        for (const char* name : {"rig.gltf", "rig.glb"}) {
            const Error error = refusal(folder / name);
            CHECK(error.message.find(extension) != std::string::npos);
            CHECK_FALSE(error.mend.empty());
        }
    }
}

TEST_CASE("required extensions that only cost looks are let through") {
    const TemporaryFolder folder;
    GltfFile file = makePostRig();
    file.json["extensionsRequired"] = {"KHR_materials_unlit",  "KHR_texture_basisu", "MSFT_lod",
                                       "EXT_lights_ies",       "KHR_interactivity",  "GOOGLE_texture_basis",
                                       "KHR_techniques_webgl", "CESIUM_RTC"};
    file.saveText(folder / "rig.gltf");
    const Character character = imported(folder / "rig.gltf");
    for (const char* told : {"KHR_texture_basisu", "GOOGLE_texture_basis", "KHR_techniques_webgl"})
        CHECK(warns(character, told));
    for (const char* silent : {"KHR_materials_unlit", "MSFT_lod", "EXT_lights_ies", "KHR_interactivity", "CESIUM_RTC"})
        CHECK_FALSE(warns(character, silent));
}

TEST_CASE("copies of a mesh, points and lines, and clips of what is not in the scene are told") {
    const TemporaryFolder folder;
    GltfFile file = makePostRig();
    file.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    nlohmann::json lines = file.json["meshes"][0]["primitives"][0];
    lines["mode"] = 1;
    file.json["meshes"][0]["primitives"].push_back(lines);
    const int ghost = static_cast<int>(file.json["nodes"].size());
    file.json["nodes"].push_back({{"name", "Ghost"}});
    const std::vector<float> times{0, 1};
    const std::vector<float> turns{0, 0, 0, 1, 1, 0, 0, 0};
    file.addTurn("haunt", ghost, times, file.addFloats(turns, "VEC4"), "LINEAR");
    file.saveBinary(folder / "rig.glb");
    const Character character = imported(folder / "rig.glb");
    CHECK(character.clips.empty());
    for (const char* told :
         {"EXT_mesh_gpu_instancing", "points and lines", "animations of nodes that are not in the scene"})
        CHECK(warns(character, told));
}

TEST_CASE("a glTF is told by its content, whichever of glTF's names it bears") {
    const TemporaryFolder folder;
    makePostRig().saveText(folder / "text.glb");
    makePostRig().saveBinary(folder / "binary.gltf");
    CHECK(imported(folder / "text.glb").skeleton.names == imported(folder / "binary.gltf").skeleton.names);
}

TEST_CASE("a .vrm is read as the glTF that it is, and its humanoid block too") {
    const TemporaryFolder folder;
    GltfFile file = makePostRig();
    const auto check = [&] {
        file.saveBinary(folder / "rig.vrm");
        const Character character = imported(folder / "rig.vrm");
        checkInvariants(character);
        REQUIRE(character.vrmHumanoid.count("hips") == 1);
        CHECK(character.skeleton.names[character.vrmHumanoid.at("hips")] == "low");
        REQUIRE(character.vrmHumanoid.count("leftThumbProximal") == 1);
        CHECK(character.skeleton.names[character.vrmHumanoid.at("leftThumbProximal")] == "high");
        CHECK(character.vrmHumanoid.size() == 2);
        CHECK(warns(character, "node 99"));
    };
    SECTION("VRM 1.0") {
        file.json["extensions"]["VRMC_vrm"]["humanoid"]["humanBones"] = {
            {"hips", {{"node", 1}}}, {"leftThumbProximal", {{"node", 3}}}, {"head", {{"node", 99}}}};
        check();
    }
    SECTION("VRM 0.x") {
        file.json["extensions"]["VRM"]["humanoid"]["humanBones"] = {{{"bone", "hips"}, {"node", 1}},
                                                                    {{"bone", "leftThumbIntermediate"}, {"node", 3}},
                                                                    {{"bone", "head"}, {"node", 99}}};
        check();
    }
    SECTION("several roots and a repeated name") {
        file.json["nodes"][4]["name"] = "low";
        file.addNode("other", -1);
        file.json["extensions"]["VRMC_vrm"]["humanoid"]["humanBones"] = {
            {"hips", {{"node", 1}}}, {"leftThumbProximal", {{"node", 3}}}, {"head", {{"node", 99}}}};
        check();
    }
}

TEST_CASE("a truncated file is refused at every length") {
    const TemporaryFolder folder;
    makePostRig().saveBinary(folder / "whole.glb");
    const auto bytes = readFile(folder / "whole.glb");
    REQUIRE(bytes.ok());
    const std::string whole(bytes.value().begin(), bytes.value().end());
    for (std::size_t length = 0; length < whole.size() - 4; length += 97) {
        INFO(length << " of " << whole.size() << " bytes");
        std::ofstream(folder / "cut.glb", std::ios::binary | std::ios::trunc) << whole.substr(0, length);
        refusal(folder / "cut.glb");
    }
}

TEST_CASE("a picture that is missing leaves the material plain, with one warning") {
    const TemporaryFolder folder;
    GltfFile file = makePostRig();
    file.json["images"] = {{{"uri", "nowhere.png"}}};
    file.json["textures"] = {{{"source", 0}}};
    file.json["materials"] = {
        {{"name", "cloth"},
         {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}, {"roughnessFactor", 0.25}}}}};
    file.json["meshes"][0]["primitives"][0]["material"] = 0;
    file.saveText(folder / "rig.gltf");
    const Character character = imported(folder / "rig.gltf");
    REQUIRE_FALSE(character.materials.empty());
    CHECK(character.materials[0].name == "cloth");
    CHECK(character.materials[0].baseColorTexture == Material::kNoTexture);
    CHECK(character.materials[0].roughness == Approx(0.25F));
    CHECK(warns(character, "nowhere.png"));
    ImportOptions plain;
    plain.loadTextures = false;
    CHECK(imported(folder / "rig.gltf", plain).warnings.empty());
}

TEST_CASE("a picture is found by its base name beside an OBJ written on Windows") {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "textures");
    // A binary PPM: one red and one blue pixel.
    std::ofstream(folder / "textures/Skin.ppm", std::ios::binary) << "P6 2 1 255\n"
                                                                  << std::string("\xff\0\0\0\0\xff", 6);
    std::ofstream(folder / "post.mtl") << "newmtl skin\nKd 0.5 0.5 0.5\nmap_Kd C:\\art\\skin.ppm\n";
    std::ofstream(folder / "post.obj") << "mtllib post.mtl\nusemtl skin\nv 0 0 0\nv 1 0 0\nv 0 1.7 0\nvt 0 0\nvt 1 0\n"
                                          "vt 0 1\nf 1/1 2/2 3/3\n";
    const Character character = imported(folder / "post.obj");
    checkInvariants(character);
    REQUIRE(character.textures.size() == 1);
    const Texture& texture = character.textures[0];
    CHECK(texture.name == "Skin.ppm");
    CHECK(texture.width == 2);
    CHECK(texture.height == 1);
    CHECK(texture.rgba == std::vector<std::uint8_t>{255, 0, 0, 255, 0, 0, 255, 255});
    CHECK(character.materials[character.meshes[0].material].baseColorTexture == 0);
    // glTF's v runs down.
    CHECK(character.meshes[0].uvs[0].y == Approx(1.0F));
}

TEST_CASE("a black material whose picture is missing is made neutral, so that the figure can be seen") {
    const TemporaryFolder folder;
    std::ofstream(folder / "post.mtl") << "newmtl skin\nKd 0 0 0\nmap_Kd gone.png\n";
    std::ofstream(folder / "post.obj") << "mtllib post.mtl\nusemtl skin\nv 0 0 0\nv 1 0 0\nv 0 1.7 0\nvt 0 0\nvt 1 0\n"
                                          "vt 0 1\nf 1/1 2/2 3/3\n";
    const Character character = imported(folder / "post.obj");
    const Material& material = character.materials[character.meshes[0].material];
    CHECK(material.baseColorTexture == Material::kNoTexture);
    CHECK(material.baseColor.r == Approx(Material{}.baseColor.r));
    CHECK(character.warnings.size() == 1);
}

TEST_CASE("an absurd height is brought to a person's, with a warning") {
    struct Case {
        float scale;
        float metresPerUnit;
        float height;
    };
    const TemporaryFolder folder;
    for (const Case& each :
         {Case{100.0F, 0.01F, 1.8F}, Case{0.01F, 100.0F, 1.8F}, Case{10.0F, 0.1F, 1.8F},
          Case{1.0F / 0.0254F, 0.0254F, 1.8F}, Case{1000.0F, 0.001F, 1.8F}, Case{2.5F, 1.75F / 4.5F, 1.75F}}) {
        INFO(each.scale);
        GltfFile larger;
        const int root = larger.addNode("Armature", -1);
        std::vector<int> nodes;
        std::vector<mat4> binds;
        int parent = root;
        for (int i = 0; i < 3; ++i) {
            const float step = 0.6F * each.scale;
            parent = larger.addNode("j" + std::to_string(i), parent,
                                    glm::translate(mat4(1.0F), vec3(0, i == 0 ? 0.0F : step, 0)));
            nodes.push_back(parent);
            binds.push_back(glm::translate(mat4(1.0F), vec3(0, -step * static_cast<float>(i), 0)));
        }
        const int body = larger.addNode("Body", -1);
        larger.json["nodes"][body]["mesh"] = addPostMesh(larger, makePost(), glm::scale(mat4(1.0F), vec3(each.scale)));
        larger.json["nodes"][body]["skin"] = addSkin(larger, nodes, binds);
        larger.saveText(folder / "rig.gltf");
        const Character character = imported(folder / "rig.gltf");
        checkInvariants(character);
        CHECK(heightOf(character) == Approx(each.height).epsilon(1e-4));
        CHECK(character.units.metresPerFileUnit == Approx(each.metresPerUnit).epsilon(1e-4));
        CHECK(character.units.unitSource == "height of the figure");
        CHECK(warns(character, "--scale"));
    }
}

TEST_CASE("a child, a short robot and a giant keep their stated size") {
    const TemporaryFolder folder;
    for (const float factor : {0.2F, 0.5F, 1.0F, 1.9F}) {
        GltfFile file = makePostRig();
        file.json["nodes"][0]["scale"] = {factor, factor, factor};
        file.saveText(folder / "rig.gltf");
        const Character character = imported(folder / "rig.gltf");
        CHECK(heightOf(character) == Approx(1.8F * factor));
        CHECK(character.warnings.empty());
    }
}

TEST_CASE("the options override units and up axis") {
    const TemporaryFolder folder;
    makePostRig().saveText(folder / "rig.gltf");
    ImportOptions options;
    options.metresPerFileUnit = 2.0F;
    const Character larger = imported(folder / "rig.gltf", options);
    CHECK(heightOf(larger) == Approx(3.6F));
    CHECK(larger.units.unitSource == "--scale");
    for (const float wrong : {0.0F, -1.0F, std::numeric_limits<float>::quiet_NaN()}) {
        options.metresPerFileUnit = wrong;
        const Result<Character> result = importCharacter(folder / "rig.gltf", options);
        REQUIRE_FALSE(result.ok());
        CHECK(result.error().code == ErrorCode::usage);
    }
    const std::array<UpAxis, 6> all = {UpAxis::positiveX, UpAxis::negativeX, UpAxis::positiveY,
                                       UpAxis::negativeY, UpAxis::positiveZ, UpAxis::negativeZ};
    const std::array<vec3, 6> axes = {vec3(1, 0, 0),  vec3(-1, 0, 0), vec3(0, 1, 0),
                                      vec3(0, -1, 0), vec3(0, 0, 1),  vec3(0, 0, -1)};
    const Post post = makePost();
    for (std::size_t i = 0; i < all.size(); ++i) {
        options.metresPerFileUnit = 1.0F;
        options.up = all[i];
        const Character turned = imported(folder / "rig.gltf", options);
        checkInvariants(turned);
        CHECK(turned.units.upSource == "--up");
        const std::vector<vec3> vertices = bindVertices(turned);
        for (std::size_t v = 0; v < vertices.size(); ++v)
            CHECK(vertices[v].y == Approx(glm::dot(post.positions[v], axes[i])).margin(1e-5));
    }
}

TEST_CASE("a figure that plainly stands along another axis than the file says is put upright") {
    const TemporaryFolder folder;
    // +Z up inside a glTF, which is +Y up by definition.
    GltfFile file = makePostRig();
    file.json["nodes"][0]["matrix"] = std::vector<float>{1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1};
    file.saveText(folder / "rig.gltf");
    const Character character = imported(folder / "rig.gltf");
    CHECK(heightOf(character) == Approx(1.8F));
    CHECK(character.units.upAxis == "+Z");
    CHECK(character.units.upSource == "the figure");
    CHECK(warns(character, "--up"));
}

TEST_CASE("one vertex that is not finite costs its triangles and a warning") {
    const TemporaryFolder folder;
    GltfFile file = makePostRig();
    Post post = makePost();
    post.positions[0].y = std::numeric_limits<float>::quiet_NaN();
    file.json["nodes"][4]["mesh"] = addPostMesh(file, post);
    // JSON knows no NaN: the bounds must not carry it.
    for (nlohmann::json& accessor : file.json["accessors"]) {
        accessor.erase("min");
        accessor.erase("max");
    }
    file.saveText(folder / "rig.gltf");
    const Character character = imported(folder / "rig.gltf");
    checkInvariants(character);
    CHECK(warns(character, "1 vertices have no finite position"));
    CHECK(character.meshes[0].positions.size() == 15);
    CHECK(character.meshes[0].indices.size() == 3 * (24 - 3));
}

TEST_CASE("units and up axis of an FBX come from its global settings") {
    struct Case {
        int upAxis;
        int upSign;
        double unit;
        float metresPerUnit;
        float height;
        const char* axis;
        const char* unitSource;
    };
    const TemporaryFolder folder;
    for (const Case& each : {Case{2, 1, 1.0, 0.01F, 1.8F, "+Z", "FBX UnitScaleFactor"},
                             Case{2, -1, 1.0, 0.01F, 1.8F, "-Z", "FBX UnitScaleFactor"},
                             Case{0, 1, 1.0, 0.01F, 1.0F, "+X", "FBX UnitScaleFactor"},
                             Case{2, 1, 0.5, 0.005F, 0.9F, "+Z", "FBX UnitScaleFactor"},
                             Case{2, 1, 100.0, 0.01F, 1.8F, "+Z", "height of the figure"}}) {
        INFO(each.axis << ' ' << each.unit);
        std::ofstream(folder / "box.fbx") << boxFbx(each.upAxis, each.upSign, each.unit);
        const Character character = imported(folder / "box.fbx");
        checkInvariants(character);
        CHECK(character.units.upAxis == each.axis);
        CHECK(character.units.upSource == "FBX UpAxis");
        CHECK(character.units.unitSource == each.unitSource);
        CHECK(character.units.metresPerFileUnit == Approx(each.metresPerUnit));
        CHECK(heightOf(character) == Approx(each.height));
        float lowest = 1e9F;
        for (const vec3& p : bindVertices(character))
            lowest = std::min(lowest, p.y);
        if (each.upAxis == 2) CHECK(lowest == Approx(each.upSign > 0 ? 0.0F : -1.8F).margin(1e-5));
    }
}

TEST_CASE("a format that is known but not read is refused by its name, with a way out") {
    const TemporaryFolder folder;
    struct Case {
        const char* file;
        std::string bytes;
        const char* says;
    };
    for (const Case& one :
         {Case{"jack.mdl", "UMDL" + std::string(60, '\0'), "Urho3D"},
          Case{"miku.pmd", std::string("Pmd\0\0\x80\x3f", 7) + "Miku", "MikuMikuDance"},
          Case{"scene.max", "\xD0\xCF\x11\xE0 and more", "3ds Max"}, Case{"rig.ma", "//Maya ASCII 2020 scene", "Maya"},
          Case{"a.usda", "#usda 1.0", "USD"}, Case{"a.USDZ", "PK\x03\x04", "USD"},
          Case{"hero.prefab", "%YAML 1.1", "Unity"}, Case{"hero.scn", "RSRC", "Godot"},
          Case{"hero.blend", "BLENDER-v279", "a scene of Blender"}}) {
        INFO(one.file);
        const auto file = folder / one.file;
        REQUIRE(writeFileAtomically(file, one.bytes));
        const Error error = refusal(file);
        CHECK_THAT(error.message, Catch::Contains(one.says));
        CHECK_FALSE(error.mend.empty());
    }
}

TEST_CASE("what the readers of other formats say of a file is told in plain words") {
    const TemporaryFolder folder;
    const std::string head = "<?xml version=\"1.0\"?><COLLADA version=\"1.4.1\">";
    struct Case {
        const char* file;
        std::string bytes;
        const char* says;
    };
    for (const Case& one : {Case{"notes.foo", "shopping: bread, butter", "is of no format that is read"},
                            Case{"cut.dae", head + "<library_geometries><geometry id=", "its XML is broken or cut off"},
                            Case{"bare.dae", head + "<asset/></COLLADA>", "holds no scene with meshes or joints"},
                            Case{"walk01.mdl", std::string("IDSQ\n\0\0\0", 8) + std::string(400, '\0'),
                                 "holds motions of a Half-Life model"}}) {
        INFO(one.file);
        REQUIRE(writeFileAtomically(folder / one.file, one.bytes));
        const Error error = refusal(folder / one.file);
        CHECK_THAT(error.message, Catch::Contains(one.says));
        CHECK_FALSE(error.mend.empty());
    }
}

TEST_CASE("control characters in the names of a file get no further than its reader") {
    GltfFile file = makePostRig();
    file.json["nodes"][1]["name"] = "\x1b[31mlow\n";
    file.json["meshes"][0]["name"] =
        "\xC2\x9B"
        "31m";
    const TemporaryFolder folder;
    const auto path = folder / "rig\x1b[31m.gltf";
    file.saveText(path);
    const Character character = imported(path);
    CHECK(findJoint(character.skeleton, "_[31mlow_") != kNoJoint);
    CHECK(character.name == "rig_[31m");
    REQUIRE_FALSE(character.meshes.empty());
    CHECK(character.meshes[0].name == "_31m");
    CHECK(character.file == path);
}

TEST_CASE("thousands of meshes below nodes of their own stand where those do, beside a skinned one") {
    GltfFile file = makePostRig();
    const int mesh = addPostMesh(file, makePost(), mat4(1.0F), false);
    const int high = 3;  // the armature and its three joints come first
    for (int i = 0; i < 3000; ++i) {
        const vec3 place(0.001F * static_cast<float>(i), 0.0F, 0.0F);
        const int node = file.addNode("stone" + std::to_string(i), high, glm::translate(mat4(1.0F), place));
        file.json["nodes"][node]["mesh"] = mesh;
    }
    const TemporaryFolder folder;
    file.saveBinary(folder / "field.glb");
    const Character character = imported(folder / "field.glb");
    int rigid = 0;
    float worst = 0.0F;
    for (const SkinnedMesh& placed : character.meshes) {
        rigid += placed.rigid ? 1 : 0;
        const int joint = findJoint(character.skeleton, "low");
        REQUIRE(joint != kNoJoint);
        const int carrier = placed.rigid ? placed.joints.front()[0] : joint;
        vec3 middle(0);
        for (const vec3& position : placed.positions)
            middle += position / static_cast<float>(placed.positions.size());
        worst = std::max(worst, std::abs(middle.x - character.skeleton.bindModelFromJoint[carrier].translation.x));
    }
    CHECK(rigid == 3000);
    CHECK(character.meshes.size() == 3001);
    CHECK(worst < 1e-4F);
}
