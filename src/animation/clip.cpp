#include "animation/clip.hpp"

#include <algorithm>

#include "core/assert.hpp"

namespace lutka::animation {
namespace {

bool marks(const std::vector<bool>& marked, std::size_t joint) {
    return joint < marked.size() && marked[joint];
}

}  // namespace

ClipFrames::ClipFrames(std::size_t size, Source source) : shared_(std::make_shared<Shared>()) {
    shared_->size = size;
    shared_->source = std::move(source);
}

const std::vector<RigidTransform>& ClipFrames::get() const {
    static const std::vector<RigidTransform> none;
    if (!shared_) return none;
    Shared& shared = *shared_;
    std::call_once(shared.once, [&shared] {
        if (!shared.source) return;
        shared.frames = shared.source();
        shared.source = nullptr;  // and what it holds of the file
        LUTKA_ASSERT(shared.frames.size() == shared.size);
    });
    return shared.frames;
}

std::vector<RigidTransform>& ClipFrames::change() {
    auto own = std::make_shared<Shared>();
    // Others may hold the shared poses, or come to them at this very moment.
    const std::vector<RigidTransform>& present = get();
    if (shared_.use_count() == 1)
        own->frames = std::move(shared_->frames);
    else
        own->frames = present;
    own->size = own->frames.size();
    shared_ = std::move(own);
    return shared_->frames;
}

void ClipFrames::push_back(const RigidTransform& frame) {
    append(std::span(&frame, 1));
}

void ClipFrames::append(std::span<const RigidTransform> frames) {
    if (!shared_ || shared_.use_count() > 1 || shared_->source) static_cast<void>(change());
    shared_->frames.insert(shared_->frames.end(), frames.begin(), frames.end());
    shared_->size = shared_->frames.size();
}

void sampleClip(const Clip& clip, float seconds, std::span<RigidTransform> parentFromJoint) {
    const std::size_t joints = parentFromJoint.size();
    LUTKA_ASSERT(clip.frameCount >= 1);
    LUTKA_ASSERT(clip.parentFromJoint.size() == joints * static_cast<std::size_t>(clip.frameCount));
    const std::vector<RigidTransform>& frames = clip.parentFromJoint.get();
    const float last = static_cast<float>(clip.frameCount - 1);
    const float at = std::clamp(seconds * clip.framesPerSecond, 0.0F, last);
    const auto before = static_cast<std::size_t>(at);
    const std::size_t after = std::min<std::size_t>(before + 1, static_cast<std::size_t>(clip.frameCount) - 1);
    const float alpha = at - static_cast<float>(before);
    // A time that misses its frame by rounding alone shows that frame.
    const std::size_t held = std::min<std::size_t>(static_cast<std::size_t>(at + 1e-3F), clip.frameCount - 1U);
    for (std::size_t joint = 0; joint < joints; ++joint) {
        RigidTransform& out = parentFromJoint[joint];
        out = interpolate(frames[before * joints + joint], frames[after * joints + joint], alpha);
        const RigidTransform& stepped = frames[held * joints + joint];
        if (marks(clip.steppedRotations, joint)) out.rotation = stepped.rotation;
        if (marks(clip.steppedTranslations, joint)) out.translation = stepped.translation;
    }
}

}  // namespace lutka::animation
