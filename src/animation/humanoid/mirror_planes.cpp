#include "animation/humanoid/mirror_planes.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace lutka::animation {
namespace {

constexpr int kMaxClimb = 5;  // levels up to the common ancestor of a pair
constexpr float kLengthTolerance = 0.08F;
constexpr std::size_t kMaxClusters = 48;
constexpr std::size_t kTested = 8;
constexpr std::size_t kKept = 3;
constexpr float kSameDirection = 0.997F;  // cosine, 4.4 degrees
constexpr float kSameOffset = 0.03F;      // of the spread
constexpr float kMirrorTolerance = 0.025F;

struct Vote {
    vec3 normal;
    float offset;
    float weight;
    vec3 middle;  // between the two joints
};

bool namesMirror(const NameEvidence& a, const NameEvidence& b) {
    return a.side != Side::center && b.side != Side::center && a.side != b.side && a.words == b.words;
}

// Levels from two joints up to their common ancestor; kMaxClimb + 1 when it is farther, or they lie at unequal depths.
int climbOf(const RigFeatures& rig, int a, int b) {
    if (rig.depth[a] != rig.depth[b]) return kMaxClimb + 1;
    int climb = 0;
    for (; a != b; ++climb) {
        if (climb >= kMaxClimb) return kMaxClimb + 1;
        a = rig.parents[a];
        b = rig.parents[b];
        if (a == kNoJoint || b == kNoJoint) return kMaxClimb + 1;
    }
    return climb;
}

// Whether two joints hang alike from their common ancestor, `climb` levels up.
bool hangAlike(const RigFeatures& rig, int a, int b, int climb, float spread) {
    if (climb > kMaxClimb) return false;
    int up = a;
    for (int level = 0; level < climb; ++level)
        up = rig.parents[up];
    const float lengthA = glm::distance(rig.positions[a], rig.positions[up]);
    const float lengthB = glm::distance(rig.positions[b], rig.positions[up]);
    const float sizes = static_cast<float>(rig.subtreeSize(a)) / static_cast<float>(rig.subtreeSize(b));
    return std::abs(lengthA - lengthB) <= kLengthTolerance * std::max(lengthA, lengthB) + 0.001F * spread &&
           sizes > 0.5F && sizes < 2.0F;
}

void addVote(const Vote& vote, float spread, std::vector<Vote>& clusters) {
    for (Vote& cluster : clusters) {
        const float cosine = glm::dot(cluster.normal, vote.normal);
        const float offset = cosine < 0.0F ? -vote.offset : vote.offset;
        if (std::abs(cosine) > kSameDirection && std::abs(offset - cluster.offset) < kSameOffset * spread) {
            cluster.weight += vote.weight;
            cluster.middle += vote.weight / cluster.weight * (vote.middle - cluster.middle);
            return;
        }
    }
    if (clusters.size() < kMaxClusters) clusters.push_back(vote);
}

std::vector<Vote> gatherVotes(const RigFeatures& rig, float spread) {
    std::vector<Vote> votes;
    for (int a = 0; a < rig.count(); ++a) {
        for (int b = a + 1; b < rig.count(); ++b) {
            const vec3 across = rig.positions[b] - rig.positions[a];
            const float length = glm::length(across);
            if (length < 0.02F * spread) continue;
            const bool named = namesMirror(rig.names[a], rig.names[b]);
            const int climb = climbOf(rig, a, b);
            if (!named && !hangAlike(rig, a, b, climb, spread)) continue;
            // Near the trunk a posed figure is still symmetric.
            const vec3 normal = across / length;
            const float skin = rig.carriesSkin(a) && rig.carriesSkin(b) ? 1.0F : 0.2F;
            const vec3 middle = 0.5F * (rig.positions[a] + rig.positions[b]);
            votes.push_back({normal, glm::dot(normal, middle),
                             (named ? 2.0F : 1.0F) * skin * length / static_cast<float>(climb), middle});
        }
    }
    std::sort(votes.begin(), votes.end(), [](const Vote& a, const Vote& b) { return a.weight > b.weight; });
    std::vector<Vote> clusters;
    for (const Vote& vote : votes)
        addVote(vote, spread, clusters);
    std::stable_sort(clusters.begin(), clusters.end(),
                     [](const Vote& a, const Vote& b) { return a.weight > b.weight; });
    return clusters;
}

// How well the reflected joints fall on joints; joints in the plane itself prove little.
float agreementOf(const RigFeatures& rig, const Vote& plane, float spread) {
    const float tolerance = kMirrorTolerance * spread;
    float found = 0.0F;
    float possible = 0.0F;
    for (int joint = 0; joint < rig.count(); ++joint) {
        const float weight = rig.carriesSkin(joint) ? 1.0F : 0.15F;
        const float distance = glm::dot(rig.positions[joint], plane.normal) - plane.offset;
        const vec3 image = rig.positions[joint] - 2.0F * distance * plane.normal;
        float nearest = tolerance * 4.0F;
        for (int other = 0; other < rig.count(); ++other)
            nearest = std::min(nearest, glm::distance(image, rig.positions[other]));
        const float error = nearest / tolerance;
        const bool central = std::abs(distance) < 0.5F * tolerance;
        found += weight * (central ? 0.3F : 1.0F) * std::exp(-error * error);
        possible += weight;
    }
    return possible > 0.0F ? found / possible : 0.0F;
}

}  // namespace

std::vector<MirrorPlane> findMirrorPlanes(const RigFeatures& rig) {
    const float spread = spreadOf(rig);
    if (spread <= 0.0F) return {};
    const std::vector<Vote> clusters = gatherVotes(rig, spread);
    std::vector<MirrorPlane> planes;
    for (std::size_t i = 0; i < std::min(clusters.size(), kTested); ++i)
        planes.push_back(
            {clusters[i].normal, clusters[i].offset, clusters[i].middle, agreementOf(rig, clusters[i], spread)});
    std::stable_sort(planes.begin(), planes.end(),
                     [](const MirrorPlane& a, const MirrorPlane& b) { return a.agreement > b.agreement; });
    if (planes.size() > kKept) planes.resize(kKept);
    return planes;
}

}  // namespace lutka::animation
