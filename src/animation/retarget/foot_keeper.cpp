#include "animation/retarget/foot_keeper.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

namespace lutka::animation {
namespace {

constexpr float kStraight = 0.9992F;  // of a leg's reach, which it is not stretched beyond: a knee bent by 4.6 degrees
constexpr float kDropSeconds = 0.1F;  // how far to either side a drop of the hips is spread

constexpr float kMostMove = 0.25F;           // leg lengths that the hips are moved by
constexpr float kMostTurn = radians(45.0F);  // that they are turned by
constexpr float kAllExcess = 0.3F;           // of excess width, from which on they are turned by all that feet need

// A stretch of frames in which one point of the foot stands.
struct Stand {
    FrameRun run;
    bool ball = false;
};

// The ball goes before the heel: it stands longer and, while both do, does the same.
std::vector<Stand> standsOf(const FootContact& contact) {
    std::vector<Stand> stands;
    for (int frame = 0; frame < static_cast<int>(contact.ball.size()); ++frame) {
        if (!contact.ball[frame] && !contact.heel[frame]) continue;
        const bool ball = contact.ball[frame];
        if (!stands.empty() && stands.back().run.last + 1 == frame && stands.back().ball == ball)
            stands.back().run.last = frame;
        else
            stands.push_back({{frame, frame}, ball});
    }
    return stands;
}

/// Shifts of one foot.
class Keeper {
  public:
    Keeper(const AnatomicalRig::Foot& foot, const FootTrack& track, float floor)
        : foot_(foot), track_(track), floor_(floor), shifts_(track.ankle.size()) {}

    void hold(const std::vector<Stand>& stands) {
        for (std::size_t first = 0; first < stands.size();) {
            std::size_t end = first + 1;
            while (end < stands.size() && stands[end].run.first == stands[end - 1].run.last + 1)
                ++end;
            holdGroup(std::span(stands).subspan(first, end - first));
            first = end;
        }
    }

    // Between contacts each end's shift dies away.
    std::vector<vec3> blended(int frames) const {
        std::vector<vec3> out(shifts_.size(), vec3(0));
        const int count = static_cast<int>(out.size());
        int before = -1;  // the last frame that is held
        for (int frame = 0; frame < count; ++frame) {
            if (shifts_[frame]) {
                out[frame] = *shifts_[frame];
                before = frame;
                continue;
            }
            int after = frame;
            while (after < count && !shifts_[after])
                ++after;
            const int room = before >= 0 && after < count ? (after - before) / 2 : frames;
            const int reach = std::max(std::min(frames, room), 1);
            if (before >= 0) out[frame] += *shifts_[before] * fade(frame - before, reach);
            if (after < count) out[frame] += *shifts_[after] * fade(after - frame, reach);
        }
        return out;
    }

  private:
    static float fade(int distance, int reach) {
        const float t = std::clamp(1.0F - static_cast<float>(distance) / static_cast<float>(reach + 1), 0.0F, 1.0F);
        return t * t * (3.0F - 2.0F * t);
    }
    [[nodiscard]] const vec3& pointAt(const Stand& stand, int frame) const {
        return stand.ball ? track_.ball[frame] : track_.ankle[frame];
    }
    void pin(const Stand& stand, const vec3& place) {
        for (int frame = stand.run.first; frame <= stand.run.last; ++frame)
            shifts_[frame] = place - pointAt(stand, frame);
    }
    // The longest stand decides where; its neighbours begin where it leaves the foot.
    void holdGroup(std::span<const Stand> group) {
        std::size_t longest = 0;
        for (std::size_t i = 0; i < group.size(); ++i) {
            const auto length = [&](std::size_t at) { return group[at].run.last - group[at].run.first; };
            if (length(i) > length(longest)) longest = i;
        }
        vec3 sum(0);
        const Stand& main = group[longest];
        for (int frame = main.run.first; frame <= main.run.last; ++frame)
            sum += pointAt(main, frame);
        vec3 place = sum / static_cast<float>(main.run.last - main.run.first + 1);
        place.y = floor_ + (main.ball ? foot_.ballHeight : foot_.ankleHeight);
        pin(main, place);
        for (std::size_t i = longest; i-- > 0;)
            pin(group[i], pointAt(group[i], group[i].run.last) + *shifts_[group[i].run.last + 1]);
        for (std::size_t i = longest + 1; i < group.size(); ++i)
            pin(group[i], pointAt(group[i], group[i].run.first) + *shifts_[group[i].run.first - 1]);
    }

