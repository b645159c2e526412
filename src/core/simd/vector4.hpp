#pragma once

/// Three floats and a zero in one register, by the compiler's vector types. The fourth lane stays zero through all of
/// these, so that sums over all four lanes are those over three.
namespace lutka::simd {

using F4 = float __attribute__((vector_size(16)));

[[nodiscard]] inline F4 allF4(float x) {
    return F4{x, x, x, x};
}
[[nodiscard]] inline float sum(const F4& v) {
    const F4 pairs = v + __builtin_shufflevector(v, v, 2, 3, 0, 1);
    return pairs[0] + pairs[1];
}
[[nodiscard]] inline float dot(const F4& a, const F4& b) {
    return sum(a * b);
}
[[nodiscard]] inline F4 cross(const F4& a, const F4& b) {
    const F4 turnedA = __builtin_shufflevector(a, a, 1, 2, 0, 3);
    const F4 turnedB = __builtin_shufflevector(b, b, 1, 2, 0, 3);
    const F4 c = a * turnedB - turnedA * b;
    return __builtin_shufflevector(c, c, 1, 2, 0, 3);
}

/// a × b - c × d, by one shuffle less.
[[nodiscard]] inline F4 crossDifference(const F4& a, const F4& b, const F4& c, const F4& d) {
    const auto turned = [](const F4& v) { return __builtin_shufflevector(v, v, 1, 2, 0, 3); };
    return turned((a * turned(b) - turned(a) * b) - (c * turned(d) - turned(c) * d));
}

/// A 3 × 3 matrix by columns.
struct M4 {
    F4 x{}, y{}, z{};

    [[nodiscard]] F4 operator*(const F4& v) const {
        return x * __builtin_shufflevector(v, v, 0, 0, 0, 0) + y * __builtin_shufflevector(v, v, 1, 1, 1, 1) +
               z * __builtin_shufflevector(v, v, 2, 2, 2, 2);
    }
};

/// Of a symmetric matrix that has one.
[[nodiscard]] inline M4 inverseOfSymmetric(const M4& m) {
    const F4 yz = cross(m.y, m.z);
    const F4 scale = allF4(1.0F / dot(m.x, yz));
    return {yz * scale, cross(m.z, m.x) * scale, cross(m.x, m.y) * scale};
}

}  // namespace lutka::simd
