#include "animation/playback/clip_player.hpp"

#include <algorithm>
#include <cmath>

#include "core/assert.hpp"

namespace lutka::animation {
namespace {

// 3t² - 2t³: neither begins nor ends with a jerk.
float eased(float t) {
    return t * t * (3.0F - 2.0F * t);
}

// What a pose with `cover` puts over what is there, as a fold of "over": how much of the new one the mix has.
float shareOver(float& presence, float cover) {
    presence = presence * (1.0F - cover) + cover;
    return presence > 0.0F ? std::min(cover / presence, 1.0F) : 1.0F;
}

// A pose as its difference from another, each joint in its own frame.
void subtract(std::span<const RigidTransform> reference, std::span<RigidTransform> pose) {
    for (std::size_t joint = 0; joint < pose.size(); ++joint) {
        pose[joint].rotation = glm::conjugate(reference[joint].rotation) * pose[joint].rotation;
        pose[joint].translation -= reference[joint].translation;
    }
}

}  // namespace

/// Whom and when a play's events go to.
struct ClipPlayer::Step {
    int layer = 0;
    const EventSink* sink = nullptr;
    float weight = 1.0F;
    double speed = 1.0;
    double end = 0.0;   // where the play's time comes to, not wrapped
    double base = 0.0;  // how far the present pass is from the first one, in clip seconds
};

float ClipPlayer::Play::cover() const {
    if (what == What::held) return heldWeight;
    return faded >= fade ? 1.0F : eased(faded / fade);
}

ClipPlayer::ClipPlayer(const ClipLibrary& library, std::vector<LayerSettings> layers, RootMotion root)
    : library_(&library), root_(root) {
    const auto joints = static_cast<std::size_t>(library.jointCount());
    if (layers.empty()) layers.emplace_back();
    for (LayerSettings& settings : layers) {
        LUTKA_ASSERT(settings.mask.weights.empty() || settings.mask.weights.size() == joints);
        layers_.push_back({std::move(settings), {}, 0, std::vector<RigidTransform>(joints)});
    }
    layerPose_.resize(joints);
    playPose_.resize(joints);
}

void ClipPlayer::dropCovered(Layer& layer) const {
    for (int play = layer.count - 1; play > 0; --play) {
        if (layer.plays[play].cover() < 1.0F) continue;
        std::move(layer.plays.begin() + play, layer.plays.begin() + layer.count, layer.plays.begin());
        layer.count -= play;
        return;
    }
}

// The two lowest plays become a pose that stands still.
void ClipPlayer::hold(Layer& layer) {
    const float presence = poseOf(layer, 2, layerPose_);
    std::copy(layerPose_.begin(), layerPose_.end(), layer.held.begin());
    Play held;
    held.what = Play::What::held;
    held.heldWeight = presence;
    std::move(layer.plays.begin() + 2, layer.plays.begin() + layer.count, layer.plays.begin() + 1);
    layer.plays[0] = held;
    --layer.count;
}

ClipPlayer::Play& ClipPlayer::push(Layer& layer, float fadeSeconds) {
    LUTKA_ASSERT(std::isfinite(fadeSeconds) && fadeSeconds >= 0.0F);
    if (fadeSeconds == 0.0F) layer.count = 0;
    if (layer.count == kMostPlays) hold(layer);
    Play& play = layer.plays[layer.count++];
    play = Play{};
    play.fade = fadeSeconds;
    return play;
}

void ClipPlayer::play(int layer, int clip, const PlaySettings& settings) {
    LUTKA_ASSERT(layer >= 0 && layer < layerCount());
    LUTKA_ASSERT(clip >= 0 && clip < library_->clipCount());
    LUTKA_ASSERT(std::isfinite(settings.speed));
    Play& play = push(layers_[layer], settings.fadeSeconds);
    const float length = library_->seconds(clip);
    play.what = Play::What::clip;
    play.clip = clip;
    play.speed = settings.speed;
    play.loop = settings.loop;
    const float start = settings.start.value_or(settings.speed < 0.0F ? length : 0.0F);
    LUTKA_ASSERT(std::isfinite(start));
    play.time = static_cast<double>(std::clamp(start, 0.0F, length));
}

void ClipPlayer::stop(int layer, float fadeSeconds) {
    LUTKA_ASSERT(layer >= 0 && layer < layerCount());
    push(layers_[layer], fadeSeconds);
}

void ClipPlayer::setWeight(int layer, float weight) {
    LUTKA_ASSERT(weight >= 0.0F && weight <= 1.0F);
    layers_[layer].settings.weight = weight;
}

void ClipPlayer::setSpeed(int layer, float speed) {
    LUTKA_ASSERT(std::isfinite(speed));
    if (clip(layer) < 0) return;
    layers_[layer].plays[layers_[layer].count - 1].speed = speed;
}

void ClipPlayer::seek(int layer, float seconds) {
    LUTKA_ASSERT(std::isfinite(seconds));
    if (clip(layer) < 0) return;
    Play& play = layers_[layer].plays[layers_[layer].count - 1];
    play.time = static_cast<double>(std::clamp(seconds, 0.0F, library_->seconds(play.clip)));
    play.endedTowards = 0;
}

int ClipPlayer::clip(int layer) const {
    LUTKA_ASSERT(layer >= 0 && layer < layerCount());
    const Layer& of = layers_[layer];
    if (of.count == 0 || of.plays[of.count - 1].what != Play::What::clip) return -1;
    return of.plays[of.count - 1].clip;
}

float ClipPlayer::seconds(int layer) const {
    return clip(layer) < 0 ? 0.0F : static_cast<float>(layers_[layer].plays[layers_[layer].count - 1].time);
}

bool ClipPlayer::hasEnded(int layer) const {
    return clip(layer) >= 0 && layers_[layer].plays[layers_[layer].count - 1].endedTowards != 0;
}

void ClipPlayer::tell(const Play& play, double low, double high, bool withLow, bool withHigh, const Step& step) const {
    if (step.sink == nullptr || !*step.sink) return;
    const std::span<const ClipEvent> events = library_->events(play.clip);
    const auto count = static_cast<int>(events.size());
    for (int i = 0; i < count; ++i) {
        const int event = step.speed < 0.0 ? count - 1 - i : i;  // in the order in which they are passed
        const auto at = static_cast<double>(events[event].seconds);
        const bool above = withLow ? at >= low : at > low;
        const bool below = withHigh ? at <= high : at < high;
        if (!above || !below) continue;
        const double ago = std::max((step.end - (at + step.base)) / step.speed, 0.0);
        (*step.sink)({step.layer, play.clip, event, step.weight, static_cast<float>(ago)});
    }
}

// Over a loop's seam. False when the step stays within the pass.
bool ClipPlayer::wrap(Play& play, double from, double to, const Step& step) const {
    const auto length = static_cast<double>(library_->seconds(play.clip));
    const double passes = std::floor(to / length);
    if (passes == 0.0) return false;
    const bool forwards = passes > 0.0;
    const double rest = std::clamp(to - passes * length, 0.0, length);
    const double whole = std::abs(passes) - 1.0;  // passes from end to end
    const double told = std::min(whole, static_cast<double>(kMostPassesTold));
    const double direction = forwards ? length : -length;
    Step at = step;
    tell(play, forwards ? from : 0.0, forwards ? length : from, true, true, at);
    at.base = (whole - told) * direction;
    for (double pass = 0.0; pass < told; pass += 1.0) {
        at.base += direction;
        tell(play, 0.0, length, true, true, at);
    }
    at.base = passes * length;
    tell(play, forwards ? 0.0 : rest, forwards ? rest : length, forwards, !forwards, at);
    const auto ground = [&](double seconds) { return library_->groundFrame(play.clip, static_cast<float>(seconds)); };
    const double exit = forwards ? length : 0.0;
    const double entry = length - exit;
    // More passes than this come from a caller's absurd step; the travel has lost all meaning by then.
    const auto repeats = static_cast<long long>(std::min(whole, 1e9));
    play.delta = inverse(ground(from)) * ground(exit) * powerOf(inverse(ground(entry)) * ground(exit), repeats) *
                 inverse(ground(entry)) * ground(rest);
    play.time = rest;
    return true;
}

void ClipPlayer::movePlay(Play& play, double dt, const Step& told) const {
    play.delta = {};
    const int direction = play.speed > 0.0F ? 1 : play.speed < 0.0F ? -1 : 0;
    if (direction == 0 || dt == 0.0 || play.endedTowards == direction) return;
    play.endedTowards = 0;
    const auto length = static_cast<double>(library_->seconds(play.clip));
    const double from = play.time;
    const double to = from + dt * static_cast<double>(play.speed);
    Step step = told;
    step.speed = static_cast<double>(play.speed);
    step.end = to;
    const bool loops = play.loop && length > 0.0;
    if (loops && wrap(play, from, to, step)) return;
    const bool ends = !loops && (direction > 0 ? to >= length : to <= 0.0);
    play.time = std::clamp(to, 0.0, length);
    if (direction > 0)
        tell(play, from, ends ? length : to, true, ends, step);
    else
        tell(play, ends ? 0.0 : to, from, ends, true, step);
    if (ends) play.endedTowards = direction;
    play.delta = inverse(library_->groundFrame(play.clip, static_cast<float>(from))) *
                 library_->groundFrame(play.clip, static_cast<float>(play.time));
}

void ClipPlayer::advance(float dt, const EventSink& sink) {
    LUTKA_ASSERT(std::isfinite(dt) && dt >= 0.0F);
    for (int index = 0; index < layerCount(); ++index) {
        Layer& layer = layers_[index];
        for (int i = 0; i < layer.count; ++i)
            layer.plays[i].faded = std::min(layer.plays[i].faded + dt, layer.plays[i].fade);
        float above = 1.0F;  // what the plays on top leave
        std::array<float, kMostPlays> weights{};
        for (int i = layer.count - 1; i >= 0; --i) {
            weights[i] = above * layer.plays[i].cover();
            above *= 1.0F - layer.plays[i].cover();
        }
        for (int i = 0; i < layer.count; ++i) {
            if (layer.plays[i].what != Play::What::clip) continue;
            movePlay(layer.plays[i], static_cast<double>(dt), {index, &sink, weights[i]});
        }
    }
    mixRoot();
    for (Layer& layer : layers_)
        dropCovered(layer);
}

void ClipPlayer::mixRoot() {
    rootDelta_ = {};
    const int joint = library_->root().joint;
    if (root_ == RootMotion::keep || joint == kNoJoint) return;
    for (const Layer& layer : layers_) {
        const float mask = layer.settings.additive ? 0.0F : layer.settings.weight * layer.settings.mask[joint];
        RigidTransform delta;
        float presence = 0.0F;
        for (int i = 0; mask > 0.0F && i < layer.count; ++i) {
            const Play& play = layer.plays[i];
            if (play.what == Play::What::nothing)
                presence *= 1.0F - play.cover();
            else
                delta = interpolate(delta, play.delta, shareOver(presence, play.cover()));
        }
        rootDelta_ = interpolate(rootDelta_, delta, presence * mask);
    }
}

void ClipPlayer::samplePlay(const Layer& layer, const Play& play, std::span<RigidTransform> out) const {
    if (play.what == Play::What::held) {
        std::copy(layer.held.begin(), layer.held.end(), out.begin());
        return;
    }
    const auto seconds = static_cast<float>(play.time);
    if (layer.settings.additive) {
        library_->sample(play.clip, seconds, out);
        subtract(library_->firstFrame(play.clip), out);
    } else if (root_ == RootMotion::extract) {
        library_->sampleInPlace(play.clip, seconds, out);
    } else {
        library_->sample(play.clip, seconds, out);
    }
}

float ClipPlayer::poseOf(const Layer& layer, int plays, std::span<RigidTransform> out) {
    float presence = 0.0F;
    for (int i = 0; i < plays; ++i) {
        const Play& play = layer.plays[i];
        if (play.what == Play::What::nothing) {
            presence *= 1.0F - play.cover();
            continue;
        }
        const bool first = presence == 0.0F;
        const float share = shareOver(presence, play.cover());
        if (first || share >= 1.0F) {
            samplePlay(layer, play, out);
            continue;
        }
        samplePlay(layer, play, playPose_);
        for (std::size_t joint = 0; joint < out.size(); ++joint)
            out[joint] = interpolate(out[joint], playPose_[joint], share);
    }
    return presence;
}

void ClipPlayer::pose(std::span<RigidTransform> parentFromJoint) {
    LUTKA_ASSERT(parentFromJoint.size() == layerPose_.size());
    std::copy(library_->restPose().begin(), library_->restPose().end(), parentFromJoint.begin());
    for (const Layer& layer : layers_) {
        if (layer.settings.weight <= 0.0F) continue;
        const float weight = poseOf(layer, layer.count, layerPose_) * layer.settings.weight;
        if (weight <= 0.0F) continue;
        for (std::size_t joint = 0; joint < parentFromJoint.size(); ++joint) {
            const float share = weight * layer.settings.mask[joint];
            RigidTransform& out = parentFromJoint[joint];
            if (share <= 0.0F) continue;
            if (layer.settings.additive) {
                const RigidTransform added = interpolate({}, layerPose_[joint], share);
                out = {glm::normalize(out.rotation * added.rotation), out.translation + added.translation};
            } else {
                out = share >= 1.0F ? layerPose_[joint] : interpolate(out, layerPose_[joint], share);
            }
        }
    }
}

std::optional<ClipMix> ClipPlayer::mix(int layer) const {
    LUTKA_ASSERT(layer >= 0 && layer < layerCount());
    const Layer& of = layers_[layer];
    if (of.count == 0 || of.plays[0].cover() < 1.0F) return std::nullopt;
    ClipMix mix;
    mix.count = of.count;
    for (int i = 0; i < of.count; ++i) {
        const Play& play = of.plays[i];
        if (play.what != Play::What::clip) return std::nullopt;
        mix.terms[i] = {play.clip, static_cast<float>(play.time), play.cover()};
    }
    return mix;
}

}  // namespace lutka::animation
