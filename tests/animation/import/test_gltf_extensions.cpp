#include <draco/compression/encode.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <vector>

#include "checks.hpp"
#include "gltf_file.hpp"
#include "support/catch.hpp"

// What glTF can say in more than one way: each file is compared with the same figure said plainly.
namespace lutka::test {
namespace {

using animation::Character;
using nlohmann::json;

// A picture of one pixel.
constexpr const char* kPicture =
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5E"
    "rkJggg==";

json& primitiveOf(GltfFile& file) {
    return file.json["meshes"][0]["primitives"][0];
}

json& accessorOf(GltfFile& file, const char* attribute) {
    return file.json["accessors"][primitiveOf(file)["attributes"][attribute].get<int>()];
}

Character readBack(const GltfFile& file) {
    const TemporaryFolder folder;
    file.saveBinary(folder / "rig.glb");
    Character character = imported(folder / "rig.glb");
    checkInvariants(character);
    return character;
}

// The triangles as corners in space, each from its lowest corner on, so that turned ones differ.
std::vector<std::array<std::array<float, 3>, 3>> trianglesOf(const Character& character) {
    std::vector<std::array<std::array<float, 3>, 3>> triangles;
    for (const animation::SkinnedMesh& mesh : character.meshes) {
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            std::array<std::array<float, 3>, 3> triangle{};
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const vec3& p = mesh.positions[mesh.indices[i + corner]];
                triangle[corner] = {p.x, p.y, p.z};
            }
            std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
            triangles.push_back(triangle);
        }
    }
    std::sort(triangles.begin(), triangles.end());
    return triangles;
}

GltfFile withTriangles(const std::vector<std::uint16_t>& indices, int mode) {
    GltfFile file = makePostRig();
    primitiveOf(file)["indices"] = file.addIndices(indices);
    primitiveOf(file)["mode"] = mode;
    return file;
}

// UVs of (0.25, 0.5) on all vertices and a material whose picture they place.
GltfFile withPicture() {
    GltfFile file = makePostRig();
    std::vector<float> uvs;
    for (std::size_t v = 0; v < makePost().positions.size(); ++v)
        uvs.insert(uvs.end(), {0.25F, 0.5F});
    primitiveOf(file)["attributes"]["TEXCOORD_0"] = file.addFloats(uvs, "VEC2");
    primitiveOf(file)["material"] = 0;
    file.json["images"] = {{{"uri", kPicture}}};
    file.json["textures"] = {{{"source", 0}}};
    file.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    return file;
}

// Takes an accessor's bytes through meshoptimizer's codec for vertices; `stride` bytes each.
void packWithMeshopt(GltfFile& file, const char* attribute, const void* values, std::size_t count, std::size_t stride,
                     const char* filter = "NONE") {
    std::vector<std::uint8_t> packed(meshopt_encodeVertexBufferBound(count, stride));
    packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), values, count, stride));
    const int bytes = file.addComponents<std::uint8_t>(packed, 5121, "SCALAR", packed.size(), false);
    json view = file.json["bufferViews"][file.json["accessors"][bytes]["bufferView"].get<int>()];
    view["byteStride"] = stride;
    view["count"] = count;
    view["mode"] = "ATTRIBUTES";
    view["filter"] = filter;
    // What readers without the extension would see: nothing of use.
    file.json["bufferViews"].push_back({{"buffer", 0},
                                        {"byteOffset", 0},
                                        {"byteLength", count * stride},
                                        {"byteStride", stride},
                                        {"extensions", {{"EXT_meshopt_compression", view}}}});
    accessorOf(file, attribute)["bufferView"] = file.json["bufferViews"].size() - 1;
}

template <class T, std::size_t Width>
std::uint32_t addToDraco(draco::Mesh& mesh, draco::GeometryAttribute::Type type, draco::DataType component,
                         const std::vector<std::array<T, Width>>& values) {
    draco::GeometryAttribute attribute;
    attribute.Init(type, nullptr, static_cast<std::int8_t>(Width), component, false, sizeof(values[0]), 0);
    const int id = mesh.AddAttribute(attribute, true, static_cast<std::uint32_t>(values.size()));
    for (std::uint32_t i = 0; i < values.size(); ++i)
        mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), values[i].data());
    return mesh.attribute(id)->unique_id();
}

}  // namespace

