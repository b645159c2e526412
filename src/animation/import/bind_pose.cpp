#include "animation/import/bind_pose.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <optional>

#include "core/aabb.hpp"

namespace lutka::animation::rig_import {
namespace {

// How far the mesh node's frame may be from the joints' and still be taken for the bind pose's.
constexpr double kSameScale = 1e-3;
constexpr double kAngleTolerance = 0.8;  // 45 degrees
constexpr double kSameTurn = 1e-3;
constexpr double kPlaceTolerance = 0.75;  // mesh sizes
// How near two placings are that say the same, in mesh sizes, and the share of the weight that must.
constexpr double kAlike = 0.01;
constexpr double kMostVotes = 0.9;
constexpr double kOneSize = 0.05;  // ratio, and the share of the weight that must keep it
constexpr double kMostOfOneSize = 0.9;
constexpr double kAtTheirPlace = 0.05;  // in mesh sizes
constexpr double kEven = 0.02;          // of the mean scale: how far the scales along the axes are from it
constexpr double kInScene = 1e-4;       // in mesh sizes: what single precision leaves
// The medoid compares every joint with every other; beyond this many only the heaviest ones are asked.
constexpr std::size_t kMaxVoters = 200;

struct MeshExtent {
    dvec3 centre{0};
    double size = 1.0;
};

MeshExtent extentOf(const SourceMesh& mesh) {
    AabbOf<dvec3> box;
    for (const vec3& position : mesh.positions) {
        if (isFinite(position)) box.add(dvec3(position));
    }
    if (box.empty()) return {};
    return {box.middle(), std::max(box.diagonal(), 1e-12)};
}

struct Vote {
    dmat4 sceneFromMesh;
    double weight;
};

// Where a frame takes four points of a mesh, and how it scales it.
struct MeshPlace {
    std::array<dvec3, 4> points;
    double scale = 1.0;
};

MeshPlace placedBy(const MeshExtent& box, const dmat4& frame) {
    MeshPlace out;
    for (int corner = 0; corner < 4; ++corner) {
        dvec3 point = box.centre;
        if (corner > 0) point[corner - 1] += 0.5 * box.size;
        out.points[static_cast<std::size_t>(corner)] = dvec3(frame * dvec4(point, 1.0));
    }
    out.scale = meanScale(frame);
    return out;
}

// How differently two frames place the mesh, in sizes of the placed mesh.
double disagreement(const MeshExtent& box, const MeshPlace& a, const MeshPlace& b) {
    double sum = 0.0;
    for (std::size_t corner = 0; corner < a.points.size(); ++corner)
        sum += glm::distance(a.points[corner], b.points[corner]);
    return sum / (4.0 * box.size * std::max({a.scale, b.scale, 1e-30}));
}

double disagreement(const MeshExtent& box, const dmat4& a, const dmat4& b) {
    return disagreement(box, placedBy(box, a), placedBy(box, b));
}

// The vote with the smallest weighted distance to all others; each distance counts at most 1, so that strays have no
// say.
const dmat4& medoid(const MeshExtent& box, std::vector<Vote>& votes) {
    if (votes.size() > kMaxVoters) {
        std::stable_sort(votes.begin(), votes.end(), [](const Vote& a, const Vote& b) { return a.weight > b.weight; });
        votes.resize(kMaxVoters);
    }
    std::vector<MeshPlace> placed;
    placed.reserve(votes.size());
    for (const Vote& vote : votes)
        placed.push_back(placedBy(box, vote.sceneFromMesh));
    std::size_t best = 0;
    double bestSum = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < votes.size(); ++i) {
        double sum = 0.0;
        for (std::size_t k = 0; k < votes.size(); ++k)
            sum += votes[k].weight * std::min(disagreement(box, placed[i], placed[k]), 1.0);
        if (sum < bestSum) {
            bestSum = sum;
            best = i;
        }
    }
    return votes[best].sceneFromMesh;
}

// Whether the votes give the mesh no one size: joints whose bind frames are scaled while their nodes are not, as the
// collision volumes of Second Life's figures.
bool differInSize(const std::vector<Vote>& votes, const dmat4& middle) {
    double all = 0.0;
    double alike = 0.0;
    for (const Vote& vote : votes) {
        all += vote.weight;
        if (std::abs(meanScale(vote.sceneFromMesh) / meanScale(middle) - 1.0) < kOneSize) alike += vote.weight;
    }
    return alike < kMostOfOneSize * all;
}

// Whether nearly all votes place the mesh as their medoid does: then the nodes are in the bind pose.
bool agree(const MeshExtent& box, const std::vector<Vote>& votes, const dmat4& middle) {
    double all = 0.0;
    double alike = 0.0;
    for (const Vote& vote : votes) {
        all += vote.weight;
        if (disagreement(box, middle, vote.sceneFromMesh) < kAlike) alike += vote.weight;
    }
    return alike > kMostVotes * all;
}

// What is left of a frame's linear part without its rotation.
dmat3 stretchOf(const dmat4& frame) {
    return glm::transpose(nearestRotation(frame)) * dmat3(frame);
}

bool scalesEvenly(const dmat3& stretch) {
    const double mean = (stretch[0][0] + stretch[1][1] + stretch[2][2]) / 3.0;
    double most = 0.0;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row)
            most = std::max(most, std::abs(stretch[column][row] - (column == row ? mean : 0.0)));
    }
    return most < kEven * std::abs(mean);
}

