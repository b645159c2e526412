#include "physics/fit/fit_measures.hpp"

#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "animation/counted_vertices.hpp"
#include "core/aabb.hpp"
#include "core/random.hpp"
#include "physics/collision/shape.hpp"
#include "physics/fit/separate_shapes.hpp"
#include "physics/fit/skin_regions.hpp"

namespace lutka::physics {
namespace {

// Where a ray along +Z meets the skin: the depth, and +1 where it goes in, -1 where it comes out.
struct Crossing {
    float depth;
    int turn;
};

// A grid of rays along the standard stance's Z, one a cell, each at a random place of its cell. Files can hold any
// triangles: what would take more than some seconds or some hundred MB is given up.
class RayGrid {
  public:
    RayGrid(const vec3& low, const vec3& high, float cell)
        : low_(low),
          high_(high),
          cell_(cell),
          columns_(1 + static_cast<int>((high.x - low.x) / cell)),
          rows_(1 + static_cast<int>((high.y - low.y) / cell)),
          crossings_(static_cast<std::size_t>(columns_ * rows_)) {
        Random random(1);
        for (std::size_t i = 0; i < crossings_.size(); ++i) {
            // In statements of their own: compilers differ in the order of a call's arguments.
            const float y = random.uniform(0.0F, 1.0F);
            places_.emplace_back(random.uniform(0.0F, 1.0F), y);
        }
    }

    [[nodiscard]] bool isExhausted() const { return cellsLeft_ < 0 || crossingsLeft_ < 0 || pointsLeft_ < 0; }

    void addTriangle(const vec3& a, const vec3& b, const vec3& c) {
        const vec3 low = glm::min(a, glm::min(b, c));
        const vec3 high = glm::max(a, glm::max(b, c));
        const float doubled = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
        if (doubled == 0.0F) return;
        cellsLeft_ -= static_cast<std::int64_t>(clampedRow(high.y) - clampedRow(low.y) + 1) *
                      (clampedColumn(high.x) - clampedColumn(low.x) + 1);
        if (isExhausted()) return;
        for (int row = clampedRow(low.y); row <= clampedRow(high.y); ++row) {
            for (int column = clampedColumn(low.x); column <= clampedColumn(high.x); ++column) {
                const vec2 p = rayAt(column, row);
                const float u = ((b.x - p.x) * (c.y - p.y) - (c.x - p.x) * (b.y - p.y)) / doubled;
                const float v = ((c.x - p.x) * (a.y - p.y) - (a.x - p.x) * (c.y - p.y)) / doubled;
                if (u < 0.0F || v < 0.0F || u + v > 1.0F) continue;
                const float depth = u * a.z + v * b.z + (1.0F - u - v) * c.z;
                --crossingsLeft_;
                // A triangle that shows its front to +Z is left by the ray.
                crossings_[indexOf(column, row)].push_back({depth, doubled > 0.0F ? -1 : 1});
            }
        }
    }

    // Calls `visit` with points inside the skin, a cell apart along the rays. Rays that do not come out as often as
    // they go in pass a hole and tell nothing.
    template <class Visit>
    void visitInside(Visit visit) {
        for (int row = 0; row < rows_; ++row) {
            for (int column = 0; column < columns_; ++column)
                visitColumn(column, row, visit);
        }
    }

  private:
    template <class Visit>
    void visitColumn(int column, int row, Visit visit) {
        std::vector<Crossing>& ray = crossings_[indexOf(column, row)];
        int turns = 0;
        for (const Crossing& crossing : ray)
            turns += crossing.turn;
        if (ray.empty() || turns != 0) return;
        std::sort(ray.begin(), ray.end(), [](const Crossing& a, const Crossing& b) { return a.depth < b.depth; });
        const vec2 p = rayAt(column, row);
        const float phase = places_[indexOf(row % columns_, 0)].x;
        int inside = 0;
        for (std::size_t i = 0; i + 1 < ray.size(); ++i) {
            inside += ray[i].turn;
            if (inside == 0) continue;
            const float begin = std::max(ray[i].depth, low_.z);
            const float end = std::min(ray[i + 1].depth, high_.z);
            const float first = (std::ceil(begin / cell_ - phase) + phase) * cell_;
            for (float z = first; z < end && --pointsLeft_ >= 0; z += cell_)
                visit(vec3(p, z));
        }
    }

    [[nodiscard]] std::size_t indexOf(int column, int row) const {
        return static_cast<std::size_t>(row) * columns_ + column;
    }
    [[nodiscard]] int clampedColumn(float x) const {
        return std::clamp(static_cast<int>((x - low_.x) / cell_), 0, columns_ - 1);
    }
    [[nodiscard]] int clampedRow(float y) const {
        return std::clamp(static_cast<int>((y - low_.y) / cell_), 0, rows_ - 1);
    }
    [[nodiscard]] vec2 rayAt(int column, int row) const {
        return vec2(low_) + cell_ * (vec2(column, row) + places_[indexOf(column, row)]);
    }