TEST_CASE("a sparse accessor changes the vertices that it lists") {
    const Post post = makePost();
    const std::vector<float> moved = {-0.35F, 0.0F, -0.3F, 0.3F, 1.9F, 0.2F};
    const std::vector<std::uint16_t> which = {0, 14};
    GltfFile sparse = makePostRig();
    const int indices = sparse.addIndices(which);
    const int values = sparse.addFloats(moved, "VEC3");
    accessorOf(sparse, "POSITION")["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", sparse.json["accessors"][indices]["bufferView"]}, {"componentType", 5123}}},
        {"values", {{"bufferView", sparse.json["accessors"][values]["bufferView"]}}}};
    GltfFile plain = makePostRig();
    std::vector<float> positions;
    for (std::size_t v = 0; v < post.positions.size(); ++v) {
        const std::size_t from = v == 0 ? 0 : 3;
        const bool listed = v == 0 || v == 14;
        const vec3 p = listed ? vec3(moved[from], moved[from + 1], moved[from + 2]) : post.positions[v];
        positions.insert(positions.end(), {p.x, p.y, p.z});
    }
    primitiveOf(plain)["attributes"]["POSITION"] = plain.addFloats(positions, "VEC3");
    CHECK(trianglesOf(readBack(sparse)) == trianglesOf(readBack(plain)));
}

TEST_CASE("strips and fans are the triangles that they stand for, with their fronts outside") {
    const auto strip = trianglesOf(readBack(withTriangles({0, 1, 4, 5, 8, 9}, 5)));
    CHECK(strip == trianglesOf(readBack(withTriangles({0, 1, 4, 4, 1, 5, 4, 5, 8, 8, 5, 9}, 4))));
    const auto fan = trianglesOf(readBack(withTriangles({0, 1, 5, 8, 12}, 6)));
    CHECK(fan == trianglesOf(readBack(withTriangles({0, 1, 5, 0, 5, 8, 0, 8, 12}, 4))));
}

TEST_CASE("morph targets stand at their default weights") {
    GltfFile file = makePostRig();
    std::vector<float> offsets;
    for (std::size_t v = 0; v < makePost().positions.size(); ++v)
        offsets.insert(offsets.end(), {0.0F, 0.0F, 0.4F});
    primitiveOf(file)["targets"] = {{{"POSITION", file.addFloats(offsets, "VEC3")}}};
    file.json["meshes"][0]["weights"] = {0.25F};
    const std::vector<vec3> plain = bindVertices(readBack(makePostRig()));
    const std::vector<vec3> morphed = bindVertices(readBack(file));
    REQUIRE(morphed.size() == plain.size());
    for (std::size_t v = 0; v < plain.size(); ++v)
        CHECK(glm::distance(morphed[v], plain[v] + vec3(0, 0, 0.1F)) < 1e-5F);
    // A node's own weights win over the mesh's.
    for (json& node : file.json["nodes"]) {
        if (node.contains("mesh")) node["weights"] = {1.0F};
    }
    CHECK(bindVertices(readBack(file)).front().z == Approx(plain.front().z + 0.4F).margin(1e-5));
}

TEST_CASE("a texture transform is worked into the vertices") {
    GltfFile file = withPicture();
    file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"] = {
        {"offset", {0.1, 0.2}}, {"rotation", 0.5 * kPi}, {"scale", {2.0, 3.0}}};
    const Character character = readBack(file);
    REQUIRE_FALSE(character.meshes[0].uvs.empty());
    // By the extension's own formula: offset + rotation × scale × uv, rotation counter-clockwise in a V that points
    // down.
    for (const vec2& uv : character.meshes[0].uvs)
        CHECK(glm::distance(uv, vec2(0.1F + 3.0F * 0.5F, 0.2F - 2.0F * 0.25F)) < 1e-5F);
}

