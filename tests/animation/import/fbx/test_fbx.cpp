// Documents made here, read by our own reader: each result against a formula that does not share its code.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <random>

#include "animation/import/clip_sampling.hpp"
#include "animation/import/fbx/fbx_documents.hpp"
#include "animation/import/fbx/fbx_writer.hpp"
#include "animation/import/fbx/read_fbx.hpp"
#include "animation/import/fbx/triangulate.hpp"
#include "support/catch.hpp"
#include "support/command.hpp"

using namespace lutka;
using namespace lutka::animation;
using namespace lutka::animation::rig_import;
using namespace lutka::test;
using glm::dmat4;
using glm::dvec3;
using glm::dvec4;

namespace {

// A square of side 2 about the origin, bound whole to joint 2.
std::vector<FbxRecord> skinnedSquare(const Numbers& meshProperties, const dmat4& sceneFromJoint,
                                     const dmat4& jointFromMesh) {
    const auto matrix = [](const dmat4& m) {
        std::vector<double> out;
        for (int i = 0; i < 16; ++i)
            out.push_back(m[i / 4][i % 4]);
        return out;
    };
    FbxRecord mesh = model(1, "Body", meshProperties);
    return document(
        {std::move(mesh),
         model(2, "Hips", {}),
         {"Geometry",
          {std::int64_t{3}, std::string("Geometry::Square"), std::string("Mesh")},
          {row("Vertices", {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0}), wholes("PolygonVertexIndex", {0, 1, 2, -4})}},
         {"Deformer", {std::int64_t{4}, std::string("Deformer::"), std::string("Skin")}, {}},
         {"Deformer",
          {std::int64_t{5}, std::string("SubDeformer::"), std::string("Cluster")},
          {wholes("Indexes", {0, 1, 2, 3}), row("Weights", {1, 1, 1, 1}), row("Transform", matrix(jointFromMesh)),
           row("TransformLink", matrix(sceneFromJoint))}}},
        {fbxLink(1, 0), fbxLink(2, 0), fbxLink(3, 1), fbxLink(4, 3), fbxLink(5, 4), fbxLink(2, 5)});
}

}  // namespace

TEST_CASE("an FBX node stands where all its pivots put it, in every way of writing the document") {
    const auto sections = document({model(7, "Arm", pivotsOfAllKinds())}, {fbxLink(7, 0)});
    for (const std::string& bytes :
         {asciiFbx(sections), binaryFbx(sections, 7400, false), binaryFbx(sections, 7500, true)}) {
        const Result<SourceScene> scene = readBytes(bytes);
        REQUIRE(scene.ok());
        REQUIRE(scene.value().nodes.size() == 2);
        CHECK(scene.value().nodes[1].name == "Arm");
        CHECK(difference(scene.value().nodes[1].parentFromNode, pivotsMatrix({10, 20, 30})) < 1e-9);
    }
}

TEST_CASE("all six orders of FBX rotations turn about the first axis first") {
    const int orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}, {1, 0, 2}, {2, 0, 1}, {2, 1, 0}};
    const dvec3 angles(20, 50, -70);
    for (int order = 0; order < 6; ++order) {
        const SourceScene scene = readAll(document({model(7, "Arm",
                                                          {{"Lcl Rotation", {angles.x, angles.y, angles.z}},
                                                           {"RotationOrder", {static_cast<double>(order)}},
                                                           {"RotationActive", {1}}})},
                                                   {fbxLink(7, 0)}));
        dmat4 expected(1.0);
        for (const int axis : orders[order])
            expected = turn(angles[axis], axis) * expected;
        CHECK(difference(scene.nodes[1].parentFromNode, expected) < 1e-9);
    }
}

TEST_CASE(
    "an FBX joint that does not inherit its parent's scale keeps its own, and the place that the scale gives it") {
    const Numbers joint = {{"Lcl Translation", {10, 0, 0}}, {"Lcl Scaling", {0.01, 0.01, 0.01}}, {"InheritType", {2}}};
    const SourceScene scene = readAll(document({model(1, "A", joint), model(2, "B", joint), model(3, "C", joint)},
                                               {fbxLink(1, 0), fbxLink(2, 1), fbxLink(3, 2)}));
    dmat4 at(1.0);
    for (std::size_t node = 1; node < 4; ++node)
        at *= scene.nodes[node].parentFromNode;
    CHECK(at[3].x == Approx(10.0 + 0.1 + 0.1));
    CHECK(at[0].x == Approx(0.01));
}

