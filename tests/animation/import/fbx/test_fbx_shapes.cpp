// Blend shapes of an FBX at rest, and when its clips begin.

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <string>

#include "animation/import/checks.hpp"
#include "animation/import/clip_sampling.hpp"
#include "animation/import/fbx/fbx_documents.hpp"
#include "animation/import/fbx/fbx_writer.hpp"
#include "animation/pose.hpp"
#include "support/catch.hpp"
#include "support/command.hpp"

using namespace lutka;
using namespace lutka::animation;
using namespace lutka::animation::rig_import;
using namespace lutka::test;
using glm::dvec3;

namespace {

using Records = std::vector<FbxRecord>;

FbxRecord square(Records more) {
    FbxRecord geometry{
        "Geometry",
        {std::int64_t{3}, std::string("Geometry::Square"), std::string("Mesh")},
        {row("Vertices", {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0}), wholes("PolygonVertexIndex", {0, 1, 2, -4})}};
    for (FbxRecord& record : more)
        geometry.children.push_back(std::move(record));
    return geometry;
}

// How far the shapes of a square lift its third corner.
double liftOf(Records objects, Records links) {
    objects.push_back(model(1, "Face", {}));
    links.push_back(fbxLink(1, 0));
    links.push_back(fbxLink(3, 1));
    const SourceScene scene = readAll(document(std::move(objects), std::move(links)));
    REQUIRE(scene.meshes.size() == 1);
    double highest = -1e9;
    for (const vec3& p : scene.meshes[0].positions)
        highest = std::max(highest, static_cast<double>(p.z));
    double lowest = 1e9;
    for (const vec3& p : scene.meshes[0].positions)
        lowest = std::min(lowest, static_cast<double>(p.z));
    return highest > 0.0 ? highest : lowest;
}

// A channel at a percentage over shapes that lift the third corner by so much, full at those percentages.
double liftBy(double percent, const std::vector<double>& full, const std::vector<double>& lifts) {
    Records objects{square({}),
                    {"Deformer", {std::int64_t{4}, std::string("Deformer::Face"), std::string("BlendShape")}, {}},
                    {"Deformer",
                     {std::int64_t{5}, std::string("SubDeformer::Smile"), std::string("BlendShapeChannel")},
                     {fbxProperties({{"DeformPercent", {percent}}}), row("FullWeights", full)}}};
    Records links{fbxLink(4, 3), fbxLink(5, 4)};
    for (std::size_t i = 0; i < lifts.size(); ++i) {
        const auto id = static_cast<std::int64_t>(10 + i);
        objects.push_back({"Geometry",
                           {id, std::string("Geometry::Smile"), std::string("Shape")},
                           {wholes("Indexes", {2}), row("Vertices", {0, 0, lifts[i]})}});
        links.push_back(fbxLink(id, 5));
    }
    return liftOf(std::move(objects), std::move(links));
}

}  // namespace

TEST_CASE("in-between shapes of an FBX count by their percentages, in whichever order they stand") {
    CHECK(liftBy(25, {50, 100}, {1, 4}) == Approx(0.5));
    CHECK(liftBy(75, {50, 100}, {1, 4}) == Approx(2.5));
    CHECK(liftBy(75, {100, 50}, {4, 1}) == Approx(2.5));
    CHECK(liftBy(100, {100, 50}, {4, 1}) == Approx(4.0));
    // Beyond the last one straight on.
    CHECK(liftBy(150, {50, 100}, {1, 4}) == Approx(7.0));
    CHECK(liftBy(-50, {50, 100}, {1, 4}) == Approx(-1.0));
    CHECK(liftBy(-30, {100, -60}, {4, 2}) == Approx(1.0));
    CHECK(liftBy(60, {100}, {2}) == Approx(1.2));
}

TEST_CASE("blend shapes that an FBX keeps in its geometry are on where the file has them on") {
    const auto shape = [](const std::string& name, double lift) {
        return FbxRecord{"Shape", {name}, {wholes("Indexes", {2}), row("Vertices", {0, 0, lift})}};
    };
    for (const double percent : {0.0, 50.0, 100.0}) {
        INFO(percent);
        const double lift = liftOf(
            {square({fbxProperties({{"Smile", {percent}}, {"Frown", {0}}}), shape("Smile", 2), shape("Frown", 9)})},
            {});
        CHECK(lift == Approx(percent / 50.0).margin(1e-9));
    }
}

