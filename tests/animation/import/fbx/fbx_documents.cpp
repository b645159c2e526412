#include "animation/import/fbx/fbx_documents.hpp"

#include <algorithm>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "animation/import/fbx/read_fbx.hpp"
#include "support/catch.hpp"
#include "support/command.hpp"

namespace lutka::test {

using animation::rig_import::SourceScene;

FbxRecord row(const std::string& name, std::vector<double> numbers) {
    return {name, {std::move(numbers)}, {}};
}

FbxRecord wholes(const std::string& name, std::vector<std::int32_t> numbers) {
    return {name, {std::move(numbers)}, {}};
}

FbxRecord model(std::int64_t id, const std::string& name, const Numbers& properties) {
    return {"Model", {id, "Model::" + name, std::string("LimbNode")}, {fbxProperties(properties)}};
}

std::vector<FbxRecord> document(std::vector<FbxRecord> objects, std::vector<FbxRecord> links) {
    return {{"Objects", {}, std::move(objects)}, {"Connections", {}, std::move(links)}};
}

void addTurn(double from, double to, std::vector<FbxRecord>& objects, std::vector<FbxRecord>& links) {
    const auto object = [&](const std::string& kind, std::int64_t id, const std::string& name,
                            std::vector<FbxRecord> children) {
        objects.push_back({kind, {id, name, std::string()}, std::move(children)});
    };
    object("AnimationStack", 8, "AnimStack::Wave", {});
    object("AnimationLayer", 9, "AnimLayer::Base", {});
    object("AnimationCurveNode", 10, "AnimCurveNode::R",
           {fbxProperties({{"d|X", {from}}, {"d|Y", {20}}, {"d|Z", {30}}})});
    object("AnimationCurve", 11, "AnimCurve::",
           {row("KeyTime", {0.0, kTicks}), row("KeyValueFloat", {from, to}), wholes("KeyAttrFlags", {4}),
            row("KeyAttrDataFloat", {0, 0, 0, 0}), wholes("KeyAttrRefCount", {2})});
    for (FbxRecord& link :
         std::vector{fbxLink(9, 8), fbxLink(10, 9), fbxLink(10, 7, "Lcl Rotation"), fbxLink(11, 10, "d|X")})
        links.push_back(std::move(link));
}

Result<SourceScene> readBytes(const std::string& bytes) {
    const ScratchFolder folder;
    const std::string file = folder / "document.fbx";
    std::ofstream(file, std::ios::binary) << bytes;
    return animation::rig_import::readFbx(file, {});
}

SourceScene readAll(const std::vector<FbxRecord>& sections) {
    Result<SourceScene> scene = readBytes(asciiFbx(sections));
    if (!scene) FAIL(scene.error().text());
    return std::move(scene).value();
}

dmat4 turn(double degrees, int axis) {
    dvec3 about(0);
    about[axis] = 1.0;
    return glm::rotate(dmat4(1.0), glm::radians(degrees), about);
}

dmat4 xyz(const dvec3& degrees) {
    return turn(degrees.z, 2) * turn(degrees.y, 1) * turn(degrees.x, 0);
}

dmat4 move(const dvec3& by) {
    return glm::translate(dmat4(1.0), by);
}

double difference(const dmat4& a, const dmat4& b) {
    double worst = 0.0;
    for (int column = 0; column < 4; ++column)
        worst = std::max(worst, glm::length(a[column] - b[column]));
    return worst;
}

const Numbers& pivotsOfAllKinds() {
    static const Numbers kPivots = {{"Lcl Translation", {1, 2, 3}}, {"Lcl Rotation", {10, 20, 30}},
                                    {"Lcl Scaling", {2, 2, 2}},     {"RotationOffset", {4, 5, 6}},
                                    {"RotationPivot", {7, 8, 9}},   {"PreRotation", {15, 25, 35}},
                                    {"PostRotation", {40, 50, 60}}, {"ScalingOffset", {3, 1, 2}},
                                    {"ScalingPivot", {5, 7, 6}},    {"RotationActive", {1}}};
    return kPivots;
}

dmat4 pivotsMatrix(const dvec3& rotation) {
    return move({1, 2, 3}) * move({4, 5, 6}) * move({7, 8, 9}) * xyz({15, 25, 35}) * xyz(rotation) *
           glm::inverse(xyz({40, 50, 60})) * move({-7, -8, -9}) * move({3, 1, 2}) * move({5, 7, 6}) *
           glm::scale(dmat4(1.0), dvec3(2)) * move({-5, -7, -6});
}

}  // namespace lutka::test
