#include "physics/fit/head_pieces.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <glm/geometric.hpp>
#include <optional>
#include <unordered_map>
#include <utility>

#include "core/aabb.hpp"
#include "core/union_find.hpp"

namespace lutka::physics {
namespace {

using animation::SkinnedMesh;

constexpr float kMargin = 0.35F;      // of the skull's diagonal: hair and hats lie so near to it
constexpr float kLargeEnough = 0.2F;  // of the largest piece's area: eyes and teeth are no skull
constexpr float kAtJoint = 0.25F;     // of a piece's diagonal: so near it begins at the joint
constexpr float kHoldsJoint = 0.08F;  // of a piece's diagonal from its box: it holds the joint, as hair does
constexpr float kMostInside = 0.5F;   // of a piece's vertices: it is a part of the skull
constexpr float kMostGrown = 1.6F;    // of the skull's diagonal: with the parts that lie on it

// Connected skin of the head.
struct Piece {
    Aabb box;
    float area = 0.0F;
    vec3 sum{0};  // of its points
    std::vector<vec3> points;
};

// Vertices of all meshes in one list; those in the same place are one, so that seams of UVs and materials do not part
// the skin.
class HeadSkin {
  public:
    HeadSkin(int head, const animation::Character& character, const mat3& standardFromModel,
             const std::vector<std::vector<int>>& owners) {
        for (std::size_t m = 0; m < owners.size(); ++m) {
            const SkinnedMesh& mesh = character.meshes[m];
            placeOf_.emplace_back(owners[m].size(), -1);
            for (std::size_t v = 0; v < owners[m].size(); ++v) {
                if (owners[m][v] == head) placeOf_[m][v] = placeAt(mesh.positions[v]);
            }
        }
        groups_.reset(places_.size());
        for (std::size_t m = 0; m < owners.size(); ++m)
            join(character.meshes[m], placeOf_[m]);
        gather(character, standardFromModel);
    }

    [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }
    // -1: not the head's.
    [[nodiscard]] int pieceOf(std::size_t mesh, std::size_t vertex) const {
        const int place = placeOf_[mesh][vertex];
        return place < 0 ? -1 : pieceOfPlace_[static_cast<std::size_t>(place)];
    }

  private:
    struct Hash {
        std::size_t operator()(const vec3& p) const {
            const auto bits = [](float number) {
                return std::uint64_t{std::bit_cast<std::uint32_t>(number + 0.0F)};  // -0 is 0
            };
            return (bits(p.x) * 73856093U) ^ (bits(p.y) * 19349663U) ^ (bits(p.z) * 83492791U);
        }
    };

    int placeAt(const vec3& position) {
        const auto [found, isNew] = index_.try_emplace(position, static_cast<int>(places_.size()));
        if (isNew) places_.push_back(position);
        return found->second;
    }

    void join(const SkinnedMesh& mesh, const std::vector<int>& placeOf) {
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const std::uint32_t* const corner = &mesh.indices[i];
            int first = -1;
            for (int k = 0; k < 3; ++k) {
                const int place = placeOf[corner[k]];
                if (place < 0) continue;
                if (first >= 0) groups_.join(place, first);
                first = place;
            }
        }
    }

    void gather(const animation::Character& character, const mat3& standardFromModel) {
        pieceOfPlace_.resize(places_.size());
        for (std::size_t place = 0; place < places_.size(); ++place) {
            const auto group = static_cast<std::size_t>(groups_.find(static_cast<int>(place)));
            // A set is called by its smallest member, which comes first.
            const bool isNew = group == place;
            const int piece = isNew ? static_cast<int>(pieces_.size()) : pieceOfPlace_[group];
            pieceOfPlace_[place] = piece;
            if (isNew) pieces_.emplace_back();
            const vec3 point = standardFromModel * places_[place];
            Piece& of = pieces_[static_cast<std::size_t>(piece)];
            of.box.add(point);
            of.sum += point;
            of.points.push_back(point);
        }
        for (std::size_t m = 0; m < placeOf_.size(); ++m) {
            const SkinnedMesh& mesh = character.meshes[m];
            for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
                count(mesh, m, &mesh.indices[i]);
        }
    }

    void count(const SkinnedMesh& mesh, std::size_t m, const std::uint32_t* corner) {
        int piece = -1;
        int corners = 0;
        for (int k = 0; k < 3; ++k) {
            const int of = pieceOf(m, corner[k]);
            corners += of >= 0 ? 1 : 0;
            piece = std::max(piece, of);
        }
        if (piece < 0) return;
        const vec3& a = mesh.positions[corner[0]];
        const vec3 twice = glm::cross(mesh.positions[corner[1]] - a, mesh.positions[corner[2]] - a);
        Piece& of = pieces_[static_cast<std::size_t>(piece)];
        of.area += 0.5F * glm::length(twice) * static_cast<float>(corners) / 3.0F;
    }