// Whether nearly all votes stretch the mesh in the same way, however they turn it. (The squares of the linear parts
// hold no rotation.)
bool stretchAlike(const std::vector<Vote>& votes, const dmat4& middle) {
    const auto square = [](const dmat4& frame) { return glm::transpose(dmat3(frame)) * dmat3(frame); };
    const dmat3 wanted = square(middle);
    const double size = meanScale(middle) * meanScale(middle);
    double all = 0.0;
    double alike = 0.0;
    for (const Vote& vote : votes) {
        const dmat3 off = square(vote.sceneFromMesh) - wanted;
        double most = 0.0;
        for (int column = 0; column < 3; ++column)
            most = std::max({most, std::abs(off[column].x), std::abs(off[column].y), std::abs(off[column].z)});
        all += vote.weight;
        if (most < kOneSize * size) alike += vote.weight;
    }
    return alike > kMostVotes * all;
}

// Vertices that are stored in a box of their own (quantised along each axis by itself, or under a bind shape matrix):
// only the joints know how to stretch them back. The mesh node may still say which way the figure turns.
dmat4 stretchedFrame(const MeshExtent& box, const dmat4& meshNode, const dmat4& joints, const dmat3& stretch) {
    dmat4 frame(nearestRotation(meshNode) * stretch);
    frame[3] = dvec4(dvec3((joints - frame) * dvec4(box.centre, 1.0)), 1.0);
    return frame;
}

// The mesh node's frame, brought to the size that the joints give the mesh, when it points and lies about where they
// do; else theirs. (glTF ignores the mesh node's frame, so nothing obliges an exporter to make it fit.)
dmat4 chooseFrame(const MeshExtent& box, const dmat4& meshNode, const dmat4& joints, bool jointsAgree,
                  const std::vector<Vote>& votes) {
    if (!isInvertible(meshNode)) return joints;
    const double turn = angleBetween(nearestRotation(meshNode), nearestRotation(joints));
    if (turn > kAngleTolerance) return joints;
    // Nothing to set upright, then, and where a quantised mesh has its origin says nothing.
    if (jointsAgree && turn < kSameTurn) return joints;
    const dmat3 stretch = stretchOf(joints);
    if (!scalesEvenly(stretch) && stretchAlike(votes, joints) && disagreement(box, meshNode, joints) >= kAlike)
        return jointsAgree ? joints : stretchedFrame(box, meshNode, joints, stretch);
    const double ratio = meanScale(joints) / meanScale(meshNode);
    dmat4 frame = meshNode;
    // About the scene's origin, so that what stands on the floor goes on standing there.
    if (std::abs(ratio - 1.0) > kSameScale) frame = glm::scale(dmat4(1.0), dvec3(ratio)) * meshNode;
    const dvec3 shift((joints - frame) * dvec4(box.centre, 1.0));
    if (glm::length(shift) > kPlaceTolerance * box.size * meanScale(joints)) {
        frame = glm::translate(dmat4(1.0), shift) * frame;
    }
    return frame;
}

class BindSolver {
  public:
    BindSolver(const NodeTree& tree, std::span<const MeshInstance> meshes)
        : tree_(tree),
          meshes_(meshes),
          settled_(meshes.size(), false),
          bind_(tree.nodeOfJoint.size()),
          atNodes_(tree.nodeOfJoint.size(), false) {}

