#include "animation/import/fbx/skin.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "animation/import/affine.hpp"

namespace lutka::animation::rig_import::fbx {
namespace {

struct Cluster {
    int node = -1;
    std::optional<dmat4> sceneFromJoint;  // TransformLink
    std::optional<dmat4> jointFromMesh;   // Transform
    std::vector<double> points;
    std::vector<double> weights;
    double weight = 0.0;
    bool isAdditive = false;
};

std::optional<dmat4> matrixOf(const Record& record, std::string_view name) {
    const std::vector<double> numbers = record.numbersOf(name);
    if (numbers.size() != 16) return std::nullopt;
    dmat4 out;
    for (int i = 0; i < 16; ++i)
        out[i / 4][i % 4] = numbers[static_cast<std::size_t>(i)];
    return isInvertible(out) ? std::optional(out) : std::nullopt;
}

std::vector<Cluster> clustersOf(const SkinContext& context, int owner) {
    std::vector<Cluster> clusters;
    for (const int skin : context.objects.children(owner, "Deformer", "Skin")) {
        for (const int index : context.objects.children(skin, "Deformer", "Cluster")) {
            Cluster cluster;
            for (const int model : context.objects.children(index, "Model")) {
                const auto node = context.nodeOfModel.find(model);
                if (node != context.nodeOfModel.end() && cluster.node < 0) cluster.node = node->second;
            }
            if (cluster.node < 0) continue;
            const Record& record = *context.objects[index].record;
            if (const std::optional<dmat4> link = matrixOf(record, "TransformLink"))
                cluster.sceneFromJoint = context.sceneFromFile * *link;
            cluster.jointFromMesh = matrixOf(record, "Transform");
            if (const Record* mode = record.child("Mode")) cluster.isAdditive = mode->text(0) == "Additive";
            cluster.points = record.numbersOf("Indexes");
            cluster.weights = record.numbersOf("Weights");
            for (const double weight : cluster.weights)
                cluster.weight += weight > 0.0 && std::isfinite(weight) ? weight : 0.0;
            clusters.push_back(std::move(cluster));
        }
    }
    return clusters;
}

bool same(const dmat4& a, const dmat4& b) {
    double difference = 0.0;
    double size = 0.0;
    for (int column = 0; column < 4; ++column) {
        difference = std::max(difference, glm::length(a[column] - b[column]));
        size = std::max(size, glm::length(a[column]));
    }
    return difference <= 1e-6 * size;
}

// Whether joints that stand apart all state the same way to the mesh: then Transform means something else.
bool contradicts(std::span<const Cluster> clusters) {
    const Cluster* first = nullptr;
    bool apart = false;
    for (const Cluster& cluster : clusters) {
        if (!cluster.sceneFromJoint || !cluster.jointFromMesh) continue;
        if (first == nullptr) first = &cluster;
        if (!same(*first->jointFromMesh, *cluster.jointFromMesh)) return false;
        apart = apart || !same(*first->sceneFromJoint, *cluster.sceneFromJoint);
    }
    return apart;
}

dmat4 placeOfMesh(const SkinContext& context, int mesh) {
    const auto bind = context.bindPose.find(mesh);
    if (bind != context.bindPose.end() && isInvertible(bind->second)) return bind->second;
    const auto node = context.nodeOfModel.find(mesh);
    return node != context.nodeOfModel.end() ? context.sceneFromNode[static_cast<std::size_t>(node->second)]
                                             : dmat4(1.0);
}

void addWeights(std::span<const Cluster> clusters, std::size_t controlPoints, ReadSkin& out) {
    const auto isPoint = [controlPoints](double point) {
        return point >= 0.0 && point < static_cast<double>(controlPoints);
    };
    out.start.assign(controlPoints + 1, 0);
    for (const Cluster& cluster : clusters) {
        for (std::size_t i = 0; i < std::min(cluster.points.size(), cluster.weights.size()); ++i) {
            if (isPoint(cluster.points[i])) ++out.start[static_cast<std::size_t>(cluster.points[i]) + 1];
        }
    }
    for (std::size_t point = 0; point < controlPoints; ++point)
        out.start[point + 1] += out.start[point];
    out.influences.resize(out.start.back());
    std::vector<std::uint32_t> next(out.start.begin(), out.start.end() - 1);
    for (std::size_t slot = 0; slot < clusters.size(); ++slot) {
        const Cluster& cluster = clusters[slot];
        for (std::size_t i = 0; i < std::min(cluster.points.size(), cluster.weights.size()); ++i) {
            if (!isPoint(cluster.points[i])) continue;
            out.influences[next[static_cast<std::size_t>(cluster.points[i])]++] = {
                static_cast<std::uint32_t>(slot), static_cast<float>(cluster.weights[i])};
        }
    }
}

}  // namespace

std::map<int, dmat4> readBindPose(const Objects& objects) {
    std::map<int, dmat4> poses;
    for (const Object& object : objects.all()) {
        if (object.kind != "Pose" || object.subKind != "BindPose") continue;
        for (const Record& entry : object.record->children) {
            const Record* node = entry.name == "PoseNode" ? entry.child("Node") : nullptr;
            if (node == nullptr) continue;
            const int index = objects.indexOf(*node, 0);
            const std::optional<dmat4> matrix = matrixOf(entry, "Matrix");
            if (index >= 0 && matrix) poses.emplace(index, *matrix);
        }
    }
    return poses;
}

std::optional<ReadSkin> readSkin(const SkinContext& context, int owner, int mesh, std::size_t controlPoints) {
    const std::vector<Cluster> clusters = clustersOf(context, owner);
    const auto heaviest = std::max_element(clusters.begin(), clusters.end(),
                                           [](const Cluster& a, const Cluster& b) { return a.weight < b.weight; });
    if (heaviest == clusters.end()) return std::nullopt;
    const dmat4 place = placeOfMesh(context, mesh);
    const bool useTransform = !contradicts(clusters);
    const auto sceneFromJoint = [&](const Cluster& cluster) {
        return cluster.sceneFromJoint.value_or(context.sceneFromNode[static_cast<std::size_t>(cluster.node)]);
    };
    ReadSkin out;
    for (const Cluster& cluster : clusters) {
        const dmat4 joint = sceneFromJoint(cluster);
        const dmat4 fromPlace = isInvertible(joint) ? glm::inverse(joint) * place : dmat4(1.0);
        const dmat4 stated = cluster.jointFromMesh.value_or(fromPlace);
        out.skin.joints.push_back({cluster.node, useTransform ? stated : fromPlace});
        if (&cluster == &*heaviest && cluster.sceneFromJoint)
            out.skin.sceneFromMesh = joint * out.skin.joints.back().jointFromMesh;
    }
    addWeights(clusters, controlPoints, out);
    out.isAdditive =
        std::any_of(clusters.begin(), clusters.end(), [](const Cluster& cluster) { return cluster.isAdditive; });
    for (const int skin : context.objects.children(owner, "Deformer", "Skin")) {
        const Record* type = context.objects[skin].record->child("SkinningType");
        if (type != nullptr && (type->text(0) == "DualQuaternion" || type->text(0) == "Blend")) out.isLinear = false;
    }
    return out;
}

void weightVertices(const ReadSkin& skin, std::span<const std::uint32_t> controlPoints, SourceMesh& mesh) {
    mesh.influenceStart.assign(1, 0);
    mesh.influenceStart.reserve(controlPoints.size() + 1);
    for (const std::uint32_t point : controlPoints) {
        const auto first = skin.influences.begin() + static_cast<std::ptrdiff_t>(skin.start[point]);
        const auto last = skin.influences.begin() + static_cast<std::ptrdiff_t>(skin.start[point + 1]);
        mesh.influences.insert(mesh.influences.end(), first, last);
        mesh.influenceStart.push_back(static_cast<std::uint32_t>(mesh.influences.size()));
    }
}

}  // namespace lutka::animation::rig_import::fbx
