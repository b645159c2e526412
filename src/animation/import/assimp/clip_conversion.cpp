#include "animation/import/assimp/clip_conversion.hpp"

#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "animation/import/assimp/convert.hpp"

namespace lutka::animation::rig_import {
namespace {

// Assimp's own default for files that don't say how long a tick is, and DirectX's.
constexpr double kDefaultTicksPerSecond = 25.0;
constexpr double kDirectXTicksPerSecond = 4800.0;

// The nodes that a skin moves.
std::vector<bool> skinnedNodes(const SourceScene& scene) {
    std::vector<bool> skinned(scene.nodes.size(), false);
    for (const SourceSkin& skin : scene.skins) {
        for (const SourceSkin::Joint& joint : skin.joints)
            skinned[joint.node] = true;
    }
    return skinned;
}

std::vector<int> nodesOfChannels(const aiAnimation& animation, const SceneNodes& nodes,
                                 const std::vector<bool>& skinned) {
    std::vector<bool> taken(nodes.sources.size(), false);
    std::vector<int> found(animation.mNumChannels, -1);
    for (unsigned c = 0; c < animation.mNumChannels; ++c) {
        int best = -1;
        for (const int node : nodes.named(animation.mChannels[c]->mNodeName.C_Str())) {
            const bool better = best < 0 || (skinned[node] && !skinned[best]);
            if (!taken[node] && better) best = node;
        }
        if (best >= 0) taken[best] = true;
        found[c] = best;
    }
    return found;
}

void put(const aiVector3D& v, std::vector<float>& values) {
    values.insert(values.end(), {v.x, v.y, v.z});
}

void put(const aiQuaternion& q, std::vector<float>& values) {
    values.insert(values.end(), {q.x, q.y, q.z, q.w});
}

template <class Key>
void addChannel(const Key* keys, unsigned count, int node, SourceChannel::Path path, double secondsPerTick,
                SourceClip& clip) {
    SourceChannel channel;
    channel.node = node;
    channel.path = path;
    for (unsigned i = 0; i < count; ++i) {
        const double time = keys[i].mTime * secondsPerTick;
        if (!std::isfinite(time) || (!channel.times.empty() && time < channel.times.back())) continue;
        channel.times.push_back(time);
        put(keys[i].mValue, channel.values);
    }
    if (!channel.times.empty()) clip.channels.push_back(std::move(channel));
}

void addStill(int node, SourceChannel::Path path, std::vector<float> value, SourceClip& clip) {
    clip.channels.push_back({node, path, SourceChannel::Interpolation::linear, {0.0}, std::move(value)});
}

// Where an FBX node has nothing but a pre-rotation, Assimp 5.2.5 splits the node into a chain of helpers and yet writes
// one channel with the whole transform for the node itself: then the helpers above it must not turn it once more.
void silenceHelpers(const SourceScene& scene, int node, SourceClip& clip) {
    const std::string prefix = scene.nodes[node].name + kPivotMark;
    for (int above = scene.nodes[node].parent; above >= 0 && scene.nodes[above].isHelper;
         above = scene.nodes[above].parent) {
        if (!std::string_view(scene.nodes[above].name).starts_with(prefix)) continue;
        addStill(above, SourceChannel::Path::translation, {0, 0, 0}, clip);
        addStill(above, SourceChannel::Path::rotation, {0, 0, 0, 1}, clip);
        addStill(above, SourceChannel::Path::scale, {1, 1, 1}, clip);
    }
}

// Calls visit with the times of all keys of each part of each channel.
template <class Visit>
void forEachTrack(const aiAnimation& animation, Visit visit) {
    const auto timesOf = [&](const auto* keys, unsigned count) {
        std::vector<double> times;
        times.reserve(count);
        for (unsigned i = 0; i < count; ++i)
            times.push_back(keys[i].mTime);
        visit(times);
    };
    for (unsigned c = 0; c < animation.mNumChannels; ++c) {
        const aiNodeAnim& channel = *animation.mChannels[c];
        timesOf(channel.mPositionKeys, channel.mNumPositionKeys);
        timesOf(channel.mRotationKeys, channel.mNumRotationKeys);
        timesOf(channel.mScalingKeys, channel.mNumScalingKeys);
    }
}

// A .x file without a rate counts in frames or in DirectX's own ticks. It is ticks if the keys of each track are at
// least 1/120 s of them apart: as frames that would be more than a second. Two keys alone tell nothing.
double unstatedTicksPerSecond(const aiAnimation& animation) {
    constexpr double kLeastGap = kDirectXTicksPerSecond / 120.0;
    constexpr std::size_t kFewestKeys = 3;
    bool told = false;
    bool dense = false;
    forEachTrack(animation, [&](const std::vector<double>& times) {
        if (times.size() < kFewestKeys) return;
        told = true;
        for (std::size_t i = 1; i < times.size(); ++i)
            dense = dense || times[i] - times[i - 1] < kLeastGap;
    });
    return told && !dense ? kDirectXTicksPerSecond : kDefaultTicksPerSecond;
}

SourceClip clipOf(const aiAnimation& animation, const SceneNodes& nodes, const std::vector<bool>& skinned,
                  const SourceScene& scene) {
    SourceClip clip;
    clip.name = animation.mName.C_Str();
    const double tick =
        1.0 / (animation.mTicksPerSecond > 0.0 ? animation.mTicksPerSecond : unstatedTicksPerSecond(animation));
    const std::vector<int> nodeOf = nodesOfChannels(animation, nodes, skinned);
    for (unsigned c = 0; c < animation.mNumChannels; ++c) {
        if (nodeOf[c] < 0) continue;
        const aiNodeAnim& from = *animation.mChannels[c];
        using Path = SourceChannel::Path;
        addChannel(from.mPositionKeys, from.mNumPositionKeys, nodeOf[c], Path::translation, tick, clip);
        addChannel(from.mRotationKeys, from.mNumRotationKeys, nodeOf[c], Path::rotation, tick, clip);
        addChannel(from.mScalingKeys, from.mNumScalingKeys, nodeOf[c], Path::scale, tick, clip);
        if (!scene.nodes[nodeOf[c]].isHelper) silenceHelpers(scene, nodeOf[c], clip);
    }
    return clip;
}

}  // namespace

void addClips(const aiScene& scene, const SceneNodes& nodes, SourceScene& out) {
    const std::vector<bool> skinned = skinnedNodes(out);
    for (unsigned i = 0; i < scene.mNumAnimations; ++i)
        out.clips.push_back(clipOf(*scene.mAnimations[i], nodes, skinned, out));
}

}  // namespace lutka::animation::rig_import
