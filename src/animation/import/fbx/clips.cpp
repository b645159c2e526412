#include "animation/import/fbx/clips.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "animation/import/affine.hpp"

namespace lutka::animation::rig_import::fbx {
namespace {

constexpr double kLeastRate = 30.0;
constexpr double kMostRate = 120.0;
constexpr int kMaxFrames = 36'000;
// Bounds the memory of all channels together: about 70 bytes each.
constexpr std::size_t kMaxSamples = 8'000'000;
constexpr double kVisibleShear = 0.01;
// How far from a frame a key may lie and still count as on it, in frames.
constexpr double kOnFrame = 0.02;

struct KeyTimes {
    double first = std::numeric_limits<double>::max();
    double last = std::numeric_limits<double>::lowest();
    double smallestGap = std::numeric_limits<double>::max();
};

template <class Visit>
void forEachCurve(const Motion& motion, Visit visit) {
    for (const MotionLayer& layer : motion.layers) {
        for (const AnimatedPart& part : layer.parts) {
            for (const auto& curve : part.curves) {
                if (curve && !curve->keys().empty()) visit(*curve);
            }
        }
    }
}

KeyTimes keyTimesOf(const Motion& motion) {
    KeyTimes out;
    forEachCurve(motion, [&](const Curve& curve) {
        // A single key is a constant, wherever it stands.
        if (curve.keys().size() < 2) return;
        out.first = std::min(out.first, curve.keys().front().seconds);
        out.last = std::max(out.last, curve.keys().back().seconds);
        for (std::size_t i = 1; i < curve.keys().size(); ++i)
            out.smallestGap = std::min(out.smallestGap, curve.keys()[i].seconds - curve.keys()[i - 1].seconds);
    });
    if (out.last < out.first) out.first = out.last = 0.0;
    return out;
}

double raised(double rate) {
    return rate * std::max(1.0, std::ceil(kLeastRate / rate - 0.01));
}

// Whether nearly all keys lie on frames.
bool fits(const Motion& motion, double start, double rate) {
    std::size_t all = 0;
    std::size_t off = 0;
    forEachCurve(motion, [&](const Curve& curve) {
        for (const Curve::Key& key : curve.keys()) {
            const double frame = (key.seconds - start) * rate;
            off += std::abs(frame - std::round(frame)) > kOnFrame ? 1U : 0U;
            ++all;
        }
    });
    return off * 50 <= all;
}

// Poses are often saved as clips of minutes.
bool standsStill(const Motion& motion) {
    const auto moves = [](const std::optional<Curve>& curve) { return curve && curve->moves(); };
    return std::none_of(motion.layers.begin(), motion.layers.end(), [&](const MotionLayer& layer) {
        return moves(layer.weights) ||
               std::any_of(layer.parts.begin(), layer.parts.end(), [&](const AnimatedPart& part) {
                   return std::any_of(part.curves.begin(), part.curves.end(), moves);
               });
    });
}

struct Timing {
    double start = 0.0;  // seconds
    double rate = kLeastRate;
    int frames = 1;
};

Timing timingOf(const Motion& motion, double fileRate) {
    const KeyTimes keys = keyTimesOf(motion);
    // What the stack states, unless it misses the keys altogether (a default that nobody set).
    const bool stated = motion.span && motion.span->first < keys.last && motion.span->second > keys.first;
    Timing timing;
    timing.start = stated ? motion.span->first : keys.first;
    const double stop = stated ? motion.span->second : keys.last;
    timing.rate = raised(std::clamp(fileRate, 1.0, kMostRate));
    if (!fits(motion, timing.start, timing.rate)) {
        const double gap = std::max(keys.smallestGap, 1.0 / 1000.0);
        const double own = 1.0 / gap;
        const double rate = own <= kMostRate ? raised(std::max(own, 0.1)) : kMostRate;
        if (fits(motion, keys.first, rate) && (own > timing.rate || std::abs(own - std::round(own)) > 0.01)) {
            timing.rate = rate;
            const double frames = std::ceil((keys.first - timing.start) * rate - 1e-3);
            timing.start = keys.first - frames / rate;
        } else if (timing.rate < 60.0) {
            timing.rate *= 2.0;
        }
    }
    const double frames = std::floor(std::max(0.0, stop - timing.start) * timing.rate + 1e-3) + 1.0;
    timing.frames = standsStill(motion) ? 1 : static_cast<int>(std::min(frames, static_cast<double>(kMaxFrames) + 1.0));
    return timing;
}

struct Trs {
    dvec3 translation{0};
    glm::dquat rotation{1, 0, 0, 0};
    dvec3 scale{1};
};

// Of a node that inherits plainly, exactly; of others without their shear, which `worstShear` gets.
Trs decomposed(const NodeTransform& transform, const dmat4& parentFromNode, double& worstShear) {
    Trs out;
    out.translation = dvec3(parentFromNode[3]);
    if (transform.inherit == Inherit::plain) {
        out.rotation = glm::normalize(glm::quat_cast(localRotation(transform)));
        out.scale = transform[Part::scaling];
        return out;
    }
    const dmat3 linear(parentFromNode);
    const dmat3 rotation = nearestRotation(parentFromNode);
    const dmat3 stretch = glm::transpose(rotation) * linear;
    out.rotation = glm::normalize(glm::quat_cast(rotation));
    for (int i = 0; i < 3; ++i)
        out.scale[i] = std::copysign(glm::length(linear[i]), stretch[i][i]);
    const double shear = glm::length(dvec3(stretch[1][0], stretch[2][0], stretch[2][1]));
    worstShear = std::max(worstShear, shear / std::max(meanScale(parentFromNode), 1e-12));
    return out;
}

// The nodes whose parent-relative frame may change: those with curves, and those that work a changed parent's scale in.
std::vector<int> movedNodes(const Motion& motion, const ModelTree& tree) {
    std::vector<bool> moves(tree.parents.size(), false);
    for (const MotionLayer& layer : motion.layers) {
        for (const AnimatedPart& part : layer.parts)
            moves[static_cast<std::size_t>(part.node)] = true;
    }
    std::vector<int> out;
    std::vector<bool> belowMoved(tree.parents.size(), false);
    for (std::size_t node = 0; node < tree.parents.size(); ++node) {
        const int parent = tree.parents[node];
        if (parent >= 0) {
            const auto above = static_cast<std::size_t>(parent);
            belowMoved[node] = moves[above] || belowMoved[above];
        }
        if (belowMoved[node] && tree.transforms[node].inherit != Inherit::plain) moves[node] = true;
        if (moves[node]) out.push_back(static_cast<int>(node));
    }
    return out;
}

// A channel of one value where nothing changes.
void shorten(SourceChannel& channel, std::size_t width) {
    for (std::size_t i = width; i < channel.values.size(); ++i) {
        if (channel.values[i] != channel.values[i % width]) return;
    }
    channel.times.resize(std::min<std::size_t>(channel.times.size(), 1));
    channel.values.resize(std::min(channel.values.size(), width));
}

class ClipWriter {
  public:
    ClipWriter(const Motion& motion, const ModelTree& tree, const SceneLayout& layout)
        : player_(motion, tree.transforms), tree_(tree), local_(tree.parents.size()) {
        clip_.name = motion.name;
        for (const int node : movedNodes(motion, tree)) {
            const auto place = static_cast<std::size_t>(node);
            if (layout.helper[place] >= 0) addTrack({place, Track::Kind::helper}, layout.helper[place]);
            const bool below = layout.helper[place] >= 0;
            addTrack({place, below ? Track::Kind::belowHelper : Track::Kind::plain}, layout.sceneNode[place]);
        }
    }

