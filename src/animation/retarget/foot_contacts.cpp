#include "animation/retarget/foot_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace lutka::animation {
namespace {

// Metres a second, over the two neighbours.
float speedAt(const std::vector<vec3>& points, int frame, float framesPerSecond) {
    const int last = static_cast<int>(points.size()) - 1;
    const int before = std::max(frame - 1, 0);
    const int after = std::min(frame + 1, last);
    if (after == before) return 0.0F;
    return glm::distance(points[before], points[after]) * framesPerSecond / static_cast<float>(after - before);
}

// Short runs of the opposite become `value`; those at the ends of the clip may go on beyond it.
void setShortRuns(std::vector<bool>& flags, bool value, int frames) {
    std::vector<bool> other = flags;
    if (value) other.flip();
    for (const FrameRun& run : runsOf(other)) {
        const bool atEnd = run.first == 0 || run.last + 1 == static_cast<int>(flags.size());
        if (run.last - run.first + 1 >= frames || atEnd) continue;
        std::fill(flags.begin() + run.first, flags.begin() + run.last + 1, value);
    }
}

std::vector<bool> standingFrames(const std::vector<vec3>& points, float mostHeight, float mostSpeed,
                                 float framesPerSecond, float leastSeconds) {
    std::vector<bool> flags(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const bool low = points[i].y < mostHeight;
        flags[i] = low && speedAt(points, static_cast<int>(i), framesPerSecond) < mostSpeed;
    }
    const int frames = static_cast<int>(std::lround(leastSeconds * framesPerSecond));
    setShortRuns(flags, true, frames);
    setShortRuns(flags, false, frames);
    return flags;
}

}  // namespace

std::vector<FrameRun> runsOf(const std::vector<bool>& flags) {
    std::vector<FrameRun> runs;
    for (int i = 0; i < static_cast<int>(flags.size()); ++i) {
        if (!flags[i]) continue;
        if (!runs.empty() && runs.back().last + 1 == i)
            runs.back().last = i;
        else
            runs.push_back({i, i});
    }
    return runs;
}

float floorOfMotion(const AnatomicalRig& rig, std::span<const FootTrack, 2> tracks) {
    std::vector<float> lows;
    for (std::size_t frame = 0; frame < tracks[0].ankle.size(); ++frame) {
        float low = HUGE_VALF;
        for (std::size_t side = 0; side < 2; ++side) {
            low = std::min({low, tracks[side].ankle[frame].y - rig.feet[side].ankleHeight,
                            tracks[side].ball[frame].y - rig.feet[side].ballHeight});
        }
        lows.push_back(low);
    }
    if (lows.empty()) return 0.0F;
    const auto twentieth = lows.begin() + static_cast<long>(lows.size() / 20);
    std::nth_element(lows.begin(), twentieth, lows.end());
    return *twentieth;
}

std::optional<float> standingHeight(const AnatomicalRig& rig, std::span<const FootTrack, 2> tracks,
                                    std::span<const FootContact, 2> contacts) {
    std::vector<float> heights;
    for (std::size_t side = 0; side < 2; ++side) {
        for (std::size_t frame = 0; frame < tracks[side].ball.size(); ++frame) {
            if (contacts[side].ball[frame]) heights.push_back(tracks[side].ball[frame].y - rig.feet[side].ballHeight);
        }
    }
    if (heights.empty()) return std::nullopt;
    const auto middle = heights.begin() + static_cast<long>(heights.size() / 2);
    std::nth_element(heights.begin(), middle, heights.end());
    return *middle;
}

FootContact contactsOf(const AnatomicalRig::Foot& foot, const FootTrack& track, float floor, float legLength,
                       float framesPerSecond, const ContactSettings& settings) {
    const float slow = settings.mostSpeed * legLength;
    const float low = floor + settings.mostHeight * legLength;
    FootContact contact;
    contact.heel = standingFrames(track.ankle, low + foot.ankleHeight, slow, framesPerSecond, settings.leastSeconds);
    contact.ball = standingFrames(track.ball, low + foot.ballHeight, slow, framesPerSecond, settings.leastSeconds);
    return contact;
}

}  // namespace lutka::animation
