#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "animation/playback/clip_batch.hpp"
#include "animation/playback/clip_library.hpp"
#include "animation/playback/joint_mask.hpp"

namespace lutka::animation {

/// How a clip is started.
struct PlaySettings {
    bool loop = true;                           ///< False: stays at its end.
    float speed = 1.0F;                         ///< Clip seconds a second; negative: backwards; 0 stands still.
    float fadeSeconds = 0.0F;                   ///< How long it takes to cover what its layer shows now; 0: at once.
    std::optional<float> start = std::nullopt;  ///< Seconds into the clip (clamped); unset: the end that it comes from.
};

/// A layer over the ones before it.
struct LayerSettings {
    JointMask mask = {};    ///< Which joints it moves; empty: all.
    bool additive = false;  ///< Adds how the pose differs from its clip's first frame, in each joint's own frame.
    float weight = 1.0F;    ///< [0, 1]
};

/// An event that was passed in an advance().
struct FiredEvent {
    int layer = 0;
    int clip = 0;
    int event = 0;            ///< Index into ClipLibrary::events(clip).
    float weight = 1.0F;      ///< [0, 1]: how much of its layer the clip was after the step.
    float secondsAgo = 0.0F;  ///< Before the step's end, >= 0.
};
using EventSink = std::function<void(const FiredEvent&)>;

/// What becomes of a clip's travel (RootMotionSettings): stays in the pose, or is taken from it and given as a delta.
enum class RootMotion { keep, extract };

/// Plays clips of a library on one figure: layers of cross-faded clips, lowest first, over the bind pose.
///
/// A clip that is started fades in over what its layer shows, with the weight 3t² - 2t³; the clips below go on
/// meanwhile. Any number of fades may interrupt one another, and the pose stays continuous: what no longer fits among a
/// layer's plays is held as a pose. Everything is allocated when the player is made. The same calls give the same bits.
class ClipPlayer {
  public:
    static constexpr int kMostPlays = kMostClipTerms;  ///< Of a layer at once, the one on top included.
    /// Of one clip in one advance(), as far as events go; the clip's time and travel are exact at any step.
    static constexpr int kMostPassesTold = 4096;

    /// `library` must outlive the player. Without layers: one plain layer.
    explicit ClipPlayer(const ClipLibrary& library, std::vector<LayerSettings> layers = {},
                        RootMotion root = RootMotion::keep);

    [[nodiscard]] int layerCount() const { return static_cast<int>(layers_.size()); }
    void play(int layer, int clip, const PlaySettings& settings = {});
    /// Fades the layer out: the layers below, or the bind pose, come through.
    void stop(int layer, float fadeSeconds = 0.0F);
    void setWeight(int layer, float weight);
    /// Of the clip on top of the layer, as the following are; nothing plays: does nothing.
    void setSpeed(int layer, float speed);
    void seek(int layer, float seconds);
    /// -1: nothing plays, or it fades out.
    [[nodiscard]] int clip(int layer) const;
    [[nodiscard]] float seconds(int layer) const;
    /// Whether it doesn't loop and has come to its end.
    [[nodiscard]] bool hasEnded(int layer) const;

    /// Goes on by `dt` seconds, finite and >= 0. Tells every event that was passed, each once a pass: forwards a step
    /// covers its beginning and not its end, backwards the reverse, and the end of a clip where it turns over or stops
    /// belongs to the pass.
    void advance(float dt, const EventSink& sink = {});

    /// The travel of the last advance(), with RootMotion::extract: the doll's worldFromModel is to be multiplied by it
    /// from the right. Mixed as the pose is; additive layers and those that don't move the settings' joint have no say.
    [[nodiscard]] const RigidTransform& rootDelta() const { return rootDelta_; }

    /// The pose now, parent-relative, into jointCount() frames.
    void pose(std::span<RigidTransform> parentFromJoint);
    /// The layer's clips for a ClipBatch; unset while its pose is not made of whole clips (it fades in or out, or holds
    /// a pose).
    [[nodiscard]] std::optional<ClipMix> mix(int layer) const;

  private:
    struct Play {
        enum class What { clip, nothing, held };
        What what = What::nothing;
        int clip = 0;
        double time = 0.0;
        float speed = 1.0F;
        bool loop = true;
        int endedTowards = 0;  // sign of the speed that brought it to its end; 0: it has not come there
        float fade = 0.0F;     // seconds
        float faded = 0.0F;    // seconds since its start
        float heldWeight = 1.0F;
        RigidTransform delta;  // travel of the last step

        [[nodiscard]] float cover() const;
    };
    struct Layer {
        LayerSettings settings;
        std::array<Play, kMostPlays> plays;
        int count = 0;
        std::vector<RigidTransform> held;
    };
    struct Step;

    Play& push(Layer& layer, float fadeSeconds);
    void dropCovered(Layer& layer) const;
    void hold(Layer& layer);
    void movePlay(Play& play, double dt, const Step& step) const;
    [[nodiscard]] bool wrap(Play& play, double from, double to, const Step& step) const;
    void tell(const Play& play, double low, double high, bool withLow, bool withHigh, const Step& step) const;
    void mixRoot();
    /// Into `out`; returns how much of the layer there is, [0, 1].
    float poseOf(const Layer& layer, int plays, std::span<RigidTransform> out);
    void samplePlay(const Layer& layer, const Play& play, std::span<RigidTransform> out) const;

    const ClipLibrary* library_;
    RootMotion root_;
    std::vector<Layer> layers_;
    RigidTransform rootDelta_;
    std::vector<RigidTransform> layerPose_;
    std::vector<RigidTransform> playPose_;
};

}  // namespace lutka::animation
