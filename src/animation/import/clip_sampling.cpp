#include "animation/import/clip_sampling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <string_view>
#include <utility>

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
    dmat3 rotation;
    if (channel.mNumRotationKeys > 0) {
        const aiQuaternion q = valueAt(channel.mRotationKeys, channel.mNumRotationKeys, time);
        rotation = glm::mat3_cast(glm::normalize(glm::dquat(q.w, q.x, q.y, q.z)));
    } else {
        rotation = nearestRotation(own);
    }
    const dvec3 scale = channel.mNumScalingKeys > 0
                            ? fromAssimp(valueAt(channel.mScalingKeys, channel.mNumScalingKeys, time))
                            : dvec3(glm::length(dvec3(own[0])), glm::length(dvec3(own[1])), glm::length(dvec3(own[2])));
    const dmat4 out(dvec4(rotation[0] * scale.x, 0.0), dvec4(rotation[1] * scale.y, 0.0),
                    dvec4(rotation[2] * scale.z, 0.0), dvec4(fromAssimp(position), 1.0));
    const double sum = out[0][0] + out[1][1] + out[2][2] + out[3][0] + out[3][1] + out[3][2];
    return std::isfinite(sum) ? out : own;
}

// When and how often a clip is sampled.
struct Timing {
    double start = 0.0;  // ticks
    double ticksPerFrame = 1.0;
    double commonScale = 1.0;
    int frames = 0;
};

// The frames to look at for scale that has to be dropped: a share of all, and those where a scale is at its farthest
// from where it starts.
std::vector<int> tellingFrames(const aiAnimation& animation, const Timing& timing) {
    constexpr int kShare = 24;
    std::vector<int> frames;
    frames.reserve(kShare);
    for (int i = 0; i < kShare; ++i)
        frames.push_back(i * (timing.frames - 1) / (kShare - 1));
    for (unsigned c = 0; c < animation.mNumChannels; ++c) {
        const aiNodeAnim& channel = *animation.mChannels[c];
        double farthest = 0.1 * kVisibleScale;
        double when = timing.start;
        for (unsigned i = 1; i < channel.mNumScalingKeys; ++i) {
            const dvec3 first = fromAssimp(channel.mScalingKeys[0].mValue);
            const double far = glm::length(fromAssimp(channel.mScalingKeys[i].mValue) - first);
            if (far <= farthest * glm::length(first)) continue;
            farthest = far / std::max(glm::length(first), 1e-12);
            when = channel.mScalingKeys[i].mTime;
        }
        const double frame = std::round((when - timing.start) / timing.ticksPerFrame);
        frames.push_back(static_cast<int>(std::clamp(frame, 0.0, static_cast<double>(timing.frames - 1))));
    }
    std::sort(frames.begin(), frames.end());
    frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
    return frames;
}

// The poses of one animation, frame by frame.
class ClipSampler {
  public:
    ClipSampler(const ClipFile& file, const aiAnimation& animation)
        : file_(file), animation_(animation), nodeOf_(nodesOfChannels(animation, file.tree, file.matters())) {
        for (const NodeTree::Node& node : file.tree.nodes)
            local_.push_back(node.parentFromNode);
        silenceHelpers(file.tree, nodeOf_, local_);
        sceneFromNode_.resize(local_.size());
    }

    // Scene-space frames of all nodes at a time in ticks.
    std::span<const dmat4> at(double time) {
        for (unsigned c = 0; c < animation_.mNumChannels; ++c) {
            if (nodeOf_[c] < 0) continue;
            const dmat4& own = file_.tree.nodes[nodeOf_[c]].parentFromNode;
            local_[nodeOf_[c]] = channelTransform(*animation_.mChannels[c], own, time);
        }
        evaluatePose(file_.tree, local_, sceneFromNode_);
        return sceneFromNode_;
    }

    // The largest scale that these frames drop.
    double droppedScale(std::span<const int> frames, const Timing& timing) {
        std::vector<RigidTransform> model(file_.tree.nodeOfJoint.size());
        double worst = 0.0;
        for (const int frame : frames) {
            const auto sceneFromNode = at(timing.start + frame * timing.ticksPerFrame);
            worst = std::max(worst, file_.poser.pose(sceneFromNode, timing.commonScale, file_.matters(), model));
        }
        return worst;
    }

    // Parent-relative frames, `timing.frames` times all joints.
    std::vector<RigidTransform> sample(const Timing& timing) {
        const std::size_t joints = file_.tree.nodeOfJoint.size();
        std::vector<RigidTransform> frames(joints * static_cast<std::size_t>(timing.frames));
        std::vector<RigidTransform> model(joints);
        for (int frame = 0; frame < timing.frames; ++frame) {
            const auto sceneFromNode = at(timing.start + frame * timing.ticksPerFrame);
            file_.poser.pose(sceneFromNode, timing.commonScale, file_.matters(), model);
            modelToLocal(file_.skeleton, model,
                         std::span(frames).subspan(joints * static_cast<std::size_t>(frame), joints));
        }
        return frames;
    }

