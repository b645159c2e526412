#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "animation/skeleton.hpp"

namespace lutka::animation {

/// The poses of a clip: a vector that may be filled at its first use, which import makes use of (a file's clips are
/// most of its reading, and few are ever played). Copies share the poses until one of them is changed. Reading is safe
/// from several threads.
class ClipFrames {
  public:
    /// Gives the poses; called once at most. `size` is how many frames it will give.
    using Source = std::function<std::vector<RigidTransform>()>;

    ClipFrames() = default;
    ClipFrames(std::size_t size, Source source);

    /// Known without the poses.
    [[nodiscard]] std::size_t size() const { return shared_ ? shared_->size : 0; }
    [[nodiscard]] bool empty() const { return size() == 0; }
    [[nodiscard]] const std::vector<RigidTransform>& get() const;
    /// To be changed; the copies of this clip keep what they have.
    [[nodiscard]] std::vector<RigidTransform>& change();

    [[nodiscard]] std::vector<RigidTransform>::const_iterator begin() const { return get().begin(); }
    [[nodiscard]] std::vector<RigidTransform>::const_iterator end() const { return get().end(); }
    [[nodiscard]] const RigidTransform& operator[](std::size_t index) const { return get()[index]; }
    [[nodiscard]] const RigidTransform* data() const { return get().data(); }
    void push_back(const RigidTransform& frame);
    void append(std::span<const RigidTransform> frames);

  private:
    struct Shared {
        std::size_t size = 0;
        std::once_flag once;
        Source source;
        std::vector<RigidTransform> frames;
    };
    std::shared_ptr<Shared> shared_;
};

/// An animation as poses at a fixed rate: `frameCount` poses of jointCount() parent-relative frames each.
///
/// Import resamples every channel to one rate, so that sampling is two reads and a blend; scale channels are baked
/// where they are constant and dropped, with a warning, where they are not.
struct Clip {
    std::string name;
    float framesPerSecond = 30.0F;  ///< > 0.
    int frameCount = 0;             ///< >= 1. The clip lasts (frameCount - 1) / framesPerSecond seconds.
    ClipFrames parentFromJoint;     ///< frameCount × jointCount, frame after frame.
    /// Mark the joints whose rotation or translation holds each frame until the next one instead of moving towards it
    /// (a file's STEP channels). Empty: none does.
    std::vector<bool> steppedRotations;
    std::vector<bool> steppedTranslations = {};

    [[nodiscard]] float seconds() const {
        return frameCount > 1 ? static_cast<float>(frameCount - 1) / framesPerSecond : 0.0F;
    }
};

/// The clip's pose at `seconds` (clamped to its length), parent-relative, into `parentFromJoint` (jointCount() long).
void sampleClip(const Clip& clip, float seconds, std::span<RigidTransform> parentFromJoint);

}  // namespace lutka::animation
