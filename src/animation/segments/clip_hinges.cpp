#include "animation/segments/clip_hinges.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "animation/pose.hpp"

namespace lutka::animation {
namespace {

constexpr int kMostFrames = 600;  // over all clips: a plane shows in a few
constexpr float kLeastBend = radians(20.0F);
constexpr float kMostAside = radians(8.0F);
constexpr float kMostAsideShare = 0.2F;
constexpr float kMostAlong = 0.6F;  // cosine of the axis to the segment: a joint that twists is no hinge

// How far each segment has turned against its parent's joint in every frame: rotation vectors in the bind pose's axes.
std::vector<std::vector<vec3>> turnsOf(const Character& character, const std::vector<Segment>& segments) {
    const Skeleton& skeleton = character.skeleton;
    std::vector<std::vector<vec3>> turns(segments.size());
    std::vector<RigidTransform> local(skeleton.parents.size());
    std::vector<RigidTransform> pose(skeleton.parents.size());
    const auto fromBind = [&](int joint) {
        return pose[joint].rotation * glm::conjugate(skeleton.bindModelFromJoint[joint].rotation);
    };
    int frames = 0;
    for (const Clip& clip : character.clips)
        frames += clip.frameCount;
    const int stride = frames / kMostFrames + 1;
    int counted = 0;
    for (const Clip& clip : character.clips) {
        for (int frame = 0; frame < clip.frameCount; ++frame, ++counted) {
            if (counted % stride != 0) continue;
            const std::size_t first = static_cast<std::size_t>(frame) * pose.size();
            std::copy_n(clip.parentFromJoint.begin() + static_cast<std::ptrdiff_t>(first), pose.size(), local.begin());
            localToModel(skeleton, local, pose);
            for (std::size_t i = 0; i < segments.size(); ++i) {
                if (segments[i].parent < 0) continue;
                const quat above = fromBind(segments[segments[i].parent].joint);
                turns[i].push_back(rotationVector(glm::conjugate(above) * fromBind(segments[i].joint)));
            }
        }
    }
    return turns;
}

std::optional<SegmentHinge> hingeOf(const std::vector<vec3>& turns, const vec3& along) {
    if (turns.empty()) return std::nullopt;
    mat3 moment(0.0F);
    for (const vec3& turn : turns)
        moment += glm::outerProduct(turn, turn);
    const mat3 axes = diagonalise(moment);
    int main = 0;
    for (int i = 1; i < 3; ++i)
        if (moment[i][i] > moment[main][main]) main = i;
    const auto number = static_cast<float>(turns.size());
    const float bend = std::sqrt(std::max(moment[main][main], 0.0F) / number);
    const float aside =
        std::sqrt(std::max(moment[0][0] + moment[1][1] + moment[2][2] - moment[main][main], 0.0F) / number);
    SegmentHinge hinge;
    hinge.axis = glm::normalize(axes[main]);
    for (const vec3& turn : turns) {
        hinge.low = std::min(hinge.low, glm::dot(turn, hinge.axis));
        hinge.high = std::max(hinge.high, glm::dot(turn, hinge.axis));
    }
    const bool flat = aside <= kMostAside && aside <= kMostAsideShare * bend;
    const bool across = std::abs(glm::dot(hinge.axis, along)) <= kMostAlong;
    if (!flat || !across || hinge.high - hinge.low < kLeastBend) return std::nullopt;
    return hinge;
}

// The mirror image of an axis of rotation, in model space.
vec3 axisAcross(const vec3& axis, const quat& standardFromModel) {
    const vec3 standard = standardFromModel * axis;
    return glm::conjugate(standardFromModel) * vec3(standard.x, -standard.y, -standard.z);
}

void makeSidesAlike(Segment& left, Segment& right, const quat& standardFromModel) {
    SegmentHinge& own = *left.hinge;
    const vec3 across = axisAcross(own.axis, standardFromModel);
    const SegmentHinge& other = *right.hinge;
    const bool same = glm::dot(across, other.axis) >= 0.0F;
    own.low = std::min(own.low, same ? other.low : -other.high);
    own.high = std::max(own.high, same ? other.high : -other.low);
    right.hinge = SegmentHinge{across, own.low, own.high};
}

}  // namespace

void findClipHinges(const Character& character, const quat& standardFromModel, std::vector<Segment>& segments) {
    if (character.clips.empty()) return;
    const auto& bind = character.skeleton.bindModelFromJoint;
    const std::vector<std::vector<vec3>> turns = turnsOf(character, segments);
    for (std::size_t i = 0; i < segments.size(); ++i) {
        Segment& segment = segments[i];
        if (segment.kind != Segment::Kind::limb) continue;
        vec3 along(0);
        if (segment.end != kNoJoint) along = bind[segment.end].translation - bind[segment.joint].translation;
        segment.hinge = hingeOf(turns[i], glm::length(along) > 1e-6F ? glm::normalize(along) : vec3(0));
    }
    for (Segment& segment : segments) {
        if (segment.side != Side::left || segment.mirror < 0) continue;
        Segment& other = segments[segment.mirror];
        if (segment.hinge && other.hinge) {
            makeSidesAlike(segment, other, standardFromModel);
        } else {
            segment.hinge.reset();
            other.hinge.reset();
        }
    }
}

}  // namespace lutka::animation