TEST_CASE("the motion of blend shapes that an FBX keeps in its geometry is told") {
    for (const double last : {100.0, 40.0}) {
        INFO(last);
        const FbxRecord shape{"Shape", {std::string("Smile")}, {wholes("Indexes", {2}), row("Vertices", {0, 0, 1})}};
        const SourceScene scene = readAll(document(
            {model(1, "Face", {}),
             square({shape}),
             {"AnimationCurveNode", {std::int64_t{21}, std::string("AnimCurveNode::Smile"), std::string()}, {}},
             {"AnimationCurve",
              {std::int64_t{22}, std::string("AnimCurve::"), std::string()},
              {row("KeyTime", {0.0, kTicks}), row("KeyValueFloat", {40.0, last}), wholes("KeyAttrFlags", {4}),
               row("KeyAttrDataFloat", {0, 0, 0, 0}), wholes("KeyAttrRefCount", {2})}}},
            {fbxLink(1, 0), fbxLink(3, 1), fbxLink(21, 3, "Smile"), fbxLink(22, 21, "d|Smile")}));
        const bool told =
            std::ranges::find(scene.warnings, "animations of blend shapes were left out") != scene.warnings.end();
        CHECK(told == (last != 40.0));
    }
}

TEST_CASE("an FBX clip that begins later than the file's time line does not wait for it") {
    for (const double start : {0.0, 0.5, 1.0 / 30.0, 8.0, -2.0}) {
        INFO(start);
        Records objects{model(7, "Arm", {})};
        Records links{fbxLink(7, 0)};
        addTurn(0, 90, objects, links);
        for (FbxRecord& object : objects) {
            if (object.name == "AnimationStack")
                object.children = {
                    fbxProperties({{"LocalStart", {start * kTicks}}, {"LocalStop", {(start + 1) * kTicks}}})};
            for (FbxRecord& child : object.children) {
                if (child.name == "KeyTime") child = row("KeyTime", {start * kTicks, (start + 1) * kTicks});
            }
        }
        const SourceScene scene = readAll(document(objects, links));
        REQUIRE(scene.clips.size() == 1);
        const auto [first, last] = spanOf(scene.clips[0]);
        CHECK(first == Approx(0.0).margin(1e-9));
        CHECK(last == Approx(1.0));
        CHECK(difference(parentFromNodes(scene, scene.clips[0], 0.5)[1], xyz({45, 20, 30})) < 1e-4);
    }
}

TEST_CASE("keys of an FBX may stand in any order, its links twice and its lines end in any way") {
    Records objects{model(7, "Arm", {})};
    Records links{fbxLink(7, 0)};
    addTurn(0, 90, objects, links);
    for (FbxRecord& object : objects) {
        for (FbxRecord& child : object.children) {
            if (child.name == "KeyTime") child = row("KeyTime", {2 * kTicks, 0.0, kTicks});
            if (child.name == "KeyValueFloat") child = row("KeyValueFloat", {30, 0, 90});
            if (child.name == "KeyAttrRefCount") child = wholes("KeyAttrRefCount", {3});
        }
    }
    const Records once = links;
    links.insert(links.end(), once.begin(), once.end());
    std::string text = "; a comment\n" + asciiFbx(document(objects, links));
    for (const char end : {'\n', '\r'}) {
        std::ranges::replace(text, '\n', end);
        const Result<SourceScene> read = readBytes("; FBX 7.4.0 project file" + std::string(1, end) + text);
        REQUIRE(read.ok());
        const SourceScene& scene = read.value();
        REQUIRE(scene.clips.size() == 1);
        CHECK(difference(parentFromNodes(scene, scene.clips[0], 0.5)[1], xyz({45, 20, 30})) < 1e-4);
        CHECK(difference(parentFromNodes(scene, scene.clips[0], 1.5)[1], xyz({60, 20, 30})) < 1e-4);
    }
}

TEST_CASE("what is no number in an ASCII FBX is none, in Microsoft's spelling too") {
    const auto sections = document({model(1, "Body", {}), square({})}, {fbxLink(1, 0), fbxLink(3, 1)});
    for (const std::string spelling : {"-1.#IND", "1.#QNAN", "1.#INF00", "nan"}) {
        INFO(spelling);
        std::string text = asciiFbx(sections);
        const std::size_t place = text.find("-1", text.find("Vertices"));
        REQUIRE(place != std::string::npos);
        text.replace(place, 2, spelling);
        const Result<SourceScene> scene = readBytes(text);
        REQUIRE(scene.ok());
        REQUIRE(scene.value().meshes.size() == 1);
        const auto& positions = scene.value().meshes[0].positions;
        CHECK(std::ranges::count_if(positions, [](const vec3& p) { return !std::isfinite(p.x); }) == 1);
    }
}