    const AnatomicalRig::Foot& foot_;
    const FootTrack& track_;
    float floor_;
    std::vector<std::optional<vec3>> shifts_;
};

std::vector<float> mostOfNeighbours(const std::vector<float>& values, int reach) {
    const int count = static_cast<int>(values.size());
    std::vector<float> most(values.size());
    for (int i = 0; i < count; ++i) {
        for (int j = std::max(i - reach, 0); j <= std::min(i + reach, count - 1); ++j)
            most[i] = std::max(most[i], values[j]);
    }
    return most;
}

template <typename Value>
std::vector<Value> meanOfNeighbours(const std::vector<Value>& values, int reach) {
    const int count = static_cast<int>(values.size());
    std::vector<Value> out(values.size());
    for (int i = 0; i < count; ++i) {
        Value sum(0);
        for (int j = i - reach; j <= i + reach; ++j)
            sum += values[std::clamp(j, 0, count - 1)];
        out[i] = sum / static_cast<float>(2 * reach + 1);
    }
    return out;
}

// How far the hips must come down for the leg to reach the ankle.
float dropFor(const vec3& hip, const vec3& ankle, float reach) {
    const float across = std::hypot(ankle.x - hip.x, ankle.z - hip.z);
    const float rise = std::sqrt(std::max(reach * reach - across * across, 0.0F));
    return std::max(hip.y - (ankle.y + rise), 0.0F);
}

/// What the feet that stand need of the hips' place, frame by frame.
class HipsPlace {
  public:
    explicit HipsPlace(std::size_t frames) : sums_(frames, vec3(0)), counts_(frames, 0) {}

    void add(std::size_t frame, const vec3& shift) {
        sums_[frame] += shift;
        ++counts_[frame];
    }

    // The mean of those that stand, no farther than `most`; in between on a straight way from one to the next.
    [[nodiscard]] std::vector<vec3> smoothed(int reach, float most) const {
        const int count = static_cast<int>(sums_.size());
        std::vector<vec3> shifts(sums_.size(), vec3(0));
        int before = -1;
        for (int frame = 0; frame < count; ++frame) {
            if (counts_[frame] == 0) continue;
            const vec3 mean = sums_[frame] / static_cast<float>(counts_[frame]);
            shifts[frame] = mean * std::min(1.0F, most / std::max(glm::length(mean), 1e-9F));
            for (int between = before + 1; between < frame; ++between) {
                const float share =
                    before < 0 ? 1.0F : static_cast<float>(between - before) / static_cast<float>(frame - before);
                shifts[between] = (before < 0 ? vec3(0) : shifts[before] * (1.0F - share)) + shifts[frame] * share;
            }
            before = frame;
        }
        for (int frame = before + 1; before >= 0 && frame < count; ++frame)
            shifts[frame] = shifts[before];
        return meanOfNeighbours(meanOfNeighbours(shifts, reach), reach);
    }