TEST_CASE("an uneven scale that is not inherited becomes a helper node, and all frames are exact") {
    const SourceScene scene = readAll(
        document({model(1, "A", {{"Lcl Scaling", {2, 1, 1}}}),
                  model(2, "B", {{"Lcl Translation", {3, 4, 5}}, {"Lcl Rotation", {0, 0, 30}}, {"InheritType", {2}}})},
                 {fbxLink(1, 0), fbxLink(2, 1)}));
    REQUIRE(scene.nodes.size() == 4);
    CHECK(scene.nodes[2].isHelper);
    const dmat4 found = scene.nodes[1].parentFromNode * scene.nodes[2].parentFromNode * scene.nodes[3].parentFromNode;
    CHECK(difference(found, move({6, 4, 5}) * turn(30, 2)) < 1e-9);
}

TEST_CASE("the vertex colours of an FBX are sRGB and become linear") {
    std::vector<FbxRecord> sections = skinnedSquare({}, dmat4(1.0), dmat4(1.0));
    FbxRecord* geometry = nullptr;
    for (FbxRecord& section : sections) {
        for (FbxRecord& record : section.children)
            geometry = record.name == "Geometry" ? &record : geometry;
    }
    REQUIRE(geometry != nullptr);
    const auto word = [](const char* name, const char* value) { return FbxRecord{name, {std::string(value)}, {}}; };
    geometry->children.push_back(
        {"LayerElementColor",
         {std::int64_t{0}},
         {word("MappingInformationType", "ByPolygonVertex"), word("ReferenceInformationType", "IndexToDirect"),
          row("Colors", {1, 0.5, 0, 1, 0, 0.25, 1, 0.5}), wholes("ColorIndex", {0, 0, 0, 1})}});
    const SourceScene scene = readAll(sections);
    REQUIRE(scene.meshes.size() == 1);
    const std::vector<vec4>& colors = scene.meshes[0].colors;
    REQUIRE(colors.size() == 4);
    CHECK(glm::distance(colors[0], vec4(1.0F, 0.2140F, 0.0F, 1.0F)) < 1e-3F);
    CHECK(glm::distance(colors[3], vec4(0.0F, 0.0509F, 1.0F, 0.5F)) < 1e-3F);
}

TEST_CASE("pictures of an FBX shader that is not known are taken by what their properties say, or told") {
    const auto warnings = [](const std::string& property) {
        std::vector<FbxRecord> sections = skinnedSquare({}, dmat4(1.0), dmat4(1.0));
        for (FbxRecord& section : sections) {
            if (section.name == "Objects") {
                section.children.push_back(
                    {"Material", {std::int64_t{6}, std::string("Material::Coat"), std::string()}, {}});
                section.children.push_back({"Texture",
                                            {std::int64_t{7}, std::string("Texture::Cloth"), std::string()},
                                            {FbxRecord{"RelativeFilename", {std::string("cloth.png")}, {}}}});
            } else {
                section.children.push_back(fbxLink(6, 1));
                section.children.push_back(fbxLink(7, 6, property));
            }
        }
        const SourceScene scene = readAll(sections);
        std::string out;
        for (const std::string& warning : scene.warnings)
            out += warning + "\n";
        return out;
    };
    // The picture is looked for, and is not there.
    for (const char* property : {"Maya|DiffuseTexture", "Maya|NormalTexture", "Shader|Albedo_Map", "DiffuseColor"}) {
        INFO(property);
        CHECK(warnings(property).find("cloth.png") != std::string::npos);
        CHECK(warnings(property).find("whose property is none") == std::string::npos);
    }
    CHECK(warnings("Maya|FalloffTexture").find("cloth.png") == std::string::npos);
    CHECK(warnings("Maya|FalloffTexture")
              .find("whose property is none for colour, normals or glow: Maya|FalloffTexture") != std::string::npos);
    CHECK(warnings("Maya|DiffuseMask").find("Maya|DiffuseMask") != std::string::npos);
}

