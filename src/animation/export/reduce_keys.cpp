#include "animation/export/reduce_keys.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numeric>
#include <span>

#include "animation/pose.hpp"
#include "core/assert.hpp"

namespace lutka::animation {
namespace {

using Frames = std::vector<RigidTransform>;  // one a joint, frame after frame

// The share of the greatest cause of an error from which on another is mended with it: fewer rounds for a few keys.
constexpr float kAlsoMended = 0.5F;

float angleBetween(const quat& a, const quat& b) {
    const quat between = glm::conjugate(a) * b;
    return 2.0F * std::atan2(glm::length(vec3(between.x, between.y, between.z)), std::abs(between.w));
}

bool isHeld(const std::vector<bool>& marks, std::size_t joint) {
    return joint < marks.size() && marks[joint];
}

/// Adds keys where a joint is too far off until none is.
class Reducer {
  public:
    Reducer(const Skeleton& skeleton, const Clip& clip, const KeyTolerance& tolerance, std::span<const float> reach)
        : skeleton_(skeleton),
          reach_(reach.begin(), reach.end()),
          joints_(skeleton.parents.size()),
          frames_(clip.frameCount),
          tolerance_(tolerance),
          local_(clip.parentFromJoint.get()),
          model_(local_.size()),
          blended_(local_),
          blendedModel_(local_.size()) {
        reach_.resize(joints_, 0.0F);
        for (int frame = 0; frame < frames_; ++frame)
            localToModel(skeleton_, at(local_, frame), at(model_, frame));
        keys_.rotations = ends(clip.steppedRotations);
        keys_.translations = ends(clip.steppedTranslations);
    }

    KeptKeys run() {
        // Each round adds a key to a channel that lacks one there: it ends with all of them at the latest.
        do {
            blend();
        } while (addKeys());
        return std::move(keys_);
    }

  private:
    [[nodiscard]] std::span<RigidTransform> at(Frames& frames, int frame) const {
        return std::span(frames).subspan(static_cast<std::size_t>(frame) * joints_, joints_);
    }
    [[nodiscard]] const RigidTransform& of(const Frames& frames, int frame, std::size_t joint) const {
        return frames[static_cast<std::size_t>(frame) * joints_ + joint];
    }

    [[nodiscard]] std::vector<std::vector<int>> ends(const std::vector<bool>& held) const {
        std::vector<std::vector<int>> keys(joints_);
        for (std::size_t joint = 0; joint < joints_; ++joint) {
            if (isHeld(held, joint)) {
                keys[joint].resize(static_cast<std::size_t>(frames_));
                std::iota(keys[joint].begin(), keys[joint].end(), 0);
            } else {
                keys[joint] = frames_ > 1 ? std::vector{0, frames_ - 1} : std::vector{0};
            }
        }
        return keys;
    }

    void blend() {
        for (std::size_t joint = 0; joint < joints_; ++joint) {
            overSpans(keys_.rotations[joint], [&](int frame, int from, int to, float share) {
                blended_[static_cast<std::size_t>(frame) * joints_ + joint].rotation =
                    glm::slerp(of(local_, from, joint).rotation, of(local_, to, joint).rotation, share);
            });
            overSpans(keys_.translations[joint], [&](int frame, int from, int to, float share) {
                blended_[static_cast<std::size_t>(frame) * joints_ + joint].translation =
                    glm::mix(of(local_, from, joint).translation, of(local_, to, joint).translation, share);
            });
        }
        for (int frame = 0; frame < frames_; ++frame)
            localToModel(skeleton_, at(blended_, frame), at(blendedModel_, frame));
    }

    // Calls visit(frame, from, to, share) for each frame between two neighbouring keys, and for the keys themselves.
    template <class Visit>
    void overSpans(const std::vector<int>& keys, const Visit& visit) const {
        for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
            for (int frame = keys[i]; frame < keys[i + 1]; ++frame) {
                visit(frame, keys[i], keys[i + 1],
                      static_cast<float>(frame - keys[i]) / static_cast<float>(keys[i + 1] - keys[i]));
            }
        }
        visit(keys.back(), keys.back(), keys.back(), 0.0F);
    }

    // In tolerances: above 1 it is too far off, or its skin is.
    [[nodiscard]] float errorOf(int frame, std::size_t joint) const {
        const RigidTransform& wanted = of(model_, frame, joint);
        const RigidTransform& got = of(blendedModel_, frame, joint);
        const float angle = angleBetween(wanted.rotation, got.rotation);
        const float moved = glm::distance(wanted.translation, got.translation) + angle * reach_[joint];
        return std::max(moved / tolerance_.metres, angle / tolerance_.radians);
    }