TEST_CASE("nodes of another unit than the bind pose are brought to its size, whatever they scale besides") {
    const auto numbers = [](const dmat4& m) {
        std::vector<double> out;
        for (int i = 0; i < 16; ++i)
            out.push_back(m[i / 4][i % 4]);
        return out;
    };
    for (const double chest : {1.0, 3.0}) {
        INFO(chest);
        // A strip up three joints a metre apart, bound at a hundred times the size that the nodes have, one of which
        // turns about.
        Records objects{model(1, "Body", {}),
                        model(2, "Hips", {}),
                        model(5, "Spine", {{"Lcl Translation", {0, 1, 0}}, {"Lcl Rotation", {0, 0, 90}}}),
                        model(6, "Chest", {{"Lcl Translation", {0, 1, 0}}, {"Lcl Scaling", {chest, chest, chest}}}),
                        {"Geometry",
                         {std::int64_t{3}, std::string("Geometry::Strip"), std::string("Mesh")},
                         {row("Vertices", {-10, 0, 0, 10, 0, 0, 10, 100, 0, -10, 100, 0, 10, 200, 0, -10, 200, 0}),
                          wholes("PolygonVertexIndex", {0, 1, 2, -4, 3, 2, 4, -6})}},
                        {"Deformer", {std::int64_t{4}, std::string("Deformer::"), std::string("Skin")}, {}}};
        Records links{fbxLink(1, 0), fbxLink(2, 0), fbxLink(5, 2), fbxLink(6, 5), fbxLink(3, 1), fbxLink(4, 3)};
        const std::int64_t joints[] = {2, 5, 6};
        for (int i = 0; i < 3; ++i) {
            const dmat4 link = move({0, 100.0 * i, 0}) * glm::scale(dmat4(1.0), dvec3(100));
            objects.push_back({"Deformer",
                               {std::int64_t{10} + i, std::string("SubDeformer::"), std::string("Cluster")},
                               {wholes("Indexes", {2 * i, 2 * i + 1}), row("Weights", {1, 1}),
                                row("Transform", numbers(glm::inverse(link))), row("TransformLink", numbers(link))}});
            links.push_back(fbxLink(10 + i, 4));
            links.push_back(fbxLink(joints[i], 10 + i));
        }
        const ScratchFolder folder;
        const std::string file = folder / "units.fbx";
        std::ofstream(file, std::ios::binary) << asciiFbx(document(std::move(objects), std::move(links)));
        const Character character = imported(file);
        CHECK(warns(character, "the nodes' pose is 0.01 times the size of the bind pose"));
        CHECK(warns(character, "the scale was dropped") == (chest != 1.0));
        const std::vector<RigidTransform> pose = nodePose(character.skeleton);
        const auto gap = [&](const std::vector<RigidTransform>& frames, const char* from, const char* to) {
            return glm::distance(frames[static_cast<std::size_t>(findJoint(character.skeleton, from))].translation,
                                 frames[static_cast<std::size_t>(findJoint(character.skeleton, to))].translation);
        };
        const float wanted = gap(character.skeleton.bindModelFromJoint, "Hips", "Spine");
        CHECK(wanted > 0.5F);
        CHECK(gap(pose, "Hips", "Spine") == Approx(wanted));
        CHECK(gap(pose, "Spine", "Chest") == Approx(wanted));
    }
}

TEST_CASE("what of an FBX has no triangles, hangs on nothing or moves nothing is told") {
    const auto told = [](const FbxRecord& object) {
        const SourceScene scene =
            readAll(document({model(1, "Face", {}), square({}), object}, {fbxLink(1, 0), fbxLink(3, 1)}));
        std::string all;
        for (const std::string& warning : scene.warnings)
            all += warning;
        return all;
    };
    CHECK(told({"Geometry", {std::int64_t{40}, std::string("Geometry::"), std::string("NurbsCurve")}, {}}).empty());
    CHECK(told({"Geometry", {std::int64_t{40}, std::string("Geometry::"), std::string("NurbsSurface")}, {}}) ==
          "left out: curved surfaces (NURBS and patches)");
    CHECK(told({"Deformer", {std::int64_t{40}, std::string("Deformer::"), std::string("VertexCacheDeformer")}, {}}) ==
          "left out: deformation by vertex caches");
    CHECK(told({"Geometry", {std::int64_t{40}, std::string("Geometry::"), std::string("Mesh")}, {}}) ==
          "left out: meshes that are connected to no node");
    CHECK(told({"AnimationCurve", {std::int64_t{40}, std::string("AnimCurve::"), std::string()}, {}}) ==
          "left out: animations, for none of them moves a node in a stack and layer");
}
