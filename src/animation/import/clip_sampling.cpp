#include "animation/import/clip_sampling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <string_view>

#include "animation/pose.hpp"

namespace lutka::animation::rig_import {
namespace {

constexpr double kLeastRate = 30.0;
constexpr double kMostRate = 120.0;
// Assimp's own default for files that don't say how long a tick is.
constexpr double kDefaultTicksPerSecond = 25.0;
constexpr int kMaxFrames = 36'000;
// Bounds the memory of all clips together: 28 bytes each.
constexpr std::size_t kMaxTransforms = 20'000'000;
constexpr double kVisibleScale = 0.01;

struct KeyTimes {
    double first = std::numeric_limits<double>::max();  // ticks
    double last = std::numeric_limits<double>::lowest();
    double smallestGap = std::numeric_limits<double>::max();

    // A clip's time is the file's, from 0; but one cut from the middle of a long timeline starts at its first key.
    [[nodiscard]] double start() const { return first < 0.0 || first > last - first ? first : 0.0; }
};

template <class Key>
void addTimes(const Key* keys, unsigned count, KeyTimes& times) {
    if (count < 2) return;  // a constant, often put at 0 by the importer: no part of the time line
    for (unsigned i = 0; i < count; ++i) {
        if (!std::isfinite(keys[i].mTime)) continue;
        times.first = std::min(times.first, keys[i].mTime);
        times.last = std::max(times.last, keys[i].mTime);
        const double gap = i > 0 ? keys[i].mTime - keys[i - 1].mTime : 0.0;
        if (gap > 0.0) times.smallestGap = std::min(times.smallestGap, gap);
    }
}

KeyTimes keyTimes(const aiAnimation& animation) {
    KeyTimes times;
    for (unsigned c = 0; c < animation.mNumChannels; ++c) {
        const aiNodeAnim& channel = *animation.mChannels[c];
        addTimes(channel.mPositionKeys, channel.mNumPositionKeys, times);
        addTimes(channel.mRotationKeys, channel.mNumRotationKeys, times);
        addTimes(channel.mScalingKeys, channel.mNumScalingKeys, times);
    }
    // Constants only: one pose.
    if (times.last < times.first && animation.mNumChannels > 0) times.first = times.last = 0.0;
    return times;
}

// A multiple of the keys' rate; the rate itself is snapped to whole numbers that it misses by rounding only.
double rateFor(double keysPerSecond) {
    if (!std::isfinite(keysPerSecond) || keysPerSecond <= 0.0) return kLeastRate;
    const double whole = std::round(keysPerSecond);
    if (whole > 0.0 && std::abs(whole - keysPerSecond) < 5e-4 * whole) keysPerSecond = whole;
    if (keysPerSecond > kMostRate) return 60.0;
    return keysPerSecond * std::max(1.0, std::ceil(kLeastRate / keysPerSecond - 0.01));
}

aiVector3D mix(const aiVector3D& a, const aiVector3D& b, double alpha) {
    return a + (b - a) * static_cast<ai_real>(alpha);
}

aiQuaternion mix(const aiQuaternion& a, const aiQuaternion& b, double alpha) {
    aiQuaternion out;
    aiQuaternion::Interpolate(out, a, b, static_cast<ai_real>(alpha));
    return out.Normalize();
}

// The value at a time: held before the first and after the last key.
template <class Key>
auto valueAt(const Key* keys, unsigned count, double time) -> decltype(Key::mValue) {
    const Key* const end = keys + count;
    const Key* const after = std::upper_bound(keys, end, time, [](double t, const Key& key) { return t < key.mTime; });
    if (after == keys) return keys->mValue;
    if (after == end) return (end - 1)->mValue;
    const Key* const before = after - 1;
    const double span = after->mTime - before->mTime;
    return span > 0.0 ? mix(before->mValue, after->mValue, (time - before->mTime) / span) : before->mValue;
}

// Which node each channel moves; nodes that share a name take the channels of that name in turn, joints of the skin
// first (a mesh node often has the name of the joint that it follows).
std::vector<int> nodesOfChannels(const aiAnimation& animation, const NodeTree& tree, std::span<const bool> matters) {
    std::vector<bool> taken(tree.nodes.size(), false);
    std::vector<int> nodes(animation.mNumChannels, -1);
    for (unsigned c = 0; c < animation.mNumChannels; ++c) {
        int best = -1;
        for (const int node : tree.named(animation.mChannels[c]->mNodeName.C_Str())) {
            const bool better = best < 0 || (matters[tree.nodes[node].joint] && !matters[tree.nodes[best].joint]);
            if (!taken[node] && better) best = node;
        }
        if (best >= 0) taken[best] = true;
        nodes[c] = best;
    }
    return nodes;
}

// Where an FBX node has nothing but a pre-rotation, Assimp 5.2.5 splits the node into a chain of helpers and yet writes
// one channel with the whole transform for the node itself: then the helpers above it must not turn it once more.
void silenceHelpers(const NodeTree& tree, std::span<const int> nodesOfChannels, std::span<dmat4> parentFromNode) {
    for (const int node : nodesOfChannels) {
        if (node < 0 || tree.isHelper(node)) continue;
        const std::string prefix = std::string(tree.nodes[node].source->mName.C_Str()) + kPivotMark;
        for (int above = tree.nodes[node].parent; above >= 0 && tree.isHelper(above);
             above = tree.nodes[above].parent) {
            const bool own = std::string_view(tree.nodes[above].source->mName.C_Str()).starts_with(prefix);
            if (own) parentFromNode[above] = dmat4(1.0);
        }
    }
}

dmat4 channelTransform(const aiNodeAnim& channel, const dmat4& own, double time) {
    aiVector3D position(static_cast<ai_real>(own[3].x), static_cast<ai_real>(own[3].y), static_cast<ai_real>(own[3].z));
    if (channel.mNumPositionKeys > 0) position = valueAt(channel.mPositionKeys, channel.mNumPositionKeys, time);
    glm::dquat rotation = glm::quat_cast(nearestRotation(own));
    if (channel.mNumRotationKeys > 0) {
        const aiQuaternion q = valueAt(channel.mRotationKeys, channel.mNumRotationKeys, time);
        rotation = glm::normalize(glm::dquat(q.w, q.x, q.y, q.z));
    }
    dvec3 scale(glm::length(dvec3(own[0])), glm::length(dvec3(own[1])), glm::length(dvec3(own[2])));
    if (channel.mNumScalingKeys > 0) scale = fromAssimp(valueAt(channel.mScalingKeys, channel.mNumScalingKeys, time));
    const dmat4 out =
        glm::translate(dmat4(1.0), fromAssimp(position)) * glm::mat4_cast(rotation) * glm::scale(dmat4(1.0), scale);
    const double sum = out[0][0] + out[1][1] + out[2][2] + out[3][0] + out[3][1] + out[3][2];
    return std::isfinite(sum) ? out : own;
}

class ClipSampler {
  public:
    ClipSampler(const NodeTree& tree, const RigidPoser& poser, const Skeleton& skeleton, std::span<const bool> matters)
        : tree_(tree), poser_(poser), skeleton_(skeleton), matters_(matters) {}