  private:
    const ClipFile& file_;
    const aiAnimation& animation_;
    std::vector<int> nodeOf_;
    std::vector<dmat4> local_;
    std::vector<dmat4> sceneFromNode_;
};

// Rate and length of a clip, without its poses.
Clip outlineOf(const aiAnimation& animation, std::size_t joints, std::size_t budget, Timing& timing,
               std::vector<std::string>& warnings) {
    const KeyTimes times = keyTimes(animation);
    const double ticks = animation.mTicksPerSecond > 0.0 ? animation.mTicksPerSecond : kDefaultTicksPerSecond;
    const double seconds = std::max(0.0, (times.last - times.start()) / ticks);
    Clip clip;
    clip.name = animation.mName.C_Str();
    const double rate = rateFor(ticks / times.smallestGap);
    clip.framesPerSecond = static_cast<float>(rate);
    const double wanted = std::floor(seconds * rate + 1.0 + 1e-3);
    const std::size_t affordable = std::min<std::size_t>(budget / joints, kMaxFrames);
    clip.frameCount = static_cast<int>(std::min(wanted, static_cast<double>(affordable)));
    if (wanted > clip.frameCount) {
        warnings.push_back(fmt::format("clip '{}' is {:.0f} s long; only the first {:.0f} s were kept", clip.name,
                                       seconds, clip.frameCount / rate));
    }
    timing = {times.start(), ticks / rate, 1.0, clip.frameCount};
    return clip;
}

// Some exporters write another unit into the clips than into the skin: then the whole figure is scaled.
double commonScale(const ClipFile& file, std::span<const dmat4> sceneFromNode, const std::string& name,
                   std::vector<std::string>& warnings) {
    const double scale = file.poser.commonScale(sceneFromNode, file.matters());
    if (std::abs(scale - 1.0) <= 0.05) return 1.0;
    warnings.push_back(
        fmt::format("clip '{}' is {:.3g} times the size of the bind pose and was brought to it", name, scale));
    return scale;
}

// Only what there is to warn of is looked at now; the poses wait until somebody plays the clip.
Clip makeClip(const std::shared_ptr<const ClipFile>& file, const aiAnimation& animation, std::size_t budget,
              std::vector<std::string>& warnings) {
    Timing timing;
    const std::size_t joints = file->tree.nodeOfJoint.size();
    Clip clip = outlineOf(animation, joints, budget, timing, warnings);
    ClipSampler sampler(*file, animation);
    timing.commonScale = commonScale(*file, sampler.at(timing.start), clip.name, warnings);
    const double worst = sampler.droppedScale(tellingFrames(animation, timing), timing);
    if (worst > kVisibleScale) {
        warnings.push_back(
            fmt::format("clip '{}' scales joints by up to {:.0f} %; the scale was dropped", clip.name, 100.0 * worst));
    }
    const std::size_t size = joints * static_cast<std::size_t>(timing.frames);
    clip.parentFromJoint =
        ClipFrames(size, [file, &animation, timing] { return ClipSampler(*file, animation).sample(timing); });
    return clip;
}

}  // namespace

ClipFile::ClipFile(const NodeTree& nodes, std::span<const dmat4> bindSceneFromJoint, const dmat4& modelFromScene,
                   const Skeleton& of)
    : tree(nodes), poser(tree, bindSceneFromJoint, modelFromScene), matters_(new bool[of.parents.size()]) {
    skeleton.parents = of.parents;
    for (std::size_t joint = 0; joint < of.parents.size(); ++joint)
        matters_[joint] = of.skinWeight[joint] > 0.0F;
}

void ClipFile::keep(std::unique_ptr<Assimp::Importer> importer) {
    scene_.reset(importer->GetOrphanedScene());
    // Only animations and nodes are read from now on.
    for (unsigned i = 0; i < scene_->mNumMeshes; ++i)
        delete std::exchange(scene_->mMeshes[i], nullptr);
    for (unsigned i = 0; i < scene_->mNumTextures; ++i)
        delete std::exchange(scene_->mTextures[i], nullptr);
    scene_->mNumMeshes = 0;
    scene_->mNumTextures = 0;
}

std::vector<Clip> sampleAnimations(const aiScene& scene, const std::shared_ptr<const ClipFile>& file,
                                   std::vector<std::string>& warnings) {
    std::vector<Clip> clips;
    std::size_t budget = kMaxTransforms;
    for (unsigned i = 0; i < scene.mNumAnimations; ++i) {
        const aiAnimation& animation = *scene.mAnimations[i];
        if (keyTimes(animation).last < keyTimes(animation).first) continue;
        if (budget < file->tree.nodeOfJoint.size()) {
            warnings.push_back(fmt::format("clips from '{}' on were left out: too much motion for the memory",
                                           animation.mName.C_Str()));
            break;
        }
        clips.push_back(makeClip(file, animation, budget, warnings));
        budget -= clips.back().parentFromJoint.size();
    }
    return clips;
}

}  // namespace lutka::animation::rig_import