TEST_CASE("specular-glossiness becomes the nearest metallic-roughness") {
    GltfFile file = withPicture();
    const json picture = {{"index", 0}};
    file.json["materials"] = {{{"extensions",
                                {{"KHR_materials_pbrSpecularGlossiness",
                                  {{"diffuseFactor", {0.6, 0.4, 0.2, 1.0}},
                                   {"diffuseTexture", picture},
                                   {"specularFactor", {0.04, 0.04, 0.04}},
                                   {"glossinessFactor", 0.3}}}}}},
                              {{"extensions",
                                {{"KHR_materials_pbrSpecularGlossiness",
                                  {{"diffuseFactor", {0.0, 0.0, 0.0, 1.0}}, {"specularFactor", {1.0, 0.8, 0.3}}}}}}}};
    const Character character = readBack(file);
    REQUIRE(character.materials.size() == 2);
    const animation::Material& cloth = character.materials[0];
    CHECK(glm::distance(cloth.baseColor, vec4(0.6F, 0.4F, 0.2F, 1.0F)) < 1e-5F);
    CHECK(cloth.metallic == 0.0F);
    CHECK(cloth.roughness == Approx(0.7F));
    CHECK(cloth.baseColorTexture == 0);
    const animation::Material& gold = character.materials[1];
    CHECK(gold.metallic > 0.95F);
    CHECK(glm::distance(gold.baseColor, vec4(1.0F, 0.8F, 0.3F, 1.0F)) < 0.05F);
}

TEST_CASE("a mesh without a material does not take the first one's glass") {
    GltfFile file = withPicture();
    file.json["materials"][0]["alphaMode"] = "BLEND";
    primitiveOf(file).erase("material");
    const Character character = readBack(file);
    REQUIRE(character.materials.size() == 2);
    const animation::Material& plain = character.materials[character.meshes[0].material];
    CHECK(plain.alphaMode == animation::Material::AlphaMode::opaque);
    CHECK(plain.baseColorTexture == animation::Material::kNoTexture);
    CHECK(plain.baseColor == animation::Material{}.baseColor);
}

TEST_CASE("what shines by a picture that can't be read does not shine all over") {
    GltfFile file = withPicture();
    file.json["materials"][0]["emissiveFactor"] = {1.0, 1.0, 1.0};
    CHECK(readBack(file).materials[0].emissive == vec3(1));
    file.json["materials"][0]["emissiveTexture"] = {{"index", 1}};
    file.json["textures"].push_back({{"source", 0}});
    CHECK(readBack(file).materials[0].emissive == vec3(1));
    file.json["textures"][1] = {{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}};
    CHECK(readBack(file).materials[0].emissive == vec3(0));
}

TEST_CASE("buffers packed by meshoptimizer are unpacked") {
    const Post post = makePost();
    GltfFile file = makePostRig();
    std::vector<std::array<std::uint8_t, 4>> joints;
    for (const HandSkin& skin : post.skin)
        joints.push_back(skin.joints);
    packWithMeshopt(file, "POSITION", post.positions.data(), post.positions.size(), sizeof(vec3));
    packWithMeshopt(file, "JOINTS_0", joints.data(), joints.size(), 4);
    file.json["extensionsUsed"] = file.json["extensionsRequired"] = {"EXT_meshopt_compression"};
    const Character character = readBack(file);
    const Character plain = readBack(makePostRig());
    CHECK(trianglesOf(character) == trianglesOf(plain));
    CHECK(character.skeleton.skinWeight == plain.skeleton.skinWeight);
}

