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

// The post's triangles and some of its attributes through draco.
class DracoPost {
  public:
    DracoPost() {
        mesh_.set_num_points(static_cast<std::uint32_t>(post_.positions.size()));
        for (std::size_t i = 0; i < post_.indices.size(); i += 3) {
            mesh_.AddFace({draco::PointIndex(post_.indices[i]), draco::PointIndex(post_.indices[i + 1]),
                           draco::PointIndex(post_.indices[i + 2])});
        }
        std::vector<std::array<float, 3>> positions;
        for (const vec3& p : post_.positions)
            positions.push_back({p.x, p.y, p.z});
        add("POSITION", draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, positions);
    }

    template <class T, std::size_t Width>
    void add(const char* name, draco::GeometryAttribute::Type type, draco::DataType component,
             const std::vector<std::array<T, Width>>& values) {
        draco::GeometryAttribute attribute;
        attribute.Init(type, nullptr, static_cast<std::int8_t>(Width), component, false, sizeof(values[0]), 0);
        const int id = mesh_.AddAttribute(attribute, true, static_cast<std::uint32_t>(values.size()));
        for (std::uint32_t i = 0; i < values.size(); ++i)
            mesh_.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), values[i].data());
        ids_[name] = mesh_.attribute(id)->unique_id();
    }

    void addSkin() {
        std::vector<std::array<std::uint8_t, 4>> joints;
        std::vector<std::array<float, 4>> weights;
        for (const HandSkin& skin : post_.skin) {
            joints.push_back(skin.joints);
            weights.push_back(skin.weights);
        }
        add("JOINTS_0", draco::GeometryAttribute::GENERIC, draco::DT_UINT8, joints);
        add("WEIGHTS_0", draco::GeometryAttribute::GENERIC, draco::DT_FLOAT32, weights);
    }

    // The post's rig with what was added compressed and the rest as it is; the vertices keep their order.
    GltfFile pack() const {
        draco::Encoder encoder;
        encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING);
        draco::EncoderBuffer packed;
        REQUIRE(encoder.EncodeMeshToBuffer(mesh_, &packed).ok());
        GltfFile file = makePostRig();
        const std::vector<std::uint8_t> bytes(packed.data(), packed.data() + packed.size());
        const int accessor = file.addComponents<std::uint8_t>(bytes, 5121, "SCALAR", bytes.size(), false);
        const json view = file.json["accessors"][accessor]["bufferView"];
        primitiveOf(file)["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", view}, {"attributes", ids_}};
        for (const auto& [name, id] : ids_.items()) {
            if (primitiveOf(file)["attributes"].contains(name)) accessorOf(file, name.c_str()).erase("bufferView");
        }
        file.json["extensionsUsed"] = file.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
        return file;
    }

    [[nodiscard]] std::size_t size() const { return post_.positions.size(); }

  private:
    Post post_ = makePost();
    draco::Mesh mesh_;
    json ids_;
};

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

TEST_CASE("pictures that do not repeat are told where they are shown beyond their edges") {
    const auto tells = [](int wrap, float offset) {
        GltfFile file = withPicture();
        file.json["samplers"] = {{{"wrapT", wrap}}};
        file.json["textures"][0]["sampler"] = 0;
        file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"] = {
            {"offset", {0.0, offset}}};
        return warns(readBack(file), "mirroring");
    };
    CHECK(tells(33648, 1.0F));
    CHECK(tells(33071, -1.0F));
    CHECK_FALSE(tells(33648, 0.0F));
    CHECK_FALSE(tells(10497, 1.0F));
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

TEST_CASE("meshes packed by draco are unpacked, whatever part of their attributes is") {
    const Character plain = readBack(makePostRig());
    for (const bool withSkin : {true, false}) {
        DracoPost post;
        if (withSkin) post.addSkin();
        const Character character = readBack(post.pack());
        CHECK(trianglesOf(character) == trianglesOf(plain));
        CHECK(character.skeleton.skinWeight == plain.skeleton.skinWeight);
        CHECK_FALSE(character.meshes[0].rigid);
    }
}

TEST_CASE("integers that draco packs are the fractions that their accessors call them") {
    DracoPost post;
    post.addSkin();
    const std::vector<std::array<std::uint8_t, 3>> colors(post.size(), {255, 51, 0});
    const std::vector<std::array<std::uint16_t, 2>> uvs(post.size(), {13107, 65535});
    post.add("COLOR_0", draco::GeometryAttribute::COLOR, draco::DT_UINT8, colors);
    post.add("TEXCOORD_0", draco::GeometryAttribute::TEX_COORD, draco::DT_UINT16, uvs);
    GltfFile file = post.pack();
    const auto declare = [&](const char* attribute, int component, const char* type) {
        file.json["accessors"].push_back(
            {{"componentType", component}, {"count", post.size()}, {"type", type}, {"normalized", true}});
        primitiveOf(file)["attributes"][attribute] = file.json["accessors"].size() - 1;
    };
    declare("COLOR_0", 5121, "VEC3");
    declare("TEXCOORD_0", 5123, "VEC2");
    const Character character = readBack(file);
    REQUIRE(character.meshes[0].colors.size() == post.size());
    REQUIRE(character.meshes[0].uvs.size() == post.size());
    CHECK(glm::distance(character.meshes[0].colors[3], vec4(1.0F, 0.2F, 0.0F, 1.0F)) < 1e-6F);
    CHECK(glm::distance(character.meshes[0].uvs[3], vec2(0.2F, 1.0F)) < 1e-6F);
}

}  // namespace lutka::test
