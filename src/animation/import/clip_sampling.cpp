#include "animation/import/clip_sampling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <string_view>
#include <utility>

#include "animation/import/channel_values.hpp"
#include "animation/import/name_list.hpp"
#include "animation/pose.hpp"

namespace lutka::animation::rig_import {
namespace {

constexpr double kLeastRate = 30.0;
constexpr double kLeastSplineRate = 60.0;
constexpr double kMostRate = 120.0;
constexpr int kMaxFrames = 36'000;
// Bounds the memory of all clips together: 28 bytes each.
constexpr std::size_t kMaxTransforms = 20'000'000;
constexpr double kVisibleScaleOfClip = 0.01;

struct KeyTimes {
    double first = std::numeric_limits<double>::max();  // seconds
    double last = std::numeric_limits<double>::lowest();
    double smallestGap = std::numeric_limits<double>::max();
    bool spline = false;

    // A clip's time is the file's, from 0; but one cut from the middle of a long timeline starts at its first key.
    [[nodiscard]] double start() const { return first < 0.0 || first > last - first ? first : 0.0; }
};

KeyTimes keyTimes(const SourceClip& clip) {
    KeyTimes times;
    for (const SourceChannel& channel : clip.channels) {
        times.spline = times.spline || channel.interpolation == SourceChannel::Interpolation::cubicSpline;
        if (channel.times.size() < 2) continue;  // a constant, often put at 0: no part of the time line
        for (std::size_t i = 0; i < channel.times.size(); ++i) {
            times.first = std::min(times.first, channel.times[i]);
            times.last = std::max(times.last, channel.times[i]);
            const double gap = i > 0 ? channel.times[i] - channel.times[i - 1] : 0.0;
            if (gap > 0.0) times.smallestGap = std::min(times.smallestGap, gap);
        }
    }
    // Constants only: one pose.
    if (times.last < times.first && !clip.channels.empty()) times.first = times.last = 0.0;
    return times;
}

// A multiple of the keys' rate; the rate itself is snapped to whole numbers that it misses by rounding only.
double rateFor(double keysPerSecond, double least) {
    if (!std::isfinite(keysPerSecond) || keysPerSecond <= 0.0) return least;
    const double whole = std::round(keysPerSecond);
    if (whole > 0.0 && std::abs(whole - keysPerSecond) < 5e-4 * whole) keysPerSecond = whole;
    if (keysPerSecond > kMostRate) return 60.0;
    return keysPerSecond * std::max(1.0, std::ceil(least / keysPerSecond - 0.01));
}

// Whether frames at that rate fall on all keys, but for rounding.
bool hitsAllKeys(const SourceClip& clip, double start, double rate) {
    constexpr double kMostMissed = 2e-5;  // seconds
    const auto isHit = [&](double time) {
        const double frames = (time - start) * rate;
        return std::abs(frames - std::round(frames)) <= kMostMissed * rate;
    };
    return std::all_of(clip.channels.begin(), clip.channels.end(), [&](const SourceChannel& channel) {
        return channel.times.size() < 2 || std::all_of(channel.times.begin(), channel.times.end(), isHit);
    });
}

// That of the nearest keys where it has all of them, else a usual one that does; else one that ends on the last key.
double frameRateOf(const SourceClip& clip, const KeyTimes& times) {
    const double least = times.spline ? kLeastSplineRate : kLeastRate;
    const double seconds = times.last - times.start();
    if (!(seconds > 0.0)) return least;
    const double rate = rateFor(1.0 / times.smallestGap, least);
    if (hitsAllKeys(clip, times.start(), rate)) return rate;
    for (const double usual : {30.0, 48.0, 50.0, 60.0, 120.0}) {
        if (usual >= least && hitsAllKeys(clip, times.start(), usual)) return usual;
    }
    const double exact = std::max(1.0, std::round(seconds * rate)) / seconds;
    return exact <= kMostRate ? exact : rate;
}

SourceTrs partsOf(const dmat4& matrix) {
    SourceTrs parts;
    parts.translation = dvec3(matrix[3]);
    parts.rotation = glm::normalize(glm::quat_cast(nearestRotation(matrix)));
    parts.scale = {glm::length(dvec3(matrix[0])), glm::length(dvec3(matrix[1])), glm::length(dvec3(matrix[2]))};
    return parts;
}

std::vector<SourceTrs> partsOf(const SourceScene& scene) {
    std::vector<SourceTrs> parts;
    parts.reserve(scene.nodes.size());
    for (const SourceNode& node : scene.nodes)
        parts.push_back(node.trs ? *node.trs : partsOf(node.parentFromNode));
    return parts;
}

dmat4 matrixOf(const SourceTrs& parts) {
    const dmat3 rotation = glm::mat3_cast(glm::normalize(parts.rotation));
    return {dvec4(rotation[0] * parts.scale.x, 0.0), dvec4(rotation[1] * parts.scale.y, 0.0),
            dvec4(rotation[2] * parts.scale.z, 0.0), dvec4(parts.translation, 1.0)};
}

// Replaces the part that the channel moves; what is not finite or no rotation leaves it.
void apply(const SourceChannel& channel, double time, SourceTrs& parts) {
    const dvec4 value = valueAt(channel, time);
    if (!std::isfinite(value.x + value.y + value.z + value.w)) return;
    switch (channel.path) {
        case SourceChannel::Path::translation:
            parts.translation = dvec3(value);
            break;
        case SourceChannel::Path::rotation:
            if (glm::length(value) > 1e-9) parts.rotation = glm::dquat(value.w, value.x, value.y, value.z);
            break;
        case SourceChannel::Path::scale:
            parts.scale = dvec3(value);
            break;
    }
}

// When and how often a clip is sampled.
struct Timing {
    double start = 0.0;  // seconds
    double secondsPerFrame = 1.0;
    double commonScale = 1.0;
    int frames = 0;
};

// Whether a frame turns and scales alone, and that by one number.
bool scalesEvenly(const dmat4& frame) {
    constexpr double kRounding = 1e-4;
    const dmat3 square = glm::transpose(dmat3(frame)) * dmat3(frame);
    const dmat3 off = square - dmat3(square[0][0]);
    const dvec3 most = glm::max(glm::abs(off[0]), glm::max(glm::abs(off[1]), glm::abs(off[2])));
    return std::max({most.x, most.y, most.z}) <= kRounding * square[0][0];
}

// Whether all nodes scale evenly, and by as much all the time: then turning them neither stretches nor shears a skin,
// and one frame tells the scale of all.
bool scalesSteadily(const ClipFile& file, const SourceClip& clip) {
    constexpr double kRounding = 1e-4;
    for (const NodeTree::Node& node : file.tree.nodes) {
        if (!scalesEvenly(node.parentFromNode)) return false;
    }
    for (const SourceChannel& channel : clip.channels) {
        if (channel.path != SourceChannel::Path::scale) continue;
        if (channel.interpolation == SourceChannel::Interpolation::cubicSpline) return false;
        const dvec3 own = file.own[static_cast<std::size_t>(channel.node)].scale;
        for (std::size_t key = 0; key < channel.times.size(); ++key) {
            const dvec3 off = glm::abs(dvec3(keyAt(channel, key)) - own);
            if (!(std::max({off.x, off.y, off.z}) <= kRounding * std::abs(own.x))) return false;
        }
    }
    return true;
}

// The frames to look at for scale that has to be dropped: a share of all, and those where a scale is at its farthest
// from where it starts.
std::vector<int> tellingFrames(const SourceClip& clip, const Timing& timing) {
    constexpr int kShare = 24;
    std::vector<int> frames;
    frames.reserve(kShare);
    for (int i = 0; i < kShare; ++i)
        frames.push_back(i * (timing.frames - 1) / (kShare - 1));
    for (const SourceChannel& channel : clip.channels) {
        if (channel.path != SourceChannel::Path::scale) continue;
        const dvec4 first = keyAt(channel, 0);
        double farthest = 0.1 * kVisibleScaleOfClip;
        double when = timing.start;
        for (std::size_t i = 1; i < channel.times.size(); ++i) {
            const double far = glm::length(keyAt(channel, i) - first);
            if (far <= farthest * glm::length(first)) continue;
            farthest = far / std::max(glm::length(first), 1e-12);
            when = channel.times[i];
        }
        const double frame = std::round((when - timing.start) / timing.secondsPerFrame);
        frames.push_back(static_cast<int>(std::clamp(frame, 0.0, static_cast<double>(timing.frames - 1))));
    }
    std::sort(frames.begin(), frames.end());
    frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
    return frames;
}

// The poses of one animation, frame by frame.
class ClipSampler {
  public:
    ClipSampler(const ClipFile& file, const SourceClip& clip) : file_(file), clip_(clip), parts_(file.own) {
        for (const NodeTree::Node& node : file.tree.nodes)
            local_.push_back(node.parentFromNode);
        sceneFromNode_.resize(local_.size());
    }