TEST_CASE("an FBX clip that stands still is one frame, however long it says it is") {
    constexpr double kHours = 3.0 * 3600.0;  // more frames than any clip may have
    const auto read = [&](double second) {
        const FbxRecord curve{
            "AnimationCurve",
            {std::int64_t{11}, std::string("AnimCurve::"), std::string()},
            {row("KeyTime", {0.0, kTicks}), row("KeyValueFloat", {10.0, second}), wholes("KeyAttrFlags", {4}),
             row("KeyAttrDataFloat", {0, 0, 0, 0}), wholes("KeyAttrRefCount", {2})}};
        const FbxRecord curveNode{
            "AnimationCurveNode", {std::int64_t{10}, std::string("AnimCurveNode::R"), std::string()}, {}};
        const FbxRecord stack{"AnimationStack",
                              {std::int64_t{8}, std::string("AnimStack::Pose"), std::string()},
                              {fbxProperties({{"LocalStop", {kHours * kTicks}}})}};
        return readAll(document(
            {model(7, "Arm", {}),
             stack,
             {"AnimationLayer", {std::int64_t{9}, std::string("AnimLayer::Base"), std::string()}, {}},
             curveNode,
             curve},
            {fbxLink(7, 0), fbxLink(9, 8), fbxLink(10, 9), fbxLink(10, 7, "Lcl Rotation"), fbxLink(11, 10, "d|X")}));
    };
    const SourceScene still = read(10.0);
    REQUIRE(still.clips.size() == 1);
    REQUIRE(still.clips[0].channels.size() == 3);
    CHECK(still.clips[0].channels[1].times.size() == 1);
    CHECK(difference(parentFromNodes(still, still.clips[0], 0.0)[1], turn(10, 0)) < 1e-6);
    CHECK(still.warnings.empty());
    const SourceScene moving = read(20.0);
    REQUIRE(moving.warnings.size() == 1);
    CHECK(moving.warnings[0].find("is too long") != std::string::npos);
}

TEST_CASE("what an FBX 6 take states without keys holds while it plays") {
    const auto word = [](const char* name, const char* value, std::vector<FbxRecord> children) {
        return FbxRecord{name, {std::string(value)}, std::move(children)};
    };
    const auto still = [&](const char* axis, double value) {
        return word("Channel", axis, {FbxRecord{"Default", {value}, {}}});
    };
    std::vector<FbxRecord> sections = document({model(1, "Hips", {}), model(2, "Brow", {{"Lcl Rotation", {0, 0, 90}}})},
                                               {fbxLink(1, 0), fbxLink(2, 1)});
    const FbxRecord moving = word("Channel", "Y",
                                  {FbxRecord{"Default", {5.0}, {}}, FbxRecord{"KeyVer", {std::int64_t{4005}}, {}},
                                   FbxRecord{"KeyCount", {std::int64_t{2}}, {}},
                                   FbxRecord{"Key", {0.0, 5.0, std::string("L"), kTicks, 7.0, std::string("L")}, {}}});
    const FbxRecord hips{
        "Model",
        {std::int64_t{1}},
        {word("Channel", "Transform", {word("Channel", "T", {still("X", 0), moving, still("Z", 0)})})}};
    const FbxRecord brow{
        "Model",
        {std::int64_t{2}},
        {word("Channel", "Transform", {word("Channel", "R", {still("X", 0), still("Y", 30), still("Z", 0)})})}};
    sections.push_back(
        {"Takes", {}, {word("Take", "Take 001", {FbxRecord{"LocalTime", {0.0, kTicks}, {}}, hips, brow})}});
    const SourceScene scene = readAll(sections);
    REQUIRE(scene.clips.size() == 1);
    const std::vector<dmat4> pose = parentFromNodes(scene, scene.clips[0], 0.5);
    CHECK(pose[1][3].y == Approx(6.0));
    CHECK(difference(pose[2], turn(30, 1)) < 1e-6);
}