    [[nodiscard]] std::size_t width() const { return tracks_.size(); }
    [[nodiscard]] double worstShear() const { return worstShear_; }

    /// The pose of that time of the file, at that time of the clip.
    void addFrame(double fileSeconds, double seconds) {
        player_.pose(fileSeconds, transforms_);
        evaluateTree(tree_, transforms_, local_);
        for (std::size_t i = 0; i < tracks_.size(); ++i) {
            Track& track = tracks_[i];
            Trs trs = valueOf(track);
            if (glm::dot(track.last, trs.rotation) < 0.0) trs.rotation = -trs.rotation;
            track.last = trs.rotation;
            push(clip_.channels[3 * i], seconds, {trs.translation.x, trs.translation.y, trs.translation.z});
            push(clip_.channels[3 * i + 1], seconds, {trs.rotation.x, trs.rotation.y, trs.rotation.z, trs.rotation.w});
            push(clip_.channels[3 * i + 2], seconds, {trs.scale.x, trs.scale.y, trs.scale.z});
        }
    }

    [[nodiscard]] SourceClip finish() {
        for (SourceChannel& channel : clip_.channels)
            shorten(channel, channel.path == SourceChannel::Path::rotation ? 4 : 3);
        return std::move(clip_);
    }

  private:
    // Three channels of one scene node.
    struct Track {
        enum class Kind { plain, helper, belowHelper };
        std::size_t node = 0;  // of the tree
        Kind kind = Kind::plain;
        glm::dquat last{1, 0, 0, 0};
    };