    vec3 low_, high_;
    float cell_;
    int columns_;
    int rows_;
    std::vector<std::vector<Crossing>> crossings_;
    std::vector<vec2> places_;  // of each ray in its cell, [0, 1)
    std::int64_t cellsLeft_ = 400'000'000;
    std::int64_t crossingsLeft_ = 16'000'000;
    std::int64_t pointsLeft_ = 4'000'000;
};

bool isCovered(std::span<const PlacedShape> shapes, const std::vector<RigidTransform>& bodyFromStandard,
               const vec3& point) {
    for (std::size_t body = 0; body < shapes.size(); ++body) {
        if (signedDistance(shapes[body].shape, bodyFromStandard[body] * point) <= 0.0F) return true;
    }
    return false;
}

std::vector<RigidTransform> inverses(std::span<const PlacedShape> shapes) {
    std::vector<RigidTransform> result;
    result.reserve(shapes.size());
    for (const PlacedShape& shape : shapes)
        result.push_back(inverse(shape.standardFromBody));
    return result;
}

std::optional<float> volumeCovered(const animation::Character& character, float heightM, const mat3& toStandard,
                                   std::span<const PlacedShape> shapes) {
    constexpr float kCell = 1.0F / 120.0F;  // of the height: some 50,000 points in a man
    Aabb box;
    for (const animation::SkinnedMesh& mesh : character.meshes) {
        for (const vec3& position : mesh.positions)
            box.add(toStandard * position);
    }
    // A stray vertex may not blow the grid up: what lies beyond three heights is not looked at.
    const vec3 reach(3.0F * heightM);
    const vec3 low = glm::max(box.low, shapes[0].standardFromBody.translation - reach);
    const vec3 high = glm::min(box.high, shapes[0].standardFromBody.translation + reach);
    if (low.x >= high.x || low.y >= high.y) return std::nullopt;
    RayGrid grid(low, high, kCell * heightM);
    for (const animation::SkinnedMesh& mesh : character.meshes) {
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            grid.addTriangle(toStandard * mesh.positions[mesh.indices[i]],
                             toStandard * mesh.positions[mesh.indices[i + 1]],
                             toStandard * mesh.positions[mesh.indices[i + 2]]);
        }
    }
    const std::vector<RigidTransform> bodyFromStandard = inverses(shapes);
    std::size_t inside = 0;
    std::size_t covered = 0;
    grid.visitInside([&](const vec3& point) {
        ++inside;
        covered += isCovered(shapes, bodyFromStandard, point) ? 1 : 0;
    });
    constexpr std::size_t kFewest = 500;
    if (inside < kFewest || grid.isExhausted()) return std::nullopt;
    return static_cast<float>(covered) / static_cast<float>(inside);
}

}  // namespace

std::vector<BodyOverlap> findOverlaps(const RagdollProfile& profile, std::span<const PlacedShape> shapes) {
    const std::vector<int> parents = parentsOfBodies(profile);
    const int count = static_cast<int>(shapes.size());
    std::vector<BodyOverlap> overlaps;
    for (int a = 0; a < count; ++a) {
        for (int b = a + 1; b < count; ++b) {
            const auto& pairs = profile.filteredPairs;
            if (parents[b] == a || parents[a] == b) continue;
            if (std::find(pairs.begin(), pairs.end(), std::pair(a, b)) != pairs.end()) continue;
            const float depth = -distanceBetween(shapes[a].shape, shapes[a].standardFromBody, shapes[b].shape,
                                                 shapes[b].standardFromBody);
            if (depth > 0.0F) overlaps.push_back({a, b, depth});
        }
    }
    return overlaps;
}

FitMeasures measureSkin(const animation::Character& character, const BodyPlan& plan,
                        std::span<const PlacedShape> shapes, const quat& standardFromModel) {
    FitMeasures measures;
    const std::vector<RigidTransform> bodyFromStandard = inverses(shapes);
    const mat3 toStandard = glm::mat3_cast(standardFromModel);
    const std::vector<std::size_t> counted = animation::countedVertices(character);
    double near = 0.0;
    double all = 0.0;
    for (std::size_t part = 0; part < character.meshes.size(); ++part) {
        const animation::SkinnedMesh& mesh = character.meshes[part];
        const double each =
            static_cast<double>(counted[part]) / static_cast<double>(std::max<std::size_t>(mesh.positions.size(), 1));
        const std::vector<int> owners = ownersOfVertices(plan, mesh, toStandard);
        for (std::size_t vertex = 0; vertex < owners.size(); ++vertex) {
            if (plan.held[mesh.joints[vertex][0]]) continue;
            const vec3 point = bodyFromStandard[owners[vertex]] * (toStandard * mesh.positions[vertex]);
            const float distance = std::abs(signedDistance(shapes[owners[vertex]].shape, point));
            near += distance <= kNearSkin * plan.heightM ? each : 0.0;
            all += each;
            ++measures.vertices;
        }
    }
    if (measures.vertices == 0) return measures;
    measures.skinNear = static_cast<float>(near / all);
    measures.volumeCovered = volumeCovered(character, plan.heightM, toStandard, shapes);
    return measures;
}

}  // namespace lutka::physics
