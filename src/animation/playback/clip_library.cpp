#include "animation/playback/clip_library.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "animation/pose.hpp"
#include "animation/wide/layout.hpp"
#include "core/assert.hpp"

namespace lutka::animation {
namespace {

Error clipError(const Clip& clip, const std::string& what) {
    return {ErrorCode::input, fmt::format("clip '{}' {}", clip.name, what), "", "give clips of this skeleton"};
}

Result<void> checkClip(const Clip& clip, std::size_t joints) {
    if (clip.frameCount < 1) return clipError(clip, "has no frames");
    if (!(clip.framesPerSecond > 0.0F) || !std::isfinite(clip.framesPerSecond))
        return clipError(clip, fmt::format("has {} frames a second", clip.framesPerSecond));
    if (clip.parentFromJoint.size() != joints * static_cast<std::size_t>(clip.frameCount)) {
        return clipError(clip, fmt::format("has {} joint frames where {} joints × {} frames are wanted",
                                           clip.parentFromJoint.size(), joints, clip.frameCount));
    }
    const std::vector<RigidTransform>& frames = clip.parentFromJoint.get();
    const auto bad =
        std::find_if_not(frames.begin(), frames.end(), [](const RigidTransform& frame) { return isFinite(frame); });
    if (bad != frames.end())
        return clipError(clip, fmt::format("has a frame that is not finite, of joint {}",
                                           static_cast<std::size_t>(bad - frames.begin()) % joints));
    return {};
}

unsigned char heldPartsOf(const Clip& clip, std::size_t joint) {
    const auto marked = [&](const std::vector<bool>& marks) { return joint < marks.size() && marks[joint]; };
    return static_cast<unsigned char>((marked(clip.steppedRotations) ? wide::kHeldTurn : 0) |
                                      (marked(clip.steppedTranslations) ? wide::kHeldPlace : 0));
}

}  // namespace

ClipLibrary::ClipLibrary(const Skeleton& skeleton, const RootMotionSettings& root)
    : skeleton_(skeleton), root_(root), rest_(skeleton.parents.size()) {
    modelToLocal(skeleton_, skeleton_.bindModelFromJoint, rest_);
    for (int joint = 0; joint < skeleton_.jointCount(); ++joint) {
        if (skeleton_.parents[joint] == kNoJoint) rootJoints_.push_back(joint);
    }
}

Result<ClipLibrary> ClipLibrary::create(const Skeleton& skeleton, std::span<const Clip> clips,
                                        const RootMotionSettings& root) {
    LUTKA_ASSERT(skeleton.jointCount() > 0);
    LUTKA_ASSERT(root.joint >= kNoJoint && root.joint < skeleton.jointCount());
    LUTKA_ASSERT(std::abs(glm::length(root.up) - 1.0F) < 1e-3F);
    for (const Clip& clip : clips) {
        if (auto checked = checkClip(clip, skeleton.parents.size()); !checked) return checked.error();
    }
    ClipLibrary library(skeleton, root);
    for (const Clip& clip : clips)
        library.add(clip);
    // Most files have none, and then nothing is looked up.
    const bool steps =
        std::any_of(library.stepped_.begin(), library.stepped_.end(), [](auto held) { return held != 0; });
    if (!steps) library.stepped_.clear();
    return library;
}

void ClipLibrary::add(const Clip& clip) {
    const std::size_t joints = skeleton_.parents.size();
    Entry entry;
    entry.name = clip.name;
    entry.framesPerSecond = clip.framesPerSecond;
    entry.seconds = clip.seconds();
    entry.frameCount = clip.frameCount;
    entry.firstPose = ground_.size();
    frames_.insert(frames_.end(), clip.parentFromJoint.begin(), clip.parentFromJoint.end());
    for (std::size_t joint = 0; joint < joints; ++joint)
        stepped_.push_back(heldPartsOf(clip, joint));
    float firstHeight = 0.0F;
    for (int frame = 0; frame < clip.frameCount; ++frame) {
        const auto pose = std::span<const RigidTransform>(frames_).subspan(ground_.size() * joints, joints);
        if (frame == 0 && root_.joint != kNoJoint)
            firstHeight = glm::dot(modelFrameOf(skeleton_, pose, root_.joint).translation, root_.up);
        RigidTransform ground = animation::groundFrame(skeleton_, root_, pose, firstHeight);
        // Neighbours on one side, so that a heading is interpolated the short way.
        if (frame > 0 && glm::dot(ground.rotation, ground_.back().rotation) < 0.0F) ground.rotation = -ground.rotation;
        ground_.push_back(ground);
    }
    clips_.push_back(std::move(entry));
}

int ClipLibrary::find(std::string_view name) const {
    const auto found = std::find_if(clips_.begin(), clips_.end(), [&](const Entry& clip) { return clip.name == name; });
    return found == clips_.end() ? -1 : static_cast<int>(found - clips_.begin());
}

std::span<const RigidTransform> ClipLibrary::firstFrame(int clip) const {
    const std::size_t joints = skeleton_.parents.size();
    return std::span(frames_).subspan(clips_[clip].firstPose * joints, joints);
}

ClipLibrary::Moment ClipLibrary::momentOf(int clip, float seconds) const {
    const Entry& entry = clips_[clip];
    const auto last = static_cast<std::size_t>(entry.frameCount - 1);
    const float at = std::clamp(seconds * entry.framesPerSecond, 0.0F, static_cast<float>(last));
    const auto before = std::min(static_cast<std::size_t>(at), last);
    const std::size_t after = std::min(before + 1, last);
    const std::size_t joints = skeleton_.parents.size();
    // A time that misses its frame by rounding alone shows that frame, as in sampleClip().
    const std::size_t held = std::min(static_cast<std::size_t>(at + 1e-3F), last);
    return {(entry.firstPose + before) * joints, (entry.firstPose + after) * joints, at - static_cast<float>(before),
            held == before ? 0.0F : 1.0F};
}

void ClipLibrary::sample(int clip, float seconds, std::span<RigidTransform> parentFromJoint) const {
    LUTKA_ASSERT(clip >= 0 && clip < clipCount());
    LUTKA_ASSERT(parentFromJoint.size() == skeleton_.parents.size());
    const Moment moment = momentOf(clip, seconds);
    const std::size_t row = static_cast<std::size_t>(clip) * parentFromJoint.size();
    for (std::size_t joint = 0; joint < parentFromJoint.size(); ++joint) {
        parentFromJoint[joint] = jointAt(moment, joint, stepped_.empty() ? 0 : stepped_[row + joint]);
    }
}

RigidTransform ClipLibrary::jointAt(const Moment& moment, std::size_t joint, unsigned char held) const {
    const RigidTransform& before = frames_[moment.before + joint];
    const RigidTransform& after = frames_[moment.after + joint];
    RigidTransform out = interpolate(before, after, moment.alpha);
    const RigidTransform& shown = moment.heldAlpha > 0.0F ? after : before;
    if ((held & wide::kHeldTurn) != 0) out.rotation = shown.rotation;
    if ((held & wide::kHeldPlace) != 0) out.translation = shown.translation;
    return out;
}

void ClipLibrary::sampleInPlace(int clip, float seconds, std::span<RigidTransform> parentFromJoint) const {
    sample(clip, seconds, parentFromJoint);
    if (root_.joint == kNoJoint) return;
    const RigidTransform groundFromModel = inverse(groundFrame(clip, seconds));
    for (const int joint : rootJoints_)
        parentFromJoint[joint] = groundFromModel * parentFromJoint[joint];
}

RigidTransform ClipLibrary::groundFrame(int clip, float seconds) const {
    const Moment moment = momentOf(clip, seconds);
    const std::size_t joints = skeleton_.parents.size();
    return interpolate(ground_[moment.before / joints], ground_[moment.after / joints], moment.alpha);
}

Result<void> ClipLibrary::addEvent(int clip, ClipEvent event) {
    LUTKA_ASSERT(clip >= 0 && clip < clipCount());
    Entry& entry = clips_[clip];
    if (!(event.seconds >= 0.0F && event.seconds <= entry.seconds)) {
        return Error{ErrorCode::usage, fmt::format("event '{}' at {} s", event.name, event.seconds),
                     fmt::format("clip '{}'", entry.name),
                     fmt::format("give a moment from 0 to {:.3g} s", entry.seconds)};
    }
    const auto later = [](float seconds, const ClipEvent& other) { return seconds < other.seconds; };
    const auto at = std::upper_bound(entry.events.begin(), entry.events.end(), event.seconds, later);
    entry.events.insert(at, std::move(event));
    return {};
}

}  // namespace lutka::animation
