#include "animation/import/bvh/read_bvh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <span>

#include "animation/import/bvh/bvh_document.hpp"
#include "animation/import/source_limits.hpp"
#include "core/files.hpp"

namespace lutka::animation::rig_import {
namespace {

using bvh::BvhDocument;
using glm::dmat4;
using glm::dvec3;

// The share of all bones' length that points one way, or along one axis, above which a pose is no figure. A figure that
// stands with its arms down has about 0.7 and 0.85.
constexpr double kMostOneWay = 0.82;
constexpr double kMostOneAxis = 0.93;
// How far the lowest joint may be from the floor, in heights, and how far it must be for another axis.
constexpr double kOnFloor = 0.15;
constexpr double kOffFloor = 0.35;
constexpr std::size_t kFramesLookedAt = 40;
constexpr std::size_t kFramesToChooseFrom = 300;
constexpr double kClearlyBetter = 1.02;

std::vector<dmat4> sceneFromJoints(const BvhDocument& document, std::span<const dmat4> parentFromJoint) {
    std::vector<dmat4> out;
    out.reserve(parentFromJoint.size());
    for (std::size_t i = 0; i < parentFromJoint.size(); ++i) {
        const int parent = document.joints[i].parent;
        out.push_back(parent < 0 ? parentFromJoint[i] : out[static_cast<std::size_t>(parent)] * parentFromJoint[i]);
    }
    return out;
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

// The joints from the first on that has several children: what is above them only leads to the figure.
std::size_t firstFork(const BvhDocument& document) {
    std::vector<int> children(document.joints.size(), 0);
    for (const bvh::Joint& joint : document.joints) {
        if (joint.parent >= 0) ++children[static_cast<std::size_t>(joint.parent)];
    }
    const auto fork = std::find_if(children.begin(), children.end(), [](int count) { return count > 1; });
    return fork == children.end() ? 0 : static_cast<std::size_t>(fork - children.begin());
}

// Whether the bones point into different directions, as those of a figure do in any pose.
bool spreadsOut(const BvhDocument& document, std::span<const dmat4> parentFromJoint) {
    const std::vector<dmat4> scene = sceneFromJoints(document, parentFromJoint);
    dvec3 positive(0);
    dvec3 negative(0);
    double total = 0.0;
    for (std::size_t i = firstFork(document) + 1; i < scene.size(); ++i) {
        const int parent = document.joints[i].parent;
        if (parent < 0) continue;
        const dvec3 bone = dvec3(scene[i][3]) - dvec3(scene[static_cast<std::size_t>(parent)][3]);
        total += glm::length(bone);
        positive += glm::max(bone, dvec3(0));
        negative += glm::max(-bone, dvec3(0));
    }
    if (!(total > 0.0)) return false;
    for (int axis = 0; axis < 3; ++axis) {
        const double oneWay = std::max(positive[axis], negative[axis]);
        if (oneWay > kMostOneWay * total || positive[axis] + negative[axis] > kMostOneAxis * total) return false;
    }
    return true;
}

// How far the lowest joint is from the floor along an axis, in sizes of the figure; over some frames.
double offFloor(const BvhDocument& document, int axis) {
    const std::size_t frames = document.frameCount();
    const std::size_t step = std::max<std::size_t>(1, frames / kFramesLookedAt);
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t frame = 0; frame < frames; frame += step) {
        double low = HUGE_VAL;
        dvec3 least(HUGE_VAL);
        dvec3 most(-HUGE_VAL);
        for (const dmat4& joint : sceneFromJoints(document, poseAt(document, frame))) {
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

// How plainly a pose shows the figure: how high the hips stand over the lowest joint, in lengths of the longest way
// down from them, and how straight the limbs are.
double plainness(const BvhDocument& document, std::span<const dmat4> parentFromJoint, int up) {
    const std::vector<dmat4> scene = sceneFromJoints(document, parentFromJoint);
    const std::size_t fork = firstFork(document);
    const dvec3 hips(scene[fork][3]);
    std::vector<double> way(scene.size(), 0.0);
    std::vector<bool> isTip(scene.size(), true);
    double longest = 1e-12;
    double low = hips[up];
    for (std::size_t i = fork + 1; i < scene.size(); ++i) {
        if (document.joints[i].parent < static_cast<int>(fork)) break;  // another hierarchy
        const auto parent = static_cast<std::size_t>(document.joints[i].parent);
        way[i] = way[parent] + glm::distance(dvec3(scene[i][3]), dvec3(scene[parent][3]));
        isTip[parent] = false;
        longest = std::max(longest, way[i]);
        low = std::min(low, scene[i][3][up]);
    }
    double straight = 0.0;
    double tips = 0.0;
    for (std::size_t i = fork + 1; i < scene.size(); ++i) {
        if (!isTip[i] || !(way[i] > 0.0)) continue;
        straight += glm::distance(dvec3(scene[i][3]), hips) / way[i];
        tips += 1.0;
    }
    return (hips[up] - low) / longest + straight / std::max(tips, 1.0);
}

// The nodes' pose.
std::vector<dmat4> restPose(const BvhDocument& document, std::vector<std::string>& warnings) {
    std::vector<dmat4> zero = zeroPose(document);
    const std::size_t frames = document.frameCount();
    if (frames == 0 || document.joints.size() < 4 || spreadsOut(document, zero)) return zero;
    const int up = upAxisOf(document);
    const std::size_t step = std::max<std::size_t>(1, frames / kFramesToChooseFrom);
    std::optional<std::size_t> chosen;
    double best = 0.0;
    for (std::size_t frame = 0; frame < frames; frame += step) {
        const std::vector<dmat4> pose = poseAt(document, frame);
        if (!spreadsOut(document, pose)) continue;
        const double score = plainness(document, pose, up);
        // The earliest of those that are about as good: many captures begin with a pose for the purpose.
        if (chosen && score < kClearlyBetter * best) continue;
        chosen = frame;
        best = score;
    }
    if (!chosen) {
        warnings.emplace_back(
            "the file's zero pose is no figure (its bones all point along one axis), nor is any frame");
        return zero;
    }
    warnings.push_back(
        fmt::format("the file's zero pose is no figure (its bones all point along one axis); frame {} of "
                    "the motion is taken in its place",
                    *chosen));
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
