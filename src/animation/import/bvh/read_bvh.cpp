#include "animation/import/bvh/read_bvh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <span>

#include "animation/import/bare_skeleton.hpp"
#include "animation/import/bvh/bvh_document.hpp"
#include "animation/import/clip_sampling.hpp"
#include "animation/import/source_limits.hpp"
#include "core/files.hpp"

namespace lutka::animation::rig_import {
namespace {

using bvh::BvhDocument;
using glm::dmat4;
using glm::dvec3;

// How far the lowest joint may be from the floor, in heights, and how far it must be for another axis.
constexpr double kOnFloor = 0.15;
constexpr double kOffFloor = 0.35;
constexpr std::size_t kFramesLookedAt = 40;
constexpr std::size_t kFramesToChooseFrom = 300;
// The least stretch() of a zero pose, and of a frame in its place.
constexpr double kStraightEnough = 0.8;
constexpr double kStraight = 0.85;

std::vector<int> parentsOf(const BvhDocument& document) {
    std::vector<int> parents;
    for (const bvh::Joint& joint : document.joints)
        parents.push_back(joint.parent);
    return parents;
}

std::vector<dmat4> zeroPose(const BvhDocument& document) {
    std::vector<dmat4> out;
    for (const bvh::Joint& joint : document.joints)
        out.push_back(glm::translate(dmat4(1.0), joint.offset));
    return out;
}

std::vector<dmat4> poseAt(const BvhDocument& document, std::size_t frame) {
    std::vector<dmat4> out;
    for (std::size_t joint = 0; joint < document.joints.size(); ++joint)
        out.push_back(document.parentFromJoint(joint, frame));
    return out;
}

// How far the lowest joint is from the floor along an axis, in sizes of the figure; over some frames.
double offFloor(const BvhDocument& document, int axis) {
    const std::vector<int> parents = parentsOf(document);
    const std::size_t frames = document.frameCount();
    const std::size_t step = std::max<std::size_t>(1, frames / kFramesLookedAt);
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t frame = 0; frame < frames; frame += step) {
        double low = HUGE_VAL;
        dvec3 least(HUGE_VAL);
        dvec3 most(-HUGE_VAL);
        for (const dmat4& joint : sceneFromNodes(parents, poseAt(document, frame))) {
            low = std::min(low, joint[3][axis]);
            least = glm::min(least, dvec3(joint[3]));
            most = glm::max(most, dvec3(joint[3]));
        }
        const dvec3 size = most - least;
        sum += std::abs(low) / std::max({size.x, size.y, size.z, 1e-12});
        count += 1.0;
    }
    return count > 0.0 ? sum / count : 0.0;
}

// The axis that points up: Z where the motion stands on that floor and not on Y's.
int upAxisOf(const BvhDocument& document) {
    const bool z = document.frameCount() > 0 && offFloor(document, 2) < kOnFloor && offFloor(document, 1) > kOffFloor;
    return z ? 2 : 1;
}

// The nodes' pose.
std::vector<dmat4> restPose(const BvhDocument& document, std::vector<std::string>& warnings) {
    std::vector<dmat4> zero = zeroPose(document);
    const std::vector<int> parents = parentsOf(document);
    const std::size_t frames = document.frameCount();
    if (frames == 0 || parents.size() < 4) return zero;
    const std::vector<dmat4> zeroInScene = sceneFromNodes(parents, zero);
    const bool isFigure = spreadsOut(parents, zeroInScene);
    if (isFigure && stretch(parents, zeroInScene) >= kStraightEnough) return zero;
    const int up = upAxisOf(document);
    const std::size_t step = std::max<std::size_t>(1, frames / kFramesToChooseFrom);
    std::optional<std::size_t> chosen;
    double best = 0.0;
    for (std::size_t frame = 0; frame < frames; frame += step) {
        const std::vector<dmat4> scene = sceneFromNodes(parents, poseAt(document, frame));
        if (!spreadsOut(parents, scene) || (isFigure && stretch(parents, scene) < kStraight)) continue;
        const double score = plainness(parents, scene, up);
        // The earliest of those that are about as good: many captures begin with a pose for the purpose.
        if (chosen && score < kClearlyPlainer * best) continue;
        chosen = frame;
        best = score;
    }
    if (!chosen && isFigure) return zero;  // an animal, or one who sits
    if (!chosen) {
        warnings.emplace_back(
            "the file's zero pose is no figure (its bones all point along one axis), nor is any frame");
        return zero;
    }
    warnings.push_back(
        fmt::format("the file's zero pose is no figure ({}); frame {} of the motion is taken in its place",
                    isFigure ? "it is bent over" : "its bones all point along one axis", *chosen));
    return poseAt(document, *chosen);
}

SourceChannel channelOf(int node, SourceChannel::Path path) {
    SourceChannel channel;
    channel.node = node;
    channel.path = path;
    return channel;
}

// The motion of one joint, as far as it has channels.
void addChannels(const BvhDocument& document, std::size_t joint, SourceClip& clip) {
    const auto& channels = document.joints[joint].channels;
    const bool moves = std::any_of(channels.begin(), channels.end(), [](const auto& c) { return !c.turns; });
    const bool turns = std::any_of(channels.begin(), channels.end(), [](const auto& c) { return c.turns; });
    SourceChannel places = channelOf(static_cast<int>(joint), SourceChannel::Path::translation);
    SourceChannel rotations = channelOf(static_cast<int>(joint), SourceChannel::Path::rotation);
    glm::dquat last(1, 0, 0, 0);
    for (std::size_t frame = 0; frame < document.frameCount(); ++frame) {
        const dmat4 pose = document.parentFromJoint(joint, frame);
        const double time = static_cast<double>(frame) * document.frameSeconds;
        glm::dquat rotation = glm::normalize(glm::quat_cast(glm::dmat3(pose)));
        if (glm::dot(last, rotation) < 0.0) rotation = -rotation;
        last = rotation;
        places.times.push_back(time);
        rotations.times.push_back(time);
        for (int axis = 0; axis < 3; ++axis)
            places.values.push_back(static_cast<float>(pose[3][axis]));
        for (const double part : {rotation.x, rotation.y, rotation.z, rotation.w})
            rotations.values.push_back(static_cast<float>(part));
    }
    if (moves) clip.channels.push_back(std::move(places));
    if (turns) clip.channels.push_back(std::move(rotations));
}

SourceClip clipOf(const BvhDocument& document) {
    SourceClip clip;
    clip.name = "Motion";
    for (std::size_t joint = 0; joint < document.joints.size(); ++joint)
        addChannels(document, joint, clip);
    return clip;
}

void addNodes(const BvhDocument& document, std::span<const dmat4> pose, SourceScene& scene) {
    for (std::size_t i = 0; i < document.joints.size(); ++i) {
        SourceNode node;
        node.name = document.joints[i].name;
        node.parent = document.joints[i].parent;
        node.parentFromNode = pose[i];
        scene.nodes.push_back(std::move(node));
    }
}

}  // namespace

Result<SourceScene> readBvh(const std::filesystem::path& file) {
    const Result<std::vector<unsigned char>> bytes = readFile(file, kMaxFileBytes);
    if (!bytes) return bytes.error();
    const std::string_view text(reinterpret_cast<const char*>(bytes.value().data()), bytes.value().size());
    Result<BvhDocument> parsed = bvh::parseBvh(text, file.string());
    if (!parsed) return parsed.error();
    const BvhDocument& document = parsed.value();
    SourceScene scene;
    scene.format = "BVH";
    scene.warnings = document.warnings;
    addNodes(document, restPose(document, scene.warnings), scene);
    if (document.frameCount() > 0) {
        scene.clips.push_back(clipOf(document));
        if (upAxisOf(document) == 2) {
            scene.convention.up = UpAxis::positiveZ;
            scene.convention.upSource = "the floor of the motion";
        }
    }
    return scene;
}

}  // namespace lutka::animation::rig_import
