#include "physics/collision/triangle_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <unordered_map>

#include "core/aabb.hpp"
#include "core/math.hpp"

namespace lutka::physics {
namespace {

constexpr std::size_t kMost = 10'000'000;
constexpr int kLeaf = 4;  // triangles

struct PlaceHash {
    std::size_t operator()(const vec3& v) const {
        std::uint64_t hash = 1469598103934665603ULL;
        for (int i = 0; i < 3; ++i) {
            std::uint32_t bits = 0;
            const float value = v[i] + 0.0F;  // one zero
            std::memcpy(&bits, &value, sizeof bits);
            hash = (hash ^ bits) * 1099511628211ULL;
        }
        return static_cast<std::size_t>(hash ^ (hash >> 29U));
    }
};

Error refuse(const std::string& message) {
    return {ErrorCode::input, message, {}, {}};
}

float angleAt(const vec3& corner, const vec3& a, const vec3& b) {
    const vec3 u = a - corner;
    const vec3 v = b - corner;
    return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
}

}  // namespace

TrianglePoint nearestOnTriangle(const vec3& a, const vec3& b, const vec3& c, const vec3& point) {
    const vec3 ab = b - a;
    const vec3 ac = c - a;
    const vec3 ap = point - a;
    const float d1 = glm::dot(ab, ap);
    const float d2 = glm::dot(ac, ap);
    if (d1 <= 0.0F && d2 <= 0.0F) return {a, 4};
    const vec3 bp = point - b;
    const float d3 = glm::dot(ab, bp);
    const float d4 = glm::dot(ac, bp);
    if (d3 >= 0.0F && d4 <= d3) return {b, 5};
    const float vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0F && d1 >= 0.0F && d3 <= 0.0F) return {a + ab * (d1 / (d1 - d3)), 1};
    const vec3 cp = point - c;
    const float d5 = glm::dot(ab, cp);
    const float d6 = glm::dot(ac, cp);
    if (d6 >= 0.0F && d5 <= d6) return {c, 6};
    const float vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0F && d2 >= 0.0F && d6 <= 0.0F) return {a + ac * (d2 / (d2 - d6)), 3};
    const float va = d3 * d6 - d5 * d4;
    if (va <= 0.0F && d4 - d3 >= 0.0F && d5 - d6 >= 0.0F)
        return {b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))), 2};
    const float scale = 1.0F / (va + vb + vc);
    return {a + ab * (vb * scale) + ac * (vc * scale), 0};
}

Result<std::shared_ptr<const TriangleMesh>> TriangleMesh::make(std::span<const vec3> vertices,
                                                               std::span<const Triangle> triangles) {
    if (vertices.size() > kMost || triangles.size() > kMost)
        return refuse("a triangle mesh may have at most 10,000,000 vertices and triangles");
    for (std::size_t i = 0; i < vertices.size(); ++i)
        if (!isFinite(vertices[i])) return refuse("vertex " + std::to_string(i) + " of a triangle mesh is not finite");
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        for (const int corner : triangles[i]) {
            if (corner < 0 || static_cast<std::size_t>(corner) >= vertices.size())
                return refuse("triangle " + std::to_string(i) + " of a mesh names vertex " + std::to_string(corner) +
                              " of " + std::to_string(vertices.size()));
        }
    }
    std::shared_ptr<TriangleMesh> mesh(new TriangleMesh);
    mesh->takeVertices(vertices, triangles);
    if (mesh->triangles_.empty()) return refuse("a triangle mesh has no triangle with an area");
    mesh->buildTree();
    mesh->findEdges();
    mesh->findFans();
    return std::shared_ptr<const TriangleMesh>(std::move(mesh));
}

void TriangleMesh::takeVertices(std::span<const vec3> vertices, std::span<const Triangle> triangles) {
    std::unordered_map<vec3, int, PlaceHash> known;
    std::vector<int> merged(vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const auto [at, fresh] = known.emplace(vertices[i], static_cast<int>(vertices_.size()));
        if (fresh) vertices_.push_back(vertices[i]);
        merged[i] = at->second;
    }
    for (const Triangle& given : triangles) {
        const Triangle t{merged[given[0]], merged[given[1]], merged[given[2]]};
        const vec3 u = vertices_[t[1]] - vertices_[t[0]];
        const vec3 v = vertices_[t[2]] - vertices_[t[0]];
        const vec3 across = glm::cross(u, v);
        const float area = glm::length(across);
        if (!(area > 1e-7F * (glm::dot(u, u) + glm::dot(v, v))) || area < 1e-12F) continue;
        triangles_.push_back(t);
        normals_.push_back(across / area);
    }
}