    // The heaviest mesh first; from there through shared joints; then the next heaviest that is left.
    std::vector<dmat4> solve() {
        for (int mesh = heaviestLeft(); mesh >= 0; mesh = heaviestLeft()) {
            settle(mesh, frameOfFirst(meshes_[mesh]));
            for (int next = nextLinked(); next >= 0; next = nextLinked())
                settle(next, frameFromShared(meshes_[next]));
        }
        return carryOthers();
    }

  private:
    static double weightOf(const MeshInstance& mesh) {
        double sum = 0.0;
        for (const SkinJoint& joint : mesh.joints)
            sum += joint.weight;
        return sum;
    }

    int heaviestLeft() const {
        int best = -1;
        double most = 0.0;
        for (std::size_t i = 0; i < meshes_.size(); ++i) {
            const double weight = settled_[i] ? 0.0 : weightOf(meshes_[i]);
            if (weight > most) {
                most = weight;
                best = static_cast<int>(i);
            }
        }
        return best;
    }

    double sharedWeight(const MeshInstance& mesh) const {
        double sum = 0.0;
        for (const SkinJoint& joint : mesh.joints)
            sum += bind_[joint.joint] ? joint.weight : 0.0;
        return sum;
    }

    int nextLinked() const {
        int best = -1;
        double most = 0.0;
        for (std::size_t i = 0; i < meshes_.size(); ++i) {
            const double shared = settled_[i] ? 0.0 : sharedWeight(meshes_[i]);
            if (shared > most) {
                most = shared;
                best = static_cast<int>(i);
            }
        }
        return best;
    }

    // The nearest ancestor whose bind frame is known; -1 without.
    int boundAncestor(int joint) const {
        while (joint >= 0 && !bind_[joint])
            joint = tree_.jointParents[joint];
        return joint;
    }

    dmat4 frameOfFirst(const MeshInstance& mesh) {
        const MeshExtent box = extentOf(*mesh.mesh);
        std::vector<Vote> votes;
        for (const SkinJoint& joint : mesh.joints) {
            const dmat4 frame = tree_.sceneFromJoint(joint.joint) * joint.jointFromMesh;
            if (isInvertible(frame)) votes.push_back({carried(joint.joint, frame), joint.weight});
        }
        const bool stated = mesh.sceneFromMesh && isInvertible(*mesh.sceneFromMesh);
        const dmat4& meshNode = tree_.nodes[mesh.node].sceneFromNode;
        dmat4 unposed = isInvertible(meshNode) ? meshNode : dmat4(1.0);
        if (votes.empty()) return stated ? *mesh.sceneFromMesh : unposed;
        const dmat4 middle = medoid(box, votes);
        const bool alike = agree(box, votes, middle);
        if (stated && !alike) return *mesh.sceneFromMesh;
        if (!tree_.nodesArePosed) return unposed;
        if (differInSize(votes, middle)) {
            if (const std::optional<dmat4> frame = frameByPlaces(mesh, box)) {
                for (const SkinJoint& joint : mesh.joints)
                    atNodes_[joint.joint] = true;
                return *frame;
            }
        }
        // Vertices in scene space stay there: a mesh node with a frame of its own (Blender's exporter hangs the mesh
        // below the armature's object) would turn and move them a second time.
        if (alike && disagreement(box, middle, dmat4(1.0)) < kInScene) return dmat4(1.0);
        return chooseFrame(box, meshNode, middle, alike, votes);
    }

    // The frame that takes the joints' positions in the mesh to those of their nodes. Scales of the joints' own frames
    // do not count.
    std::optional<dmat4> frameByPlaces(const MeshInstance& mesh, const MeshExtent& box) const {
        std::vector<dvec3> inMesh;
        std::vector<dvec3> inScene;
        for (const SkinJoint& joint : mesh.joints) {
            if (!isInvertible(joint.jointFromMesh)) continue;
            inMesh.emplace_back(glm::inverse(joint.jointFromMesh)[3]);
            inScene.emplace_back(tree_.sceneFromJoint(joint.joint)[3]);
        }
        const std::optional<dmat4> frame = affineBetween(inMesh, inScene);
        if (!frame || !isInvertible(*frame)) return std::nullopt;
        double worst = 0.0;
        for (std::size_t i = 0; i < inMesh.size(); ++i)
            worst = std::max(worst, glm::distance(dvec3(*frame * dvec4(inMesh[i], 1.0)), inScene[i]));
        return worst < kAtTheirPlace * box.size * meanScale(*frame) ? frame : std::nullopt;
    }