    // Scene-space frames of all nodes at a time in seconds.
    std::span<const dmat4> at(double time) {
        for (const SourceChannel& channel : clip_.channels)
            apply(channel, time, parts_[channel.node]);
        for (const SourceChannel& channel : clip_.channels)
            local_[channel.node] = matrixOf(parts_[channel.node]);
        evaluatePose(file_.tree, local_, sceneFromNode_);
        return sceneFromNode_;
    }

    // The largest scale that these frames drop.
    double droppedScale(std::span<const int> frames, const Timing& timing) {
        std::vector<RigidTransform> model(file_.tree.nodeOfJoint.size());
        double worst = 0.0;
        for (const int frame : frames) {
            const auto sceneFromNode = at(timing.start + frame * timing.secondsPerFrame);
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
            const auto sceneFromNode = at(timing.start + frame * timing.secondsPerFrame);
            file_.poser.pose(sceneFromNode, timing.commonScale, file_.matters(), model);
            modelToLocal(file_.skeleton, model,
                         std::span(frames).subspan(joints * static_cast<std::size_t>(frame), joints));
        }
        return frames;
    }

  private:
    const ClipFile& file_;
    const SourceClip& clip_;
    std::vector<SourceTrs> parts_;
    std::vector<dmat4> local_;
    std::vector<dmat4> sceneFromNode_;
};

// Rate and length of a clip, without its poses.
Clip outlineOf(const SourceClip& source, std::size_t joints, std::size_t budget, Timing& timing,
               std::vector<std::string>& warnings) {
    const KeyTimes times = keyTimes(source);
    const double seconds = std::max(0.0, times.last - times.start());
    Clip clip;
    clip.name = source.name;
    const double rate = frameRateOf(source, times);
    clip.framesPerSecond = static_cast<float>(rate);
    const double wanted = std::floor(seconds * rate + 1.0 + 1e-3);
    const std::size_t affordable = std::min<std::size_t>(budget / joints, kMaxFrames);
    clip.frameCount = static_cast<int>(std::min(wanted, static_cast<double>(affordable)));
    if (wanted > clip.frameCount) {
        warnings.push_back(fmt::format("clip '{}' is {:.0f} s long; only the first {:.0f} s were kept", clip.name,
                                       seconds, clip.frameCount / rate));
    }
    timing = {times.start(), 1.0 / rate, 1.0, clip.frameCount};
    return clip;
}

// What was dropped of the clips' scales: a sentence a kind, for a file may have thirty clips.
struct ClipScales {
    std::vector<std::string> resized;
    double least = std::numeric_limits<double>::max();  // times the bind pose's size
    double most = 0.0;
    std::vector<std::string> scaled;
    double worst = 0.0;  // share of the length