TEST_CASE("a geometric transform moves a skinned FBX mesh in its node and is no part of its joints") {
    const dmat4 sceneFromJoint = move({0, 5, 0}) * turn(30, 0);
    const dmat4 jointFromMesh = glm::inverse(sceneFromJoint) * move({0, 1, 0});
    const SourceScene scene = readAll(skinnedSquare(
        {{"GeometricTranslation", {0, 0, 90}}, {"GeometricRotation", {90, 0, 0}}}, sceneFromJoint, jointFromMesh));
    REQUIRE(scene.meshes.size() == 1);
    REQUIRE(scene.skins.size() == 1);
    REQUIRE(scene.skins[0].sceneFromMesh);
    CHECK(difference(*scene.skins[0].sceneFromMesh, move({0, 1, 0})) < 1e-9);
    CHECK(difference(scene.skins[0].joints[0].jointFromMesh, jointFromMesh) < 1e-9);
    const dmat4 geometric = move({0, 0, 90}) * turn(90, 0);
    for (const vec3& corner : {vec3(-1, -1, 0), vec3(1, 1, 0)}) {
        const vec3 expected(geometric * dvec4(dvec3(corner), 1.0));
        const auto& all = scene.meshes[0].positions;
        CHECK(std::any_of(all.begin(), all.end(), [&](const vec3& p) { return glm::distance(p, expected) < 1e-4F; }));
    }
    REQUIRE(scene.meshes[0].influenceStart.size() == 5);
    CHECK(scene.meshes[0].influences[0].weight == 1.0F);
}

TEST_CASE("an FBX mesh is hidden by its own properties or by what it hangs on, but not where that moves") {
    const auto isHidden = [](const Numbers& ofMesh, const Numbers& ofParent, bool moves) {
        std::vector<FbxRecord> sections = skinnedSquare(ofMesh, dmat4(1.0), dmat4(1.0));
        for (FbxRecord& section : sections) {
            if (section.name == "Objects") {
                section.children.push_back(model(20, "Wardrobe", ofParent));
                section.children.push_back({"AnimationCurveNode",
                                            {std::int64_t{21}, std::string("AnimCurveNode::Visibility"), std::string()},
                                            {}});
            }
            if (section.name == "Connections") {
                section.children.front() = fbxLink(1, 20);
                section.children.push_back(fbxLink(20, 0));
                if (moves) section.children.push_back(fbxLink(21, 20, "Visibility"));
            }
        }
        const SourceScene scene = readAll(sections);
        REQUIRE(scene.instances.size() == 1);
        return scene.instances[0].hidden;
    };
    CHECK_FALSE(isHidden({}, {}, false));
    CHECK_FALSE(isHidden({{"Show", {1}}, {"Visibility", {1}}}, {{"Visibility", {1}}}, false));
    CHECK(isHidden({{"Show", {0}}}, {}, false));
    CHECK(isHidden({{"Visibility", {0}}}, {}, false));
    CHECK(isHidden({}, {{"Visibility", {0}}}, false));
    CHECK_FALSE(isHidden({}, {{"Visibility", {0}}}, true));
    CHECK_FALSE(isHidden({}, {{"Show", {0}}}, false));
    CHECK_FALSE(isHidden({{"Visibility Inheritance", {0}}}, {{"Visibility", {0}}}, false));
}

TEST_CASE("of an FBX group of levels of detail the first is shown") {
    std::vector<FbxRecord> sections = skinnedSquare({}, dmat4(1.0), dmat4(1.0));
    for (FbxRecord& section : sections) {
        if (section.name == "Objects") {
            FbxRecord group = model(20, "Body_LODs", {});
            group.values.back() = std::string("LodGroup");
            section.children.push_back(std::move(group));
            section.children.push_back(model(21, "Body_LOD0", {}));
            section.children.push_back(
                {"Geometry",
                 {std::int64_t{22}, std::string("Geometry::Finer"), std::string("Mesh")},
                 {row("Vertices", {0, 0, 0, 1, 0, 0, 0, 1, 0}), wholes("PolygonVertexIndex", {0, 1, -3})}});
        }
        if (section.name == "Connections") {
            section.children.front() = fbxLink(21, 20);
            for (const FbxRecord& link : {fbxLink(1, 20), fbxLink(20, 0), fbxLink(22, 21)})
                section.children.push_back(link);
        }
    }
    const SourceScene scene = readAll(sections);
    REQUIRE(scene.instances.size() == 2);
    for (const SourceInstance& instance : scene.instances)
        CHECK(instance.hidden == (scene.meshes[instance.mesh].name == "Square"));
}

