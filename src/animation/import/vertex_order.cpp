#include "animation/import/vertex_order.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace lutka::animation::rig_import {
namespace {

// Vertices that follow each other and belong to one place: by how many joints move them, then by these, then by where
// they were.
struct Run {
    int count = 0;
    std::uint64_t joints = 0;  // sixteen bits each, the strongest highest; of those that count
    std::uint32_t first = 0;
    std::uint32_t length = 1;

    [[nodiscard]] bool operator<(const Run& other) const {
        return std::tie(count, joints, first) < std::tie(other.count, other.joints, other.first);
    }
};

Run runOf(const SkinnedMesh& mesh, std::uint32_t vertex) {
    Run run;
    run.first = vertex;
    while (run.count < kMaxInfluences && mesh.weights[vertex][run.count] > 0.0F) {
        const std::uint64_t joint = mesh.joints[vertex][run.count];
        ++run.count;
        run.joints |= joint << static_cast<unsigned>(16 * (kMaxInfluences - run.count));
    }
    return run;
}

std::vector<Run> runsOf(const SkinnedMesh& mesh) {
    std::vector<Run> runs;
    for (std::uint32_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
        const Run next = runOf(mesh, vertex);
        if (!runs.empty() && runs.back().count == next.count && runs.back().joints == next.joints)
            ++runs.back().length;
        else
            runs.push_back(next);
    }
    return runs;
}

template <class T>
void take(std::vector<T>& values, std::span<const std::uint32_t> from) {
    if (values.empty()) return;
    std::vector<T> taken;
    taken.reserve(from.size());
    for (const std::uint32_t vertex : from)
        taken.push_back(values[vertex]);
    values = std::move(taken);
}

// Metres, or a share of a unit vector: what rounding leaves where a zero was meant. Its square, and products of a few
// of its like, are too small for a float's usual form, on which arithmetic is up to a hundred times slower.
constexpr float kNothing = 1e-12F;

template <class Vector>
void flush(std::vector<Vector>& vectors) {
    for (Vector& vector : vectors) {
        for (int axis = 0; axis < 3; ++axis)
            if (std::abs(vector[axis]) < kNothing) vector[axis] = 0.0F;
    }
}

}  // namespace

void takeVertices(SkinnedMesh& mesh, std::span<const std::uint32_t> from) {
    take(mesh.positions, from);
    take(mesh.normals, from);
    take(mesh.tangents, from);
    take(mesh.uvs, from);
    take(mesh.colors, from);
    take(mesh.joints, from);
    take(mesh.weights, from);
}

void orderForSkinning(SkinnedMesh& mesh) {
    flush(mesh.positions);
    flush(mesh.normals);
    flush(mesh.tangents);
    std::vector<Run> runs = runsOf(mesh);
    std::sort(runs.begin(), runs.end());
    std::vector<std::uint32_t> order;
    order.reserve(mesh.positions.size());
    for (const Run& run : runs) {
        for (std::uint32_t i = 0; i < run.length; ++i)
            order.push_back(run.first + i);
    }
    takeVertices(mesh, order);
    std::vector<std::uint32_t> newIndex(order.size());
    for (std::uint32_t place = 0; place < order.size(); ++place)
        newIndex[order[place]] = place;
    for (std::uint32_t& index : mesh.indices)
        index = newIndex[index];
    mesh.fileOrder = std::move(newIndex);
}

}  // namespace lutka::animation::rig_import