void TriangleMesh::buildTree() {
    std::vector<vec3> centres(triangles_.size());
    for (std::size_t i = 0; i < triangles_.size(); ++i)
        centres[i] = (vertices_[triangles_[i][0]] + vertices_[triangles_[i][1]] + vertices_[triangles_[i][2]]) / 3.0F;
    std::vector<int> order(triangles_.size());
    std::iota(order.begin(), order.end(), 0);
    buildBranch(order, centres);
    // Leaves name their triangles by place in `order`: bring the triangles there.
    std::vector<Triangle> triangles(order.size());
    std::vector<vec3> normals(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        triangles[i] = triangles_[order[i]];
        normals[i] = normals_[order[i]];
    }
    int first = 0;
    for (Node& node : nodes_) {
        node.first = first;
        first += node.count;
    }
    triangles_ = std::move(triangles);
    normals_ = std::move(normals);
}

void TriangleMesh::buildBranch(std::span<int> order, const std::vector<vec3>& centres) {
    const std::size_t index = nodes_.size();
    nodes_.emplace_back();
    Aabb box;
    Aabb ofCentres;
    for (const int triangle : order) {
        for (const int corner : triangles_[triangle])
            box.add(vertices_[corner]);
        ofCentres.add(centres[triangle]);
    }
    if (order.size() <= kLeaf) {
        nodes_[index].count = static_cast<int>(order.size());
    } else {
        const vec3 size = ofCentres.size();
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
        const std::size_t half = order.size() / 2;
        std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(half), order.end(),
                         [&](int a, int b) { return centres[a][axis] < centres[b][axis]; });
        buildBranch(order.first(half), centres);
        buildBranch(order.subspan(half), centres);
    }
    nodes_[index].low = box.low;
    nodes_[index].high = box.high;
    nodes_[index].next = static_cast<int>(nodes_.size());
}

void TriangleMesh::findEdges() {
    std::map<std::pair<int, int>, int> known;
    triangleEdges_.resize(triangles_.size());
    for (int t = 0; t < static_cast<int>(triangles_.size()); ++t) {
        for (int i = 0; i < 3; ++i) {
            const int start = triangles_[t][i];
            const int end = triangles_[t][(i + 1) % 3];
            const int opposite = triangles_[t][(i + 2) % 3];
            const auto [at, fresh] = known.emplace(std::minmax(start, end), static_cast<int>(edges_.size()));
            if (fresh) edges_.push_back({start, end, {opposite, -1}, {t, -1}, true});
            triangleEdges_[t][i] = at->second;
            Edge& edge = edges_[at->second];
            if (fresh || edge.triangle[1] >= 0) continue;  // a third triangle at an edge counts as a surface of its own
            edge.opposite[1] = opposite;
            edge.triangle[1] = t;
            const vec3 away = vertices_[opposite] - vertices_[edge.start];
            edge.sharp = risesAbove(-normals_[edge.triangle[0]], away);
        }
    }
}

void TriangleMesh::findFans() {
    owner_.assign(vertices_.size(), -1);
    vertexNormals_.assign(vertices_.size(), vec3(0));
    for (int t = 0; t < static_cast<int>(triangles_.size()); ++t) {
        const Triangle& corners = triangles_[t];
        for (int i = 0; i < 3; ++i) {
            const int vertex = corners[i];
            if (owner_[vertex] < 0) owner_[vertex] = t;
            const float angle =
                angleAt(vertices_[vertex], vertices_[corners[(i + 1) % 3]], vertices_[corners[(i + 2) % 3]]);
            vertexNormals_[vertex] += angle * normals_[t];
        }
    }
    // Beside the rim of a sheet nothing is behind it: no side there.
    for (const Edge& edge : edges_)
        if (edge.triangle[1] < 0) vertexNormals_[edge.start] = vertexNormals_[edge.end] = vec3(0);
    fanStart_.assign(vertices_.size() + 1, 0);
    for (const Edge& edge : edges_) {
        ++fanStart_[edge.start + 1];
        ++fanStart_[edge.end + 1];
    }
    std::partial_sum(fanStart_.begin(), fanStart_.end(), fanStart_.begin());
    fan_.resize(2 * edges_.size());
    std::vector<int> filled(fanStart_.begin(), fanStart_.end() - 1);
    for (const Edge& edge : edges_) {
        fan_[filled[edge.start]++] = edge.end;
        fan_[filled[edge.end]++] = edge.start;
    }
}

