#include "animation/import/vertex_order.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace lutka::animation::rig_import {
namespace {

// Where a vertex belongs: by how many joints move it, then by these, then by where it was.
struct Place {
    int count = 0;
    std::uint64_t joints = 0;  // sixteen bits each, the strongest highest; of those that count
    std::uint32_t vertex = 0;

    [[nodiscard]] bool operator<(const Place& other) const {
        return std::tie(count, joints, vertex) < std::tie(other.count, other.joints, other.vertex);
    }
};

Place placeOf(const SkinnedMesh& mesh, std::uint32_t vertex) {
    Place place;
    place.vertex = vertex;
    while (place.count < kMaxInfluences && mesh.weights[vertex][place.count] > 0.0F) {
        const std::uint64_t joint = mesh.joints[vertex][place.count];
        ++place.count;
        place.joints |= joint << static_cast<unsigned>(16 * (kMaxInfluences - place.count));
    }
    return place;
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
    std::vector<Place> places;
    places.reserve(mesh.positions.size());
    for (std::uint32_t vertex = 0; vertex < mesh.positions.size(); ++vertex)
        places.push_back(placeOf(mesh, vertex));
    std::sort(places.begin(), places.end());
    std::vector<std::uint32_t> order;
    order.reserve(places.size());
    for (const Place& place : places)
        order.push_back(place.vertex);
    takeVertices(mesh, order);
    std::vector<std::uint32_t> newIndex(order.size());
    for (std::uint32_t place = 0; place < order.size(); ++place)
        newIndex[order[place]] = place;
    for (std::uint32_t& index : mesh.indices)
        index = newIndex[index];
    mesh.fileOrder = std::move(newIndex);
}

}  // namespace lutka::animation::rig_import