    void addTrack(const Track& track, int sceneNode) {
        tracks_.push_back(track);
        for (const auto path :
             {SourceChannel::Path::translation, SourceChannel::Path::rotation, SourceChannel::Path::scale}) {
            SourceChannel& channel = clip_.channels.emplace_back();
            channel.node = sceneNode;
            channel.path = path;
        }
    }

    Trs valueOf(const Track& track) {
        const NodeTransform& transform = transforms_[track.node];
        if (track.kind == Track::Kind::plain) return decomposed(transform, local_[track.node], worstShear_);
        const NodeTransform& parent = transforms_[static_cast<std::size_t>(tree_.parents[track.node])];
        if (track.kind == Track::Kind::helper)
            return {dvec3(local_[track.node][3]), glm::dquat(1, 0, 0, 0), 1.0 / usableScale(parent[Part::scaling])};
        const dmat4 helper = parentFromHelper(local_[track.node], parent);
        return decomposed(transform, glm::inverse(helper) * local_[track.node], worstShear_);
    }

    static void push(SourceChannel& channel, double seconds, std::initializer_list<double> values) {
        channel.times.push_back(seconds);
        for (const double value : values)
            channel.values.push_back(static_cast<float>(value));
    }

    MotionPlayer player_;
    const ModelTree& tree_;
    std::vector<Track> tracks_;
    std::vector<NodeTransform> transforms_;
    std::vector<dmat4> local_;
    SourceClip clip_;
    double worstShear_ = 0.0;
};

}  // namespace

double frameRateOf(const Properties& settings) {
    constexpr std::array<double, 19> kRates = {30.0,
                                               120.0,
                                               100.0,
                                               60.0,
                                               50.0,
                                               48.0,
                                               30.0,
                                               30.0,
                                               30000.0 / 1001.0,
                                               30000.0 / 1001.0,
                                               25.0,
                                               24.0,
                                               30.0,
                                               24000.0 / 1001.0,
                                               0.0,
                                               96.0,
                                               72.0,
                                               60000.0 / 1001.0,
                                               120000.0 / 1001.0};
    const std::int64_t mode = settings.integer("TimeMode", 0);
    double rate = mode >= 0 && mode < static_cast<std::int64_t>(kRates.size()) ? kRates[static_cast<std::size_t>(mode)]
                                                                               : kLeastRate;
    if (rate == 0.0) rate = settings.number("CustomFrameRate", kLeastRate);
    return rate >= 1.0 && rate <= 1000.0 ? rate : kLeastRate;
}

std::vector<SourceClip> sampleMotions(std::span<const Motion> motions, const ModelTree& tree, const SceneLayout& layout,
                                      double framesPerSecond, std::vector<std::string>& warnings) {
    std::vector<SourceClip> clips;
    std::size_t budget = kMaxSamples;
    for (const Motion& motion : motions) {
        const Timing timing = timingOf(motion, framesPerSecond);
        ClipWriter writer(motion, tree, layout);
        const std::size_t affordable =
            std::min<std::size_t>(budget / std::max<std::size_t>(writer.width(), 1), kMaxFrames);
        const int frames = static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(timing.frames), affordable));
        if (frames < timing.frames) {
            warnings.push_back(fmt::format("clip '{}' is too long; only its first {:.0f} s were kept", motion.name,
                                           frames / timing.rate));
        }
        for (int frame = 0; frame < frames; ++frame)
            writer.addFrame(timing.start + frame / timing.rate, frame / timing.rate);
        budget -= static_cast<std::size_t>(frames) * writer.width();
        if (writer.worstShear() > kVisibleShear) {
            warnings.push_back(fmt::format("clip '{}' shears joints by up to {:.0f} %; the shear was dropped",
                                           motion.name, 100.0 * writer.worstShear()));
        }
        clips.push_back(writer.finish());
    }
    return clips;
}

}  // namespace lutka::animation::rig_import::fbx