TEST_CASE("filters of packed buffers are undone, and those that are not known are refused by name") {
    const Post post = makePost();
    std::vector<float> normals;  // of four components, as the filter takes them
    for (const vec3& p : post.positions) {
        const vec3 n = glm::normalize(p - vec3(0, 0.9F, 0));
        normals.insert(normals.end(), {n.x, n.y, n.z, 0.0F});
    }
    std::vector<vec3> positions(post.positions.size());
    meshopt_encodeFilterExp(positions.data(), positions.size(), sizeof(vec3), 23, &post.positions[0].x);
    std::vector<std::int8_t> octahedral(normals.size());
    meshopt_encodeFilterOct(octahedral.data(), positions.size(), 4, 8, normals.data());
    const auto packed = [&](const char* filter) {
        GltfFile file = makePostRig();
        primitiveOf(file)["attributes"]["NORMAL"] =
            file.addComponents<std::int8_t>(octahedral, 5120, "VEC3", positions.size(), true);
        packWithMeshopt(file, "POSITION", positions.data(), positions.size(), sizeof(vec3), filter);
        packWithMeshopt(file, "NORMAL", octahedral.data(), positions.size(), 4, "OCTAHEDRAL");
        file.json["extensionsUsed"] =
            file.json["extensionsRequired"] = {"KHR_mesh_quantization", "EXT_meshopt_compression"};
        return file;
    };
    const Character character = readBack(packed("EXPONENTIAL"));
    const Character plain = readBack(makePostRig());
    const auto& mesh = character.meshes[0];
    REQUIRE(mesh.positions.size() == plain.meshes[0].positions.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        CHECK(glm::distance(mesh.positions[v], plain.meshes[0].positions[v]) < 1e-5F);
        CHECK(glm::dot(mesh.normals[v], glm::normalize(mesh.positions[v] - vec3(0, 0.9F, 0))) > 0.999F);
    }
    const TemporaryFolder folder;
    packed("COLOR").saveBinary(folder / "color.glb");
    const Result<Character> refused = animation::importCharacter(folder / "color.glb");
    REQUIRE_FALSE(refused.ok());
    CHECK_THAT(refused.error().message, Catch::Contains("COLOR"));
}

TEST_CASE("meshes packed by draco are unpacked") {
    const Post post = makePost();
    std::vector<std::array<float, 3>> positions;
    std::vector<std::array<std::uint8_t, 4>> joints;
    std::vector<std::array<float, 4>> weights;
    for (std::size_t v = 0; v < post.positions.size(); ++v) {
        positions.push_back({post.positions[v].x, post.positions[v].y, post.positions[v].z});
        joints.push_back(post.skin[v].joints);
        weights.push_back(post.skin[v].weights);
    }
    draco::Mesh mesh;
    mesh.set_num_points(static_cast<std::uint32_t>(positions.size()));
    for (std::size_t i = 0; i < post.indices.size(); i += 3) {
        mesh.AddFace({draco::PointIndex(post.indices[i]), draco::PointIndex(post.indices[i + 1]),
                      draco::PointIndex(post.indices[i + 2])});
    }
    json block;
    block["attributes"] = {
        {"POSITION", addToDraco(mesh, draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, positions)},
        {"JOINTS_0", addToDraco(mesh, draco::GeometryAttribute::GENERIC, draco::DT_UINT8, joints)},
        {"WEIGHTS_0", addToDraco(mesh, draco::GeometryAttribute::GENERIC, draco::DT_FLOAT32, weights)}};
    draco::Encoder encoder;
    draco::EncoderBuffer packed;
    REQUIRE(encoder.EncodeMeshToBuffer(mesh, &packed).ok());
    GltfFile file = makePostRig();
    const std::vector<std::uint8_t> bytes(packed.data(), packed.data() + packed.size());
    const int accessor = file.addComponents<std::uint8_t>(bytes, 5121, "SCALAR", bytes.size(), false);
    block["bufferView"] = file.json["accessors"][accessor]["bufferView"];
    for (const char* attribute : {"POSITION", "JOINTS_0", "WEIGHTS_0"})
        accessorOf(file, attribute).erase("bufferView");
    primitiveOf(file)["extensions"]["KHR_draco_mesh_compression"] = block;
    file.json["extensionsUsed"] = file.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    const Character character = readBack(file);
    const Character plain = readBack(makePostRig());
    CHECK(trianglesOf(character) == trianglesOf(plain));
    CHECK(character.skeleton.skinWeight == plain.skeleton.skinWeight);
}

}  // namespace lutka::test