    [[nodiscard]] std::vector<std::string> sentences() const {
        std::vector<std::string> out;
        if (resized.size() == 1) {
            out.push_back(fmt::format("clip {} is {:.3g} times the size of the bind pose and was brought to it",
                                      resized[0], most));
        } else if (!resized.empty()) {
            out.push_back(
                fmt::format("{} clips are {:.3g} to {:.3g} times the size of the bind pose and were brought to it: {}",
                            resized.size(), least, most, firstOf(resized)));
        }
        if (scaled.size() == 1) {
            out.push_back(fmt::format("clip {} scales joints by up to {:.0f} %; the scale was dropped", scaled[0],
                                      100.0 * worst));
        } else if (!scaled.empty()) {
            out.push_back(fmt::format("{} clips scale joints by up to {:.0f} %; the scale was dropped: {}",
                                      scaled.size(), 100.0 * worst, firstOf(scaled)));
        }
        return out;
    }
};

// Some exporters write another unit into the clips than into the skin: then the whole figure is scaled.
double commonScale(const ClipFile& file, std::span<const dmat4> sceneFromNode, const std::string& name,
                   ClipScales& scales) {
    const double scale = file.poser.commonScale(sceneFromNode, file.matters());
    if (std::abs(scale - 1.0) <= kAnotherUnit) return 1.0;
    scales.resized.push_back(fmt::format("'{}'", name));
    scales.least = std::min(scales.least, scale);
    scales.most = std::max(scales.most, scale);
    return scale;
}

// Marks the parts of joints that a channel moves in jumps: they must not be blended across the jump. A channel of the
// joint's other part may well be smooth. (Scales are dropped.)
void markSteps(const ClipFile& file, const SourceClip& source, Clip& clip) {
    for (const SourceChannel& channel : source.channels) {
        if (channel.interpolation != SourceChannel::Interpolation::step || channel.times.size() < 2) continue;
        if (channel.path == SourceChannel::Path::scale) continue;
        std::vector<bool>& marks =
            channel.path == SourceChannel::Path::rotation ? clip.steppedRotations : clip.steppedTranslations;
        marks.resize(file.tree.nodeOfJoint.size(), false);
        marks[file.tree.nodes[channel.node].joint] = true;
    }
}

// Only what there is to warn of is looked at now; the poses wait until somebody plays the clip.
Clip makeClip(const std::shared_ptr<const ClipFile>& file, const SourceClip& animation, std::size_t budget,
              ClipScales& scales, std::vector<std::string>& warnings) {
    Timing timing;
    const std::size_t joints = file->tree.nodeOfJoint.size();
    Clip clip = outlineOf(animation, joints, budget, timing, warnings);
    ClipSampler sampler(*file, animation);
    timing.commonScale = commonScale(*file, sampler.at(timing.start), clip.name, scales);
    const std::vector<int> frames =
        scalesSteadily(*file, animation) ? std::vector<int>{0} : tellingFrames(animation, timing);
    const double worst = sampler.droppedScale(frames, timing);
    if (worst > kVisibleScaleOfClip) {
        scales.scaled.push_back(fmt::format("'{}'", clip.name));
        scales.worst = std::max(scales.worst, worst);
    }
    const std::size_t size = joints * static_cast<std::size_t>(timing.frames);
    markSteps(*file, animation, clip);
    clip.parentFromJoint =
        ClipFrames(size, [file, &animation, timing] { return ClipSampler(*file, animation).sample(timing); });
    return clip;
}

}  // namespace

std::pair<double, double> spanOf(const SourceClip& clip) {
    const KeyTimes times = keyTimes(clip);
    return times.last < times.first ? std::pair(0.0, 0.0) : std::pair(times.first, times.last);
}

std::vector<dmat4> parentFromNodes(const SourceScene& scene, const SourceClip& clip, double time) {
    std::vector<dmat4> out;
    out.reserve(scene.nodes.size());
    for (const SourceNode& node : scene.nodes)
        out.push_back(node.parentFromNode);
    std::vector<SourceTrs> parts = partsOf(scene);
    for (const SourceChannel& channel : clip.channels)
        apply(channel, time, parts[static_cast<std::size_t>(channel.node)]);
    for (const SourceChannel& channel : clip.channels)
        out[static_cast<std::size_t>(channel.node)] = matrixOf(parts[static_cast<std::size_t>(channel.node)]);
    return out;
}

std::vector<dmat4> sceneFromNodes(std::span<const int> parents, std::span<const dmat4> parentFromNode) {
    std::vector<dmat4> out;
    out.reserve(parentFromNode.size());
    for (std::size_t node = 0; node < parentFromNode.size(); ++node) {
        const int parent = parents[node];
        out.push_back(parent < 0 ? parentFromNode[node] : out[static_cast<std::size_t>(parent)] * parentFromNode[node]);
    }
    return out;
}

ClipFile::ClipFile(const NodeTree& nodes, std::span<const dmat4> bindSceneFromJoint, const dmat4& modelFromScene,
                   const Skeleton& of, SourceScene& scene)
    : tree(nodes),
      poser(tree, bindSceneFromJoint, modelFromScene),
      own(partsOf(scene)),
      clips(std::move(scene.clips)),
      matters_(new bool[of.parents.size()]) {
    skeleton.parents = of.parents;
    for (std::size_t joint = 0; joint < of.parents.size(); ++joint)
        matters_[joint] = of.skinWeight[joint] > 0.0F;
}

std::vector<Clip> sampleAnimations(const std::shared_ptr<const ClipFile>& file, std::vector<std::string>& warnings) {
    std::vector<Clip> clips;
    ClipScales scales;
    std::size_t budget = kMaxTransforms;
    for (const SourceClip& clip : file->clips) {
        const KeyTimes times = keyTimes(clip);
        if (times.last < times.first) continue;
        if (budget < file->tree.nodeOfJoint.size()) {
            warnings.push_back(
                fmt::format("clips from '{}' on were left out: too much motion for the memory", clip.name));
            break;
        }
        clips.push_back(makeClip(file, clip, budget, scales, warnings));
        budget -= clips.back().parentFromJoint.size();
    }
    for (std::string& sentence : scales.sentences())
        warnings.push_back(std::move(sentence));
    return clips;
}

}  // namespace lutka::animation::rig_import
