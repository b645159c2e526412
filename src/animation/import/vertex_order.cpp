#include "animation/import/vertex_order.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace lutka::animation::rig_import {
namespace {

struct Key {
    int count = 0;
    std::array<std::uint16_t, kMaxInfluences> joints{};  // those that count

    [[nodiscard]] bool operator<(const Key& other) const {
        return std::tie(count, joints) < std::tie(other.count, other.joints);
    }
};

Key keyOf(const SkinnedMesh& mesh, std::size_t vertex) {
    Key key;
    while (key.count < kMaxInfluences && mesh.weights[vertex][key.count] > 0.0F) {
        key.joints[key.count] = mesh.joints[vertex][key.count];
        ++key.count;
    }
    return key;
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
    std::vector<Key> keys;
    keys.reserve(mesh.positions.size());
    for (std::size_t vertex = 0; vertex < mesh.positions.size(); ++vertex)
        keys.push_back(keyOf(mesh, vertex));
    std::vector<std::uint32_t> order(mesh.positions.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
    takeVertices(mesh, order);
    std::vector<std::uint32_t> placeOf(order.size());
    for (std::uint32_t place = 0; place < order.size(); ++place)
        placeOf[order[place]] = place;
    for (std::uint32_t& index : mesh.indices)
        index = placeOf[index];
    mesh.fileOrder = std::move(placeOf);
}

}  // namespace lutka::animation::rig_import
