#include "physics/profile/convex_hull.hpp"

#include <LinearMath/btConvexHullComputer.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <map>
#include <utility>

namespace lutka::physics {
namespace {

using glm::dmat3;
using glm::dvec3;

constexpr double kFlat = 1e-3;  // of the length

float farthestAlong(std::span<const vec3> points, const vec3& direction) {
    float most = std::numeric_limits<float>::lowest();
    for (const vec3& point : points)
        most = std::max(most, glm::dot(direction, point));
    return most;
}

}  // namespace

/// Puts a hull together from the topology that Bullet's exact arithmetic finds (after Preparata and Hong 1977).
class HullMaker {
  public:
    static ConvexHullPtr make(std::span<const vec3> points) {
        if (points.size() < ConvexHull::kFewestPoints) return nullptr;
        HullMaker maker;
        maker.computer_.compute(&points[0].x, sizeof(vec3), static_cast<int>(points.size()), 0.0F, 0.0F);
        if (maker.computer_.vertices.size() < ConvexHull::kFewestPoints) return nullptr;
        maker.takePoints(points);
        maker.takeFaces();
        if (!maker.isClosed()) return nullptr;
        maker.takeMeasures();
        ConvexHull& hull = *maker.hull_;
        const float length = glm::length(hull.high_ - hull.low_);
        if (!(hull.thickness_ > static_cast<float>(kFlat) * length) || !(hull.volume_ > 0.0F)) return nullptr;
        return maker.hull_;
    }

  private:
    void takePoints(std::span<const vec3> points) {
        const int count = computer_.vertices.size();
        std::vector<std::pair<int, int>> order;  // index among the points given, among the computer's vertices
        order.reserve(static_cast<std::size_t>(count));
        for (int i = 0; i < count; ++i)
            order.emplace_back(computer_.original_vertex_index[i], i);
        std::sort(order.begin(), order.end());
        place_.resize(order.size());
        for (const auto& [given, vertex] : order) {
            place_[static_cast<std::size_t>(vertex)] = static_cast<int>(hull_->points_.size());
            hull_->points_.push_back(points[static_cast<std::size_t>(given)]);
        }
        dvec3 sum(0);
        for (const vec3& point : hull_->points_)
            sum += dvec3(point);
        middle_ = sum / static_cast<double>(hull_->points_.size());
    }

    void takeFaces() {
        for (int i = 0; i < computer_.faces.size(); ++i) {
            const btConvexHullComputer::Edge* first = &computer_.edges[computer_.faces[i]];
            std::vector<int> loop;
            const btConvexHullComputer::Edge* edge = first;
            do {
                loop.push_back(place_[static_cast<std::size_t>(edge->getSourceVertex())]);
                edge = edge->getNextEdgeOfFace();
            } while (edge != first);
            addFace(std::move(loop));
        }
    }

    void addFace(std::vector<int> loop) {
        // Newell's sum: twice the area along the normal.
        dvec3 around(0);
        dvec3 centre(0);
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const dvec3 a = at(loop[i]) - middle_;
            around += glm::cross(a, at(loop[(i + 1) % loop.size()]) - middle_);
            centre += a / static_cast<double>(loop.size());
        }
        // A side whose corners rounding has put on a line has no normal of its own.
        const double twiceArea = glm::length(around);
        const double size = glm::length(centre);
        dvec3 normal = twiceArea > 1e-9 * size * size ? around / twiceArea : centre / size;
        if (glm::dot(normal, centre) < 0.0) {
            normal = -normal;
            std::reverse(loop.begin(), loop.end());
        }
        const auto index = static_cast<int>(hull_->faces_.size());
        for (std::size_t i = 0; i < loop.size(); ++i)
            faceOf_[{loop[i], loop[(i + 1) % loop.size()]}] = index;
        ConvexHull::Face face;
        face.normal = glm::normalize(vec3(normal));
        face.offset = farthestAlong(hull_->points_, face.normal);
        face.first = static_cast<int>(hull_->corners_.size());
        face.count = static_cast<int>(loop.size());
        hull_->corners_.insert(hull_->corners_.end(), loop.begin(), loop.end());
        hull_->faces_.push_back(face);
    }

    // Each edge between two faces; false where the surface has a rim.
    bool isClosed() {
        for (const auto& [way, face] : faceOf_) {
            const auto back = faceOf_.find({way.second, way.first});
            if (back == faceOf_.end()) return false;
            if (way.first < way.second) hull_->edges_.push_back({way.first, way.second, face, back->second});
        }
        return hull_->faces_.size() >= 4;
    }

    // By tetrahedra from the middle to the faces' triangles. Of one with corners 0, a, b, c and volume V the integral
    // of p pᵀ is V/20 (aaᵀ + bbᵀ + ccᵀ + ssᵀ), s = a + b + c.
    void takeMeasures() {
        double volume = 0.0;
        dvec3 first(0);
        dmat3 second(0.0);
        for (const ConvexHull::Face& face : hull_->faces_) {
            const std::span<const int> loop = hull_->cornersOf(face);
            const dvec3 a = at(loop[0]) - middle_;
            for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
                const dvec3 b = at(loop[i]) - middle_;
                const dvec3 c = at(loop[i + 1]) - middle_;
                const double part = glm::dot(a, glm::cross(b, c)) / 6.0;
                const dvec3 s = a + b + c;
                volume += part;
                first += part / 4.0 * s;
                second += part / 20.0 *
                          (glm::outerProduct(a, a) + glm::outerProduct(b, b) + glm::outerProduct(c, c) +
                           glm::outerProduct(s, s));
            }
        }
        ConvexHull& hull = *hull_;
        hull.volume_ = static_cast<float>(volume);
        if (!(volume > 0.0)) return;
        const dvec3 offset = first / volume;
        const dvec3 centroid = middle_ + offset;
        hull.centroid_ = vec3(centroid);
        hull.meanSquare_ =
            mat3(second / volume - glm::outerProduct(offset, offset) + glm::outerProduct(centroid, centroid));
        hull.low_ = hull.high_ = hull.points_.front();
        for (const vec3& point : hull.points_) {
            hull.low_ = glm::min(hull.low_, point);
            hull.high_ = glm::max(hull.high_, point);
            hull.reach_ = std::max(hull.reach_, glm::length(point));
        }
        hull.thickness_ = std::numeric_limits<float>::max();
        for (const ConvexHull::Face& face : hull.faces_)
            hull.thickness_ = std::min(hull.thickness_, face.offset + farthestAlong(hull.points_, -face.normal));
    }

    [[nodiscard]] dvec3 at(int point) const { return dvec3(hull_->points_[static_cast<std::size_t>(point)]); }

    btConvexHullComputer computer_;
    std::shared_ptr<ConvexHull> hull_ = std::make_shared<ConvexHull>();
    std::vector<int> place_;  // of the computer's vertices among the hull's
    std::map<std::pair<int, int>, int> faceOf_;
    dvec3 middle_{0, 0, 0};
};

ConvexHullPtr makeConvexHull(std::span<const vec3> points) {
    return HullMaker::make(points);
}

bool sameHull(const ConvexHullPtr& a, const ConvexHullPtr& b) {
    if (a == b) return true;
    return a != nullptr && b != nullptr &&
           std::equal(a->points().begin(), a->points().end(), b->points().begin(), b->points().end());
}

}  // namespace lutka::physics