TEST_CASE("an FBX skin that blends by dual quaternions is told, a linear one is not") {
    for (const std::string type : {"DualQuaternion", "Blend", "Linear", "Rigid"}) {
        INFO(type);
        std::vector<FbxRecord> sections = skinnedSquare({}, dmat4(1.0), dmat4(1.0));
        for (FbxRecord& section : sections) {
            for (FbxRecord& record : section.children) {
                if (record.name == "Deformer" && std::get<std::string>(record.values.back()) == "Skin")
                    record.children.push_back({"SkinningType", {type}, {}});
            }
        }
        const SourceScene scene = readAll(sections);
        const bool told = std::ranges::any_of(scene.warnings, [](const std::string& warning) {
            return warning.find("dual quaternions in the file: Body") != std::string::npos;
        });
        CHECK(told == (type == "DualQuaternion" || type == "Blend"));
    }
}

TEST_CASE("clusters of an FBX that add to others are told") {
    for (const std::string mode : {"Additive", "Total1", "Normalize"}) {
        INFO(mode);
        std::vector<FbxRecord> sections = skinnedSquare({}, dmat4(1.0), dmat4(1.0));
        for (FbxRecord& record : sections[0].children) {
            if (record.name == "Deformer" && std::get<std::string>(record.values.back()) == "Cluster")
                record.children.push_back({"Mode", {mode}, {}});
        }
        const SourceScene scene = readAll(sections);
        const bool told = std::ranges::any_of(scene.warnings, [](const std::string& warning) {
            return warning.find("additive clusters); read as shares: Body") != std::string::npos;
        });
        CHECK(told == (mode == "Additive"));
    }
}

TEST_CASE("blend shapes that an FBX moves are told, those with curves that stand still are not") {
    for (const double last : {100.0, 40.0}) {
        INFO(last);
        std::vector<FbxRecord> sections = skinnedSquare({}, dmat4(1.0), dmat4(1.0));
        const auto add = [&](const char* section, FbxRecord record) {
            const auto found = std::ranges::find_if(sections, [&](const FbxRecord& r) { return r.name == section; });
            REQUIRE(found != sections.end());
            found->children.push_back(std::move(record));
        };
        add("Objects",
            {"Deformer", {std::int64_t{20}, std::string("SubDeformer::Smile"), std::string("BlendShapeChannel")}, {}});
        add("Objects",
            {"AnimationCurveNode", {std::int64_t{21}, std::string("AnimCurveNode::DeformPercent"), std::string()}, {}});
        add("Objects", {"AnimationCurve",
                        {std::int64_t{22}, std::string("AnimCurve::"), std::string()},
                        {row("KeyTime", {0.0, kTicks}), row("KeyValueFloat", {40.0, last}), wholes("KeyAttrFlags", {4}),
                         row("KeyAttrDataFloat", {0, 0, 0, 0}), wholes("KeyAttrRefCount", {2})}});
        add("Connections", fbxLink(21, 20, "DeformPercent"));
        add("Connections", fbxLink(22, 21, "d|DeformPercent"));
        const SourceScene scene = readAll(sections);
        const bool told =
            std::ranges::find(scene.warnings, "animations of blend shapes were left out") != scene.warnings.end();
        CHECK(told == (last != 40.0));
    }
}

TEST_CASE("left-handed FBX axes are mirrored at the root") {
    auto sections = document({model(1, "A", {{"Lcl Translation", {1, 2, 3}}})}, {fbxLink(1, 0)});
    sections.insert(sections.begin(), {"GlobalSettings",
                                       {},
                                       {fbxProperties({{"UpAxis", {1}},
                                                       {"UpAxisSign", {1}},
                                                       {"FrontAxis", {2}},
                                                       {"FrontAxisSign", {-1}},
                                                       {"CoordAxis", {0}},
                                                       {"CoordAxisSign", {1}},
                                                       {"UnitScaleFactor", {2.54}}})}});
    const SourceScene scene = readAll(sections);
    const dmat4 place = scene.nodes[0].parentFromNode * scene.nodes[1].parentFromNode;
    CHECK(glm::distance(dvec3(place[3]), dvec3(1, 2, -3)) < 1e-9);
    REQUIRE(scene.convention.metresPerUnit);
    CHECK(*scene.convention.metresPerUnit == Approx(0.0254));
    CHECK(scene.convention.up == UpAxis::positiveY);
}

