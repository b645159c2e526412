#include "animation/import/channel_values.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>

namespace lutka::animation::rig_import {
namespace {

int widthOf(SourceChannel::Path path) {
    return path == SourceChannel::Path::rotation ? 4 : 3;
}

dvec4 numbersAt(const SourceChannel& channel, std::size_t index) {
    const int width = widthOf(channel.path);
    dvec4 out(0.0);
    for (int i = 0; i < width; ++i)
        out[i] =
            static_cast<double>(channel.values[index * static_cast<std::size_t>(width) + static_cast<std::size_t>(i)]);
    return out;
}

// Along the shorter arc (Shoemake 1985).
dvec4 slerp(const dvec4& a, const dvec4& b, double alpha) {
    const glm::dquat from = glm::normalize(glm::dquat(a.w, a.x, a.y, a.z));
    const glm::dquat to = glm::normalize(glm::dquat(b.w, b.x, b.y, b.z));
    const glm::dquat q = glm::slerp(from, to, alpha);
    return {q.x, q.y, q.z, q.w};
}

// glTF 2.0, appendix C: a cubic Hermite spline whose tangents are scaled by the keys' distance.
dvec4 hermite(const SourceChannel& channel, std::size_t before, double span, double alpha) {
    const dvec4 outTangent = span * numbersAt(channel, 3 * before + 2);
    const dvec4 inTangent = span * numbersAt(channel, 3 * before + 3);
    const double t2 = alpha * alpha;
    const double t3 = t2 * alpha;
    return (2.0 * t3 - 3.0 * t2 + 1.0) * keyAt(channel, before) + (t3 - 2.0 * t2 + alpha) * outTangent +
           (3.0 * t2 - 2.0 * t3) * keyAt(channel, before + 1) + (t3 - t2) * inTangent;
}

}  // namespace

dvec4 keyAt(const SourceChannel& channel, std::size_t key) {
    const bool spline = channel.interpolation == SourceChannel::Interpolation::cubicSpline;
    return numbersAt(channel, spline ? 3 * key + 1 : key);
}

dvec4 valueAt(const SourceChannel& channel, double time) {
    const std::vector<double>& times = channel.times;
    // A frame that misses its key by rounding alone shows that key.
    constexpr double kRounding = 1e-5;
    const auto after = std::upper_bound(times.begin(), times.end(), time + kRounding);
    if (after == times.begin()) return keyAt(channel, 0);
    const auto before = static_cast<std::size_t>(after - times.begin()) - 1;
    const double span = after == times.end() ? 0.0 : *after - times[before];
    if (!(span > 0.0) || channel.interpolation == SourceChannel::Interpolation::step) return keyAt(channel, before);
    const double alpha = std::clamp((time - times[before]) / span, 0.0, 1.0);
    if (channel.interpolation == SourceChannel::Interpolation::cubicSpline)
        return hermite(channel, before, span, alpha);
    const dvec4 a = keyAt(channel, before);
    const dvec4 b = keyAt(channel, before + 1);
    return channel.path == SourceChannel::Path::rotation ? slerp(a, b, alpha) : glm::mix(a, b, alpha);
}

SourceClip cutClip(const SourceClip& clip, double start, double end) {
    SourceClip out;
    out.name = clip.name;
    for (const SourceChannel& channel : clip.channels) {
        SourceChannel part{channel.node, channel.path, channel.interpolation, {}, {}};
        const auto put = [&](double time, const dvec4& value) {
            part.times.push_back(time - start);
            for (int i = 0; i < widthOf(channel.path); ++i)
                part.values.push_back(static_cast<float>(value[i]));
        };
        put(start, valueAt(channel, start));
        for (std::size_t key = 0; key < channel.times.size(); ++key) {
            if (channel.times[key] > start && channel.times[key] < end) put(channel.times[key], keyAt(channel, key));
        }
        if (channel.times.size() > 1) put(end, valueAt(channel, end));
        out.channels.push_back(std::move(part));
    }
    return out;
}

}  // namespace lutka::animation::rig_import
