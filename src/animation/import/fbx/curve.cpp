#include "animation/import/fbx/curve.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "animation/import/fbx/tangents.hpp"

namespace lutka::animation::rig_import::fbx {
namespace {

constexpr double kSameTime = 1e-7;  // seconds

using Key = Curve::Key;
using Interpolation = Curve::Interpolation;

// A cubic Bezier's coordinate; the ends are 0 and 1.
double bezier(double a, double b, double t) {
    const double u = 1.0 - t;
    return 3.0 * u * u * t * a + 3.0 * u * t * t * b + t * t * t;
}

// The Bezier's slope over its parameter.
double bezierSlope(double a, double b, double t) {
    const double u = 1.0 - t;
    return 3.0 * u * u * a + 6.0 * u * t * (b - a) + 3.0 * t * t * (1.0 - b);
}

// The parameter at which the Bezier's first coordinate is x; it grows with the parameter for a, 1 - b in [0, 1].
// Newton's steps inside a shrinking bracket, halved where a step would leave it.
double parameterAt(double x, double a, double b) {
    constexpr int kMostSteps = 60;
    constexpr double kExact = 1e-15;
    if (std::abs(a - 1.0 / 3.0) < 1e-6 && std::abs(b - 2.0 / 3.0) < 1e-6) return x;
    double low = 0.0;
    double high = 1.0;
    double t = x;
    for (int i = 0; i < kMostSteps && high - low > kExact; ++i) {
        const double error = bezier(a, b, t) - x;
        if (std::abs(error) <= kExact) break;
        (error < 0.0 ? low : high) = t;
        const double slope = bezierSlope(a, b, t);
        const double next = slope > 0.0 ? t - error / slope : low;
        t = next > low && next < high ? next : 0.5 * (low + high);
    }
    return t;
}

double between(const Key& from, const Key& to, double seconds) {
    const double span = to.seconds - from.seconds;
    const double x = (seconds - from.seconds) / span;
    switch (from.interpolation) {
        case Interpolation::constant:
            return from.value;
        case Interpolation::constantNext:
            return to.value;
        case Interpolation::linear:
            return from.value + x * (to.value - from.value);
        case Interpolation::cubic:
            break;
    }
    const double t = parameterAt(x, from.weightRight, 1.0 - to.weightLeft);
    const double u = 1.0 - t;
    const double leaving = from.value + from.slopeRight * from.weightRight * span;
    const double arriving = to.value - to.slopeLeft * to.weightLeft * span;
    return u * u * u * from.value + 3.0 * u * u * t * leaving + 3.0 * u * t * t * arriving + t * t * t * to.value;
}

// ASCII documents write the numbers of key attributes as the integers that share their bits. Nothing else is so large.
float keyNumber(double written) {
    constexpr double kLeastBits = 4'194'304.0;
    const bool isBits =
        std::abs(written) >= kLeastBits && std::abs(written) < 4'294'967'296.0 && written == std::floor(written);
    return isBits ? std::bit_cast<float>(static_cast<std::uint32_t>(static_cast<std::int64_t>(written)))
                  : static_cast<float>(written);
}

}  // namespace

Curve::Curve(const std::vector<Key>& keys, const Beyond& before, const Beyond& after) : before_(before), after_(after) {
    for (const Key& key : keys) {
        const bool usable = std::isfinite(key.seconds) && std::isfinite(key.value) && std::isfinite(key.slopeLeft) &&
                            std::isfinite(key.slopeRight);
        if (usable && (keys_.empty() || key.seconds > keys_.back().seconds)) keys_.push_back(key);
    }
}

double Curve::at(double seconds) const {
    if (keys_.size() < 2) return keys_.empty() ? 0.0 : keys_.front().value;
    const bool inside = seconds >= keys_.front().seconds && seconds <= keys_.back().seconds;
    return inside ? within(seconds) : beyond(seconds);
}

double Curve::beyond(double seconds) const {
    const Key& first = keys_.front();
    const Key& last = keys_.back();
    const bool early = seconds < first.seconds;
    const Key& end = early ? first : last;
    const Beyond& how = early ? before_ : after_;
    const double away = std::abs(seconds - end.seconds);
    const double length = last.seconds - first.seconds;
    if (how.kind == Beyond::Kind::hold || how.times == 0) return end.value;
    if (how.kind == Beyond::Kind::slope)
        return end.value + (early ? first.slopeRight : last.slopeLeft) * (seconds - end.seconds);
    double round = std::floor(away / length + 1e-9);
    double into = std::clamp(away - round * length, 0.0, length);
    if (how.times > 0 && round >= static_cast<double>(how.times)) {
        round = static_cast<double>(how.times) - 1.0;
        into = length;
    }
    const bool backwards = how.kind == Beyond::Kind::mirror && std::fmod(round, 2.0) < 0.5;
    const double value = within(backwards == early ? first.seconds + into : last.seconds - into);
    if (how.kind != Beyond::Kind::repeatOnwards) return value;
    return value + (early ? -1.0 : 1.0) * (round + 1.0) * (last.value - first.value);
}

double Curve::within(double seconds) const {
    // A frame that misses a key by rounding only is on it: a step must not come a frame late.
    const auto after = std::upper_bound(keys_.begin(), keys_.end(), seconds + kSameTime,
                                        [](double time, const Key& key) { return time < key.seconds; });
    if (after == keys_.begin()) return keys_.empty() ? 0.0 : keys_.front().value;
    const Key& before = *std::prev(after);
    return after == keys_.end() || std::abs(seconds - before.seconds) <= kSameTime ? before.value
                                                                                   : between(before, *after, seconds);
}

bool Curve::moves() const {
    return std::any_of(keys_.begin(), keys_.end(), [this](const Key& key) {
        return key.value != keys_.front().value ||
               (key.interpolation == Interpolation::cubic && (key.slopeLeft != 0.0 || key.slopeRight != 0.0));
    });
}

Curve::Beyond readBeyond(const Record& curve, std::string_view side) {
    Curve::Beyond out;
    const Record* stated = curve.child(side);
    const Record* type = stated != nullptr ? stated->child("Type") : nullptr;
    if (type == nullptr) return out;
    const std::string_view word = type->text(0);
    const char letter = word.empty() ? static_cast<char>(type->integer(0)) : word[0];
    if (letter == 'K') out.kind = Curve::Beyond::Kind::slope;
    if (letter == 'R') out.kind = Curve::Beyond::Kind::repeat;
    if (letter == 'M') out.kind = Curve::Beyond::Kind::mirror;
    if (letter == 'A') out.kind = Curve::Beyond::Kind::repeatOnwards;
    if (const Record* times = stated->child("Repetition"); times != nullptr) out.times = times->integer(0, -1);
    return out;
}

std::optional<Curve> readCurve(const Record& record, double ticksPerSecond) {
    const std::vector<double> times = record.numbersOf("KeyTime");
    const std::vector<double> values = record.numbersOf("KeyValueFloat");
    const std::vector<double> flags = record.numbersOf("KeyAttrFlags");
    const std::vector<double> numbers = record.numbersOf("KeyAttrDataFloat");
    const std::vector<double> counts = record.numbersOf("KeyAttrRefCount");
    const std::size_t size = std::min(times.size(), values.size());
    if (size == 0) return std::nullopt;
    std::vector<Key> keys(size);
    std::vector<KeyData> data(size);
    std::size_t attribute = 0;
    double left = counts.empty() ? 1e18 : counts[0];  // keys that the attribute is still for
    for (std::size_t i = 0; i < size; ++i) {
        keys[i].seconds = times[i] / ticksPerSecond;
        keys[i].value = values[i];
        while (left < 1.0 && attribute + 1 < counts.size())
            left = counts[++attribute];
        left -= 1.0;
        if (attribute < flags.size() && std::abs(flags[attribute]) < 4e9)
            data[i].flags = static_cast<std::uint32_t>(static_cast<std::int64_t>(flags[attribute]));
        for (std::size_t n = 0; n < 4 && 4 * attribute + n < numbers.size(); ++n)
            data[i].numbers[n] = keyNumber(numbers[4 * attribute + n]);
    }
    sortKeys(keys, data);
    setTangents(keys, data);
    return Curve(keys, readBeyond(record, "Pre-Extrapolation"), readBeyond(record, "Post-Extrapolation"));
}

}  // namespace lutka::animation::rig_import::fbx
