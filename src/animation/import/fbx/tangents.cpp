#include "animation/import/fbx/tangents.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace lutka::animation::rig_import::fbx {
namespace {

using Key = Curve::Key;
using Interpolation = Curve::Interpolation;

// The neighbours of a key; the key itself where there is none.
struct Neighbours {
    const Key& before;
    const Key& key;
    const Key& after;
};

double slope(const Key& from, const Key& to) {
    return to.seconds > from.seconds ? (to.value - from.value) / (to.seconds - from.seconds) : 0.0;
}

// The automatic tangent between two neighbours, as Maya and MotionBuilder make it: half the slope between them, half
// the mean of the slopes on both sides; `bias` (percent) pulls it to one side.
double autoSlope(const Neighbours& n, std::uint32_t flags, double bias) {
    const double left = slope(n.before, n.key);
    const double right = slope(n.key, n.after);
    const bool first = !(n.key.seconds > n.before.seconds);
    const bool last = !(n.after.seconds > n.key.seconds);
    const double nearest = std::min(first ? HUGE_VAL : std::abs(n.before.value - n.key.value),
                                    last ? HUGE_VAL : std::abs(n.after.value - n.key.value));
    if ((flags & kClamp) != 0U && nearest <= 1e-6) return 0.0;
    if (first || last) return (flags & kClampProgressive) != 0U ? 0.0 : (first ? right : left);
    double out = slope(n.before, n.after);
    if ((flags & kTimeIndependent) == 0U) {
        const double share = (n.key.seconds - n.before.seconds) / (n.after.seconds - n.before.seconds);
        out = 0.5 * out + 0.5 * (left * (1.0 - share) + right * share);
        const double pull = std::abs(bias) / 100.0;
        const double target = bias > 0.0 ? right : left;
        const double towards = std::abs(target - out) > 1e-5 ? target - out : bias;
        if (pull > 1e-4) out = out * (1.0 - pull) + target * pull;
        // Beyond 500 % it is added to whatever the slopes are.
        if (pull > 5.0) out += (pull - 5.0) * (pull - 5.0) * std::copysign(40.0, towards);
    }
    if ((flags & kClampProgressive) != 0U) {
        // No overshooting beyond either neighbour: the tangents' ends stay between the values.
        const double sign = out >= 0.0 ? 1.0 : -1.0;
        const double limitLeft = std::max(0.0, sign * left / std::max(n.key.weightLeft, 1e-9));
        const double limitRight = std::max(0.0, sign * right / std::max(n.key.weightRight, 1e-9));
        out = sign * std::min({sign * out, limitLeft, limitRight});
    }
    return out;
}

// Kochanek and Bartels 1984.
void setTcb(const Neighbours& n, const std::array<float, 4>& numbers, Key& key) {
    const double tension = numbers[0];
    const double continuity = numbers[1];
    const double bias = numbers[2];
    const double left = slope(n.before, n.key);
    const double right = slope(n.key, n.after);
    const bool edge = !(n.key.seconds > n.before.seconds) || !(n.after.seconds > n.key.seconds);
    const double factor = (edge ? 1.0 : 0.5) * (1.0 - tension);
    key.slopeLeft = factor * ((1.0 + bias) * (1.0 - continuity) * left + (1.0 - bias) * (1.0 + continuity) * right);
    key.slopeRight = factor * ((1.0 + bias) * (1.0 + continuity) * left + (1.0 - bias) * (1.0 - continuity) * right);
}

Interpolation interpolationOf(std::uint32_t flags) {
    if ((flags & kConstant) != 0U)
        return (flags & kConstantNext) != 0U ? Interpolation::constantNext : Interpolation::constant;
    return (flags & kCubic) != 0U ? Interpolation::cubic : Interpolation::linear;
}

}  // namespace

float packedWeights(double right, double nextLeft) {
    const auto share = [](double weight) { return static_cast<std::uint32_t>(std::clamp(weight, 0.0, 1.0) * 1e4); };
    return std::bit_cast<float>(share(right) | share(nextLeft) << 16U);
}

void sortKeys(std::vector<Curve::Key>& keys, std::vector<KeyData>& data) {
    const auto earlier = [&](std::size_t a, std::size_t b) { return keys[a].seconds < keys[b].seconds; };
    std::vector<std::size_t> order(keys.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto isNoTime = [](const Curve::Key& key) { return std::isnan(key.seconds); };
    if (std::is_sorted(order.begin(), order.end(), earlier) || std::any_of(keys.begin(), keys.end(), isNoTime)) return;
    std::stable_sort(order.begin(), order.end(), earlier);
    const std::vector<Curve::Key> oldKeys = keys;
    const std::vector<KeyData> oldData = data;
    for (std::size_t i = 0; i < order.size(); ++i) {
        keys[i] = oldKeys[order[i]];
        data[i] = oldData[order[i]];
    }
}

void setTangents(std::vector<Key>& keys, const std::vector<KeyData>& data) {
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const std::uint32_t flags = data[i].flags;
        keys[i].interpolation = interpolationOf(flags);
        const auto packed = std::bit_cast<std::uint32_t>(data[i].numbers[2]);
        const bool cubic = keys[i].interpolation == Interpolation::cubic && (flags & kTcb) == 0U;
        // Weights are two shares in units of 1/10,000, packed into one number.
        if (cubic && (flags & kWeightedRight) != 0U) keys[i].weightRight = std::min(1.0, (packed & 0xFFFFU) * 1e-4);
        if (i + 1 == keys.size()) break;
        if (cubic && (flags & kWeightedNextLeft) != 0U) keys[i + 1].weightLeft = std::min(1.0, (packed >> 16U) * 1e-4);
    }
    for (std::size_t i = 0; i < keys.size(); ++i) {
        Key& key = keys[i];
        const Neighbours n{keys[i > 0 ? i - 1 : 0], key, keys[std::min(i + 1, keys.size() - 1)]};
        const double arriving = i > 0 ? static_cast<double>(data[i - 1].numbers[1]) : 0.0;
        const double leaving = data[i].numbers[0];
        const bool previousCubic = i > 0 && keys[i - 1].interpolation == Interpolation::cubic;
        key.slopeLeft = previousCubic ? arriving : slope(n.before, key);
        key.slopeRight = leaving;
        if (key.interpolation != Interpolation::cubic) continue;
        const std::uint32_t flags = data[i].flags;
        if ((flags & kTcb) != 0U) {
            setTcb(n, data[i].numbers, key);
        } else if ((flags & kUser) == 0U) {
            // The slots hold the bias on each side, zero as a rule.
            key.slopeLeft = autoSlope(n, flags, -arriving);
            key.slopeRight = autoSlope(n, flags, leaving);
        }
    }
}

}  // namespace lutka::animation::rig_import::fbx