    // A mesh that shares no joint with a settled one moves along with the settled joint above it.
    dmat4 carried(int joint, const dmat4& frame) const {
        const int ancestor = boundAncestor(joint);
        if (ancestor < 0 || atNodes_[ancestor] || !isInvertible(tree_.sceneFromJoint(ancestor))) return frame;
        return *bind_[ancestor] * glm::inverse(tree_.sceneFromJoint(ancestor)) * frame;
    }

    dmat4 frameFromShared(const MeshInstance& mesh) const {
        std::vector<Vote> votes;
        for (const SkinJoint& joint : mesh.joints) {
            if (bind_[joint.joint]) votes.push_back({*bind_[joint.joint] * joint.jointFromMesh, joint.weight});
        }
        return medoid(extentOf(*mesh.mesh), votes);
    }

    void settle(int index, const dmat4& sceneFromMesh) {
        settled_[index] = true;
        const bool byNodes = meshes_[index].verticesAreInJoints;
        for (const SkinJoint& joint : meshes_[index].joints) {
            if (bind_[joint.joint]) continue;
            bind_[joint.joint] =
                byNodes ? tree_.sceneFromJoint(joint.joint) : sceneFromMesh * glm::inverse(joint.jointFromMesh);
        }
    }

    // bind of `from` times the way from `from` to `to` in the nodes' pose; where that can't be told, the rigid part.
    dmat4 carry(const dmat4& bindOfFrom, int from, int to) const {
        const dmat4& start = tree_.sceneFromJoint(from);
        const dmat4 end = tree_.sceneFromJoint(to);
        const dmat4 moved = isInvertible(start) && !atNodes_[from] ? bindOfFrom * glm::inverse(start) * end : end;
        return isInvertible(moved) ? moved : dmat4(toMatrix(rigidPart(moved)));
    }

    std::vector<dmat4> carryOthers() const {
        const int count = tree_.jointCount();
        std::vector<int> source(count, -1);
        for (int joint = 0; joint < count; ++joint) {
            const int parent = tree_.jointParents[joint];
            source[joint] = bind_[joint] ? joint : (parent >= 0 ? source[parent] : -1);
        }
        // What has no skinned ancestor takes the nearest skinned descendant (children come after their parents).
        std::vector<int> depth(count, 0);
        std::vector<int> below(count, -1);
        for (int joint = count - 1; joint >= 0; --joint) {
            if (bind_[joint]) below[joint] = joint;
            if (bind_[joint]) depth[joint] = 0;
            const int parent = tree_.jointParents[joint];
            if (parent < 0 || below[joint] < 0) continue;
            if (below[parent] < 0 || depth[joint] + 1 <= depth[parent]) {
                below[parent] = below[joint];
                depth[parent] = depth[joint] + 1;
            }
        }
        std::vector<dmat4> out(count);
        for (int joint = 0; joint < count; ++joint) {
            const int parent = tree_.jointParents[joint];
            if (bind_[joint] && isInvertible(*bind_[joint])) {
                out[joint] = *bind_[joint];
            } else if (source[joint] < 0 && below[joint] >= 0) {
                out[joint] = carry(*bind_[below[joint]], below[joint], joint);
            } else if (parent >= 0) {
                out[joint] = carry(out[parent], parent, joint);
            } else {
                const dmat4& own = tree_.sceneFromJoint(joint);
                out[joint] = isInvertible(own) ? own : dmat4(toMatrix(rigidPart(own)));
            }
        }
        return out;
    }

    const NodeTree& tree_;
    std::span<const MeshInstance> meshes_;
    std::vector<bool> settled_;
    std::vector<std::optional<dmat4>> bind_;
    std::vector<bool> atNodes_;  // bound where its node is, in a frame of a size of its own
};

}  // namespace

std::vector<dmat4> solveBindPose(const NodeTree& tree, std::span<const MeshInstance> meshes) {
    return BindSolver(tree, meshes).solve();
}

}  // namespace lutka::animation::rig_import