    // At the worst frame of every run of frames where a joint is too far off.
    bool addKeys() {
        bool added = false;
        for (std::size_t joint = 0; joint < joints_; ++joint) {
            int worst = -1;
            float most = 1.0F;
            for (int frame = 0; frame <= frames_; ++frame) {
                const float error = frame < frames_ ? errorOf(frame, joint) : 0.0F;
                if (error > most) {
                    most = error;
                    worst = frame;
                } else if (error <= 1.0F && worst >= 0) {
                    added = mend(worst, joint) || added;
                    worst = -1;
                    most = 1.0F;
                }
            }
        }
        return added;
    }

    // Keys for the channels between the root and the joint that put it off most.
    bool mend(int frame, std::size_t joint) {
        float most = 0.0F;
        for (int at = static_cast<int>(joint); at != kNoJoint; at = skeleton_.parents[at])
            most = std::max({most, turned(frame, at, joint), moved(frame, at)});
        bool added = false;
        for (int at = static_cast<int>(joint); most > 0.0F && at != kNoJoint; at = skeleton_.parents[at]) {
            const auto channel = static_cast<std::size_t>(at);
            if (turned(frame, at, joint) >= kAlsoMended * most) added = add(keys_.rotations[channel], frame) || added;
            if (moved(frame, at) >= kAlsoMended * most) added = add(keys_.translations[channel], frame) || added;
        }
        return added;
    }

    // What the rotation of a joint above puts it off, in tolerances: by the angle, and by its lever.
    [[nodiscard]] float turned(int frame, int above, std::size_t joint) const {
        const auto a = static_cast<std::size_t>(above);
        const float angle = angleBetween(of(local_, frame, a).rotation, of(blended_, frame, a).rotation);
        const float lever =
            reach_[joint] + glm::distance(of(model_, frame, a).translation, of(model_, frame, joint).translation);
        return std::max(angle / tolerance_.radians, angle * lever / tolerance_.metres);
    }
    [[nodiscard]] float moved(int frame, int above) const {
        const auto a = static_cast<std::size_t>(above);
        return glm::distance(of(local_, frame, a).translation, of(blended_, frame, a).translation) / tolerance_.metres;
    }

    static bool add(std::vector<int>& keys, int frame) {
        const auto place = std::lower_bound(keys.begin(), keys.end(), frame);
        if (place != keys.end() && *place == frame) return false;
        keys.insert(place, frame);
        return true;
    }

    const Skeleton& skeleton_;
    std::vector<float> reach_;
    std::size_t joints_;
    int frames_;
    KeyTolerance tolerance_;
    Frames local_;
    Frames model_;
    Frames blended_;
    Frames blendedModel_;
    KeptKeys keys_;
};

}  // namespace

std::vector<float> skinReach(const Character& character) {
    constexpr float kLeastWeight = 0.01F;
    const std::vector<RigidTransform>& bind = character.skeleton.bindModelFromJoint;
    std::vector<float> reach(bind.size(), 0.0F);
    for (const SkinnedMesh& mesh : character.meshes) {
        for (std::size_t v = 0; v < mesh.weights.size(); ++v) {
            for (std::size_t i = 0; i < mesh.weights[v].size(); ++i) {
                if (mesh.weights[v][i] < kLeastWeight) continue;
                float& farthest = reach[mesh.joints[v][i]];
                farthest = std::max(farthest, glm::distance(mesh.positions[v], bind[mesh.joints[v][i]].translation));
            }
        }
    }
    return reach;
}

KeptKeys reduceKeys(const Skeleton& skeleton, const Clip& clip, const KeyTolerance& tolerance,
                    std::span<const float> reach) {
    LUTKA_ASSERT(reach.empty() || reach.size() == skeleton.parents.size());
    LUTKA_ASSERT(tolerance.metres > 0.0F && tolerance.radians > 0.0F);
    LUTKA_ASSERT(clip.parentFromJoint.size() == skeleton.parents.size() * static_cast<std::size_t>(clip.frameCount));
    return Reducer(skeleton, clip, tolerance, reach).run();
}

KeptKeys allKeys(const Skeleton& skeleton, const Clip& clip) {
    std::vector<int> frames(static_cast<std::size_t>(clip.frameCount));
    std::iota(frames.begin(), frames.end(), 0);
    const std::vector<std::vector<int>> all(skeleton.parents.size(), frames);
    return {all, all};
}

}  // namespace lutka::animation