    std::unordered_map<vec3, int, Hash> index_;
    std::vector<vec3> places_;
    std::vector<std::vector<int>> placeOf_;  // one list a mesh: place of each vertex, -1: not the head's
    UnionFind groups_;                       // of places
    std::vector<int> pieceOfPlace_;
    std::vector<Piece> pieces_;
};

vec3 middleOf(const Piece& piece) {
    return piece.sum / static_cast<float>(piece.points.size());
}

// Whether a piece's middle lies beyond the head's joint, as a skull's does.
bool isBeyondJoint(const Piece& piece, const PlannedBody& head) {
    return glm::dot(middleOf(piece) - head.start, head.end - head.start) > 0.0F;
}

// Whether a piece hangs from the skull, as a beard does: its middle lies lower than the head's joint and all of the
// skull's box. The panels of a box around its joint do not.
bool hangsFrom(const Piece& piece, const PlannedBody& head, const Aabb& skull) {
    const vec3 up = head.end - head.start;
    const float lowest = glm::dot(skull.middle(), up) - 0.5F * glm::dot(skull.size(), glm::abs(up));
    return !isBeyondJoint(piece, head) && glm::dot(middleOf(piece), up) < lowest;
}

// The index of the skull itself: the largest of the pieces that begin at the head's joint and lie beyond it. A hat that
// is larger than the head stands off the joint by its brim's height, where the head holds the joint: so a piece that
// does goes before those that don't.
std::optional<std::size_t> skullOf(const std::vector<Piece>& pieces, const PlannedBody& head) {
    float largest = 0.0F;
    for (const Piece& piece : pieces)
        largest = std::max(largest, piece.area);
    std::optional<std::size_t> best;
    bool bestHolds = false;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Piece& piece = pieces[i];
        const float away = piece.box.distanceTo(head.start) / piece.box.diagonal();
        if (!(away <= kAtJoint) || !isBeyondJoint(piece, head) || piece.area < kLargeEnough * largest) continue;
        const bool holds = away <= kHoldsJoint;
        if (best && (holds == bestHolds ? piece.area <= pieces[*best].area : bestHolds)) continue;
        best = i;
        bestHolds = holds;
    }
    return best;
}

// How many of a piece's points lie within the margin of a box.
float shareWithin(const Piece& piece, const Aabb& box, float margin) {
    const auto inside = std::count_if(piece.points.begin(), piece.points.end(),
                                      [&](const vec3& point) { return box.distanceTo(point) <= margin; });
    return static_cast<float>(inside) / static_cast<float>(piece.points.size());
}

// How far from the skull each piece's skin still tells the head's shape. A piece that lies on the skull counts whole,
// hair that begins on it up to a margin, what only touches it or hangs from it (a beard) not at all. `box` becomes that
// of the skull with the pieces that count whole.
std::vector<float> reachesOf(const std::vector<Piece>& pieces, std::size_t skull, const PlannedBody& head, Aabb& box) {
    constexpr float kAll = 1e9F;
    constexpr float kOfHat = 0.3F;
    std::vector<float> reaches(pieces.size(), 0.0F);
    reaches[skull] = kAll;
    box = pieces[skull].box;
    const float margin = kMargin * box.diagonal();
    const float most = kMostGrown * box.diagonal();
    for (bool grown = true; grown;) {
        grown = false;
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            if (reaches[i] == kAll || shareWithin(pieces[i], box, margin) < kMostInside) continue;
            Aabb larger = box;
            larger.add(pieces[i].box);
            const bool isWhole = larger.diagonal() <= most;
            // What is larger than the skull and no part of it is a hat: its brim is not the head.
            const float begins = pieces[i].area > pieces[skull].area ? kOfHat * margin : margin;
            reaches[i] = isWhole ? kAll : hangsFrom(pieces[i], head, box) ? 0.0F : begins;
            if (isWhole) box = larger;
            grown = grown || isWhole;
        }
    }
    return reaches;
}

}  // namespace

void hangPiecesOfHead(const BodyPlan& plan, const animation::Character& character, const mat3& standardFromModel,
                      int aside, std::vector<std::vector<int>>& owners) {
    const int head = plan.bodyOf(Role::head);
    if (head < 0) return;
    const HeadSkin skin(head, character, standardFromModel, owners);
    const std::optional<std::size_t> skull = skullOf(skin.pieces(), plan.bodies[head]);
    if (!skull || skin.pieces().size() < 2) return;
    Aabb box;
    const std::vector<float> reaches = reachesOf(skin.pieces(), *skull, plan.bodies[head], box);
    for (std::size_t m = 0; m < owners.size(); ++m) {
        for (std::size_t v = 0; v < owners[m].size(); ++v) {
            const int piece = skin.pieceOf(m, v);
            if (piece < 0) continue;
            const float distance = box.distanceTo(standardFromModel * character.meshes[m].positions[v]);
            if (distance > reaches[static_cast<std::size_t>(piece)]) owners[m][v] = aside;
        }
    }
}

}  // namespace lutka::physics