    Clip sample(const aiAnimation& animation, std::size_t budget, std::vector<std::string>& warnings) const {
        const KeyTimes times = keyTimes(animation);
        const double ticks = animation.mTicksPerSecond > 0.0 ? animation.mTicksPerSecond : kDefaultTicksPerSecond;
        const double seconds = std::max(0.0, (times.last - times.start()) / ticks);
        Clip clip;
        clip.name = animation.mName.C_Str();
        const double rate = rateFor(ticks / times.smallestGap);
        clip.framesPerSecond = static_cast<float>(rate);
        const double wanted = std::floor(seconds * rate + 1.0 + 1e-3);
        const std::size_t affordable = std::min<std::size_t>(budget / tree_.nodeOfJoint.size(), kMaxFrames);
        clip.frameCount = static_cast<int>(std::min(wanted, static_cast<double>(affordable)));
        if (wanted > clip.frameCount) {
            warnings.push_back(fmt::format("clip '{}' is {:.0f} s long; only the first {:.0f} s were kept", clip.name,
                                           seconds, clip.frameCount / rate));
        }
        fill(animation, times.start(), ticks / rate, clip, warnings);
        return clip;
    }

  private:
    void fill(const aiAnimation& animation, double start, double ticksPerFrame, Clip& clip,
              std::vector<std::string>& warnings) const {
        const std::vector<int> nodeOf = nodesOfChannels(animation, tree_, matters_);
        std::vector<dmat4> local;
        for (const NodeTree::Node& node : tree_.nodes)
            local.push_back(node.parentFromNode);
        silenceHelpers(tree_, nodeOf, local);
        std::vector<dmat4> sceneFromNode(local.size());
        std::vector<RigidTransform> model(tree_.nodeOfJoint.size());
        clip.parentFromJoint.resize(model.size() * static_cast<std::size_t>(clip.frameCount));
        double common = 1.0;
        double worst = 0.0;
        for (int frame = 0; frame < clip.frameCount; ++frame) {
            for (unsigned c = 0; c < animation.mNumChannels; ++c) {
                if (nodeOf[c] < 0) continue;
                const dmat4& own = tree_.nodes[nodeOf[c]].parentFromNode;
                local[nodeOf[c]] = channelTransform(*animation.mChannels[c], own, start + frame * ticksPerFrame);
            }
            evaluatePose(tree_, local, sceneFromNode);
            if (frame == 0) common = commonScale(sceneFromNode, clip.name, warnings);
            worst = std::max(worst, poser_.pose(sceneFromNode, common, matters_, model));
            modelToLocal(
                skeleton_, model,
                std::span(clip.parentFromJoint).subspan(model.size() * static_cast<std::size_t>(frame), model.size()));
        }
        if (worst > kVisibleScale) {
            warnings.push_back(fmt::format("clip '{}' scales joints by up to {:.0f} %; the scale was dropped",
                                           clip.name, 100.0 * worst));
        }
    }