bool TriangleMesh::vertexSupports(int vertex, const vec3& direction) const {
    for (int i = fanStart_[vertex]; i < fanStart_[vertex + 1]; ++i) {
        if (risesAbove(direction, vertices_[fan_[i]] - vertices_[vertex])) return false;
    }
    return true;
}

bool TriangleMesh::edgeSupports(int index, const vec3& direction) const {
    const Edge& edge = edges_[index];
    for (const int opposite : edge.opposite) {
        if (opposite >= 0 && risesAbove(direction, vertices_[opposite] - vertices_[edge.start])) return false;
    }
    return true;
}

vec3 TriangleMesh::pseudoNormal(int triangle, int region) const {
    if (region >= 4) return vertexNormals_[triangles_[triangle][region - 4]];
    if (region == 0) return normals_[triangle];
    const Edge& edge = edges_[triangleEdges_[triangle][region - 1]];
    if (edge.triangle[1] < 0) return vec3(0);
    return normals_[edge.triangle[0]] + normals_[edge.triangle[1]];
}

MeshDistance TriangleMesh::distanceTo(const vec3& point, float range) const {
    float best2 = range * range;
    MeshDistance result;
    vec3 nearest(0);
    vec3 outward(0);
    int nearestTriangle = -1;
    for (int at = 0; at < static_cast<int>(nodes_.size());) {
        const Node& node = nodes_[at];
        const vec3 gap = glm::max(glm::max(node.low - point, point - node.high), vec3(0));
        if (glm::dot(gap, gap) > best2) {
            at = node.next;
            continue;
        }
        for (int t = node.first; t < node.first + node.count; ++t) {
            const Triangle& corners = triangles_[t];
            const TrianglePoint on =
                nearestOnTriangle(vertices_[corners[0]], vertices_[corners[1]], vertices_[corners[2]], point);
            const vec3 away = point - on.position;
            const float distance2 = glm::dot(away, away);
            if (distance2 > best2) continue;
            best2 = distance2;
            nearest = on.position;
            nearestTriangle = t;
            outward = pseudoNormal(t, on.region);
        }
        ++at;
    }
    if (nearestTriangle < 0) return result;
    const vec3 away = point - nearest;
    const float gap = glm::length(away);
    const float side = glm::dot(away, outward) < 0.0F ? -1.0F : 1.0F;
    result.found = true;
    result.distance = side * gap;
    result.normal = gap > 1e-5F ? away * (side / gap) : normals_[nearestTriangle];
    return result;
}

TriangleMesh::Ray TriangleMesh::rayTest(const vec3& from, const vec3& to) const {
    Ray nearest;
    const vec3 along = to - from;
    const auto meetsBox = [&](const Node& node, float most) {
        float enter = 0.0F;
        float leave = most;
        for (int axis = 0; axis < 3; ++axis) {
            if (along[axis] == 0.0F) {
                if (from[axis] < node.low[axis] || from[axis] > node.high[axis]) return false;
                continue;
            }
            const float a = (node.low[axis] - from[axis]) / along[axis];
            const float b = (node.high[axis] - from[axis]) / along[axis];
            enter = std::max(enter, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
        }
        return enter <= leave;
    };
    for (int at = 0; at < static_cast<int>(nodes_.size());) {
        const Node& node = nodes_[at];
        if (!meetsBox(node, std::min(nearest.fraction, 1.0F))) {
            at = node.next;
            continue;
        }
        for (int t = node.first; t < node.first + node.count; ++t) {
            const auto& [a, b, c] = triangles_[t];
            const auto hit = crossTriangle(vertices_[a], vertices_[b], vertices_[c], from, along, Sides::front);
            if (hit && hit->along >= 0.0F && hit->along <= 1.0F && hit->along < nearest.fraction)
                nearest = {hit->along, t};
        }
        ++at;
    }
    return nearest;
}

}  // namespace lutka::physics