TEST_CASE("a concave polygon is cut into triangles that cover it once") {
    // A comb with two teeth, area 7.
    const std::vector<vec3> comb = {{0, 0, 0}, {5, 0, 0}, {5, 2, 0}, {4, 2, 0},
                                    {4, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
    std::vector<std::uint32_t> triangles;
    fbx::triangulate(comb, triangles);
    REQUIRE(triangles.size() == 3 * 6);
    float area = 0.0F;
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
        const vec3 a = comb[triangles[i]];
        const float z = glm::cross(comb[triangles[i + 1]] - a, comb[triangles[i + 2]] - a).z;
        CHECK(z >= 0.0F);
        area += 0.5F * z;
    }
    CHECK(area == Approx(7.0F));
}

TEST_CASE("FBX records nested beyond all measure are refused with the limit") {
    std::string bytes = "; FBX 7.4.0 project file\n";
    for (int i = 0; i < 5000; ++i)
        bytes += "A: {\n";
    const Result<SourceScene> scene = readBytes(bytes);
    REQUIRE_FALSE(scene.ok());
    CHECK(scene.error().code == ErrorCode::input);
    CHECK(scene.error().message.find("deeper than 64") != std::string::npos);
}

TEST_CASE("a binary FBX copied as a text, or in the other byte order, is refused with the reason") {
    const std::string sound = binaryFbx(document({model(1, "A", {})}, {fbxLink(1, 0)}), 7400, false);
    REQUIRE(readBytes(sound).ok());
    std::string spaced = sound;
    std::ranges::replace(spaced, '\0', ' ');
    const Result<SourceScene> copied = readBytes(spaced);
    REQUIRE_FALSE(copied.ok());
    CHECK(copied.error().message.find("copied as a text") != std::string::npos);
    std::string turned = sound;
    turned[22] = 1;
    const Result<SourceScene> other = readBytes(turned);
    REQUIRE_FALSE(other.ok());
    CHECK(other.error().message.find("big-endian") != std::string::npos);
}

TEST_CASE("an FBX array that claims more than its bytes can hold is refused before memory is taken") {
    auto sections = skinnedSquare({}, dmat4(1.0), dmat4(1.0));
    std::string bytes = binaryFbx(sections, 7400, true);
    const std::size_t vertices = bytes.find("Vertices");
    REQUIRE(vertices != std::string::npos);
    const std::uint32_t claimed = 60'000'000;
    bytes.replace(vertices + 9, 4, std::string(reinterpret_cast<const char*>(&claimed), 4));
    const Result<SourceScene> scene = readBytes(bytes);
    REQUIRE_FALSE(scene.ok());
    CHECK(scene.error().message.find("60000000 numbers") != std::string::npos);
}

TEST_CASE("damaged FBX documents are read or refused, and never more") {
    const auto sections = skinnedSquare(pivotsOfAllKinds(), move({0, 5, 0}), move({0, -5, 0}));
    std::mt19937 random(7);
    int refused = 0;
    for (const std::string& whole :
         {asciiFbx(sections), binaryFbx(sections, 7400, true), binaryFbx(sections, 7700, false)}) {
        for (int round = 0; round < 400; ++round) {
            std::string bytes = whole;
            for (auto hits = 1 + random() % 6; hits > 0; --hits)
                bytes[random() % bytes.size()] = static_cast<char>(random() % 256);
            if (random() % 4 == 0) bytes.resize(random() % bytes.size());
            const Result<SourceScene> scene = readBytes(bytes);
            if (!scene) ++refused;
            if (!scene) CHECK(scene.error().code == ErrorCode::input);
            for (std::size_t i = 0; scene && i < scene.value().meshes.size(); ++i) {
                const SourceMesh& mesh = scene.value().meshes[i];
                for (const std::uint32_t index : mesh.indices)
                    REQUIRE(index < mesh.positions.size());
            }
        }
    }
    CHECK(refused > 100);
}