    // Some exporters write another unit into the clips than into the skin: then the whole figure is scaled.
    double commonScale(std::span<const dmat4> sceneFromNode, const std::string& name,
                       std::vector<std::string>& warnings) const {
        const double scale = poser_.commonScale(sceneFromNode, matters_);
        if (std::abs(scale - 1.0) <= 0.05) return 1.0;
        warnings.push_back(
            fmt::format("clip '{}' is {:.3g} times the size of the bind pose and was brought to it", name, scale));
        return scale;
    }

    const NodeTree& tree_;
    const RigidPoser& poser_;
    const Skeleton& skeleton_;
    std::span<const bool> matters_;
};

}  // namespace

std::vector<Clip> sampleAnimations(const aiScene& scene, const NodeTree& tree, const RigidPoser& poser,
                                   const Skeleton& skeleton, std::span<const bool> matters,
                                   std::vector<std::string>& warnings) {
    std::vector<Clip> clips;
    std::size_t budget = kMaxTransforms;
    const ClipSampler sampler(tree, poser, skeleton, matters);
    for (unsigned i = 0; i < scene.mNumAnimations; ++i) {
        const aiAnimation& animation = *scene.mAnimations[i];
        if (keyTimes(animation).last < keyTimes(animation).first) continue;
        if (budget < tree.nodeOfJoint.size()) {
            warnings.push_back(fmt::format("clips from '{}' on were left out: too much motion for the memory",
                                           animation.mName.C_Str()));
            break;
        }
        clips.push_back(sampler.sample(animation, budget, warnings));
        budget -= clips.back().parentFromJoint.size();
    }
    return clips;
}

}  // namespace lutka::animation::rig_import
