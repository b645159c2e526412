#include "animation/import/fbx/curve.hpp"

#include <algorithm>
#include <cmath>

#include "animation/import/fbx/tangents.hpp"

namespace lutka::animation::rig_import::fbx {
namespace {

using Key = Curve::Key;
using Interpolation = Curve::Interpolation;

// A cubic Bezier's coordinate; the ends are 0 and 1.
double bezier(double a, double b, double t) {
    const double u = 1.0 - t;
    return 3.0 * u * u * t * a + 3.0 * u * t * t * b + t * t * t;
}

// The parameter at which the Bezier's first coordinate is x; it grows with the parameter for a, 1 - b in [0, 1].
double parameterAt(double x, double a, double b) {
    if (std::abs(a - 1.0 / 3.0) < 1e-6 && std::abs(b - 2.0 / 3.0) < 1e-6) return x;
    double low = 0.0;
    double high = 1.0;
    for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (low + high);
        (bezier(a, b, middle) < x ? low : high) = middle;
    }
    return 0.5 * (low + high);
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

}  // namespace

Curve::Curve(std::vector<Key> keys) {
    for (const Key& key : keys) {
        const bool usable = std::isfinite(key.seconds) && std::isfinite(key.value) && std::isfinite(key.slopeLeft) &&
                            std::isfinite(key.slopeRight);
        if (usable && (keys_.empty() || key.seconds > keys_.back().seconds)) keys_.push_back(key);
    }
}

double Curve::at(double seconds) const {
    const auto after = std::upper_bound(keys_.begin(), keys_.end(), seconds,
                                        [](double time, const Key& key) { return time < key.seconds; });
    if (after == keys_.begin()) return keys_.empty() ? 0.0 : keys_.front().value;
    const Key& before = *std::prev(after);
    return after == keys_.end() || before.seconds == seconds ? before.value : between(before, *after, seconds);
}

bool Curve::moves() const {
    return std::any_of(keys_.begin(), keys_.end(), [this](const Key& key) {
        return key.value != keys_.front().value ||
               (key.interpolation == Interpolation::cubic && (key.slopeLeft != 0.0 || key.slopeRight != 0.0));
    });
}

std::optional<Curve> readCurve(const Record& record) {
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
        keys[i].seconds = times[i] / kTicksPerSecond;
        keys[i].value = values[i];
        while (left < 1.0 && attribute + 1 < counts.size())
            left = counts[++attribute];
        left -= 1.0;
        if (attribute < flags.size() && std::abs(flags[attribute]) < 4e9)
            data[i].flags = static_cast<std::uint32_t>(static_cast<std::int64_t>(flags[attribute]));
        for (std::size_t n = 0; n < 4 && 4 * attribute + n < numbers.size(); ++n)
            data[i].numbers[n] = static_cast<float>(numbers[4 * attribute + n]);
    }
    setTangents(keys, data);
    return Curve(std::move(keys));
}

}  // namespace lutka::animation::rig_import::fbx