  private:
    std::vector<vec3> sums_;
    std::vector<int> counts_;
};

bool stands(const FootContact& contact, std::size_t frame) {
    return contact.heel[frame] || contact.ball[frame];
}

// What the feet are to be moved by where the hips stay.
std::vector<FootShift> shiftsOfFeet(const AnatomicalRig& target, const FootMotion& motion,
                                    const std::array<FootContact, 2>& contacts, float framesPerSecond,
                                    float blendSeconds) {
    const std::size_t frames = motion.tracks[0].ankle.size();
    std::vector<FootShift> shifts(frames);
    const int blend = static_cast<int>(std::lround(blendSeconds * framesPerSecond));
    for (std::size_t side = 0; side < 2; ++side) {
        const AnatomicalRig::Foot& foot = target.feet[side];
        const FootTrack& track = motion.tracks[side];
        Keeper keeper(foot, track, target.floor);
        keeper.hold(standsOf(contacts[side]));
        const std::vector<vec3> moved = keeper.blended(blend);
        for (std::size_t frame = 0; frame < frames; ++frame) {
            vec3& shift = shifts[frame].feet[side];
            shift = moved[frame];
            const float depth = depthOf(foot, track.ankle[frame] + shift, track.ball[frame] + shift,
                                        motion.up[side][frame], target.floor);
            shift.y += std::max(depth, 0.0F);
        }
    }
    return shifts;
}

int spreadOf(float framesPerSecond) {
    return std::max(static_cast<int>(kDropSeconds * framesPerSecond), 1);
}

}  // namespace

float depthOf(const AnatomicalRig::Foot& foot, const vec3& ankle, const vec3& ball, const vec3& up, float floor) {
    const float heel = ankle.y - foot.ankleHeight * up.y;
    const float front = ball.y - foot.ballHeight * up.y;
    return floor - std::min(heel, front);
}

std::vector<vec3> hipsTurns(const AnatomicalRig& target, const FootMotion& motion,
                            const std::array<FootContact, 2>& contacts, float excessWidth, float framesPerSecond,
                            float blendSeconds) {
    const std::vector<FootShift> shifts = shiftsOfFeet(target, motion, contacts, framesPerSecond, blendSeconds);
    const float share = std::clamp(excessWidth / kAllExcess, 0.0F, 1.0F);
    HipsPlace turns(shifts.size());
    for (std::size_t frame = 0; frame < shifts.size(); ++frame) {
        if (!stands(contacts[0], frame) || !stands(contacts[1], frame)) continue;
        const vec3 line = motion.hips[0][frame] - motion.hips[1][frame];
        const vec3 wanted = line + shifts[frame].feet[0] - shifts[frame].feet[1];
        if (glm::length(line) < 1e-6F || glm::length(wanted) < 1e-6F) continue;
        turns.add(frame, share * rotationVector(rotationBetween(line, wanted)));
    }
    return turns.smoothed(spreadOf(framesPerSecond), kMostTurn);
}

std::vector<FootShift> keepFeet(const AnatomicalRig& target, const FootMotion& motion,
                                const std::array<FootContact, 2>& contacts, float framesPerSecond, float blendSeconds) {
    std::vector<FootShift> shifts = shiftsOfFeet(target, motion, contacts, framesPerSecond, blendSeconds);
    const std::size_t frames = shifts.size();
    const int reach = spreadOf(framesPerSecond);
    HipsPlace place(frames);
    for (std::size_t frame = 0; frame < frames; ++frame)
        for (std::size_t side = 0; side < 2; ++side)
            if (stands(contacts[side], frame)) place.add(frame, shifts[frame].feet[side]);
    // Hips and feet moved together leave the legs as they are.
    const std::vector<vec3> moves = place.smoothed(reach, kMostMove * target.legLength);
    std::vector<float> drops(frames, 0.0F);
    for (std::size_t frame = 0; frame < frames; ++frame) {
        for (std::size_t side = 0; side < 2; ++side) {
            if (!stands(contacts[side], frame)) continue;
            const vec3 hip = motion.hips[side][frame] + moves[frame];
            const vec3 ankle = motion.tracks[side].ankle[frame] + shifts[frame].feet[side];
            drops[frame] = std::max(drops[frame], dropFor(hip, ankle, motion.legReach[side] * kStraight));
        }
    }
    const std::vector<float> smooth = meanOfNeighbours(mostOfNeighbours(drops, reach), reach);
    for (std::size_t frame = 0; frame < frames; ++frame) {
        shifts[frame].hips = moves[frame] - vec3(0, smooth[frame], 0);
        for (vec3& foot : shifts[frame].feet)
            foot -= shifts[frame].hips;
    }
    return shifts;
}

}  // namespace lutka::animation
