#pragma once

/// Arithmetic on four or eight floats at once through the compiler's vector types. Included by the kernels only, which
/// are compiled once an instruction set, each in its own namespace LUTKA_KERNELS; everything has internal linkage.
///
/// Only the arithmetic of IEEE 754 is used (no approximate reciprocals, no fused operations), so that all sets give the
/// same bits.

#include "animation/wide/layout.hpp"

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace lutka::animation::wide::LUTKA_KERNELS {

// GCC warns that passing these by value depends on the instruction set; nothing here is called across sets.
#define LUTKA_LANES static inline __attribute__((always_inline))

static constexpr int kLanes = LUTKA_LANE_COUNT;

using F = float __attribute__((vector_size(4 * LUTKA_LANE_COUNT), may_alias));
using Mask = int __attribute__((vector_size(4 * LUTKA_LANE_COUNT), may_alias));

LUTKA_LANES F all(float value) {
#if LUTKA_LANE_COUNT == 8
    return F{value, value, value, value, value, value, value, value};
#else
    return F{value, value, value, value};
#endif
}
LUTKA_LANES F least(const F& a, const F& b) {
    return a < b ? a : b;
}
LUTKA_LANES F most(const F& a, const F& b) {
    return a > b ? a : b;
}
/// Correctly rounded on every instruction set.
LUTKA_LANES F squareRoot(const F& a) {
#if LUTKA_LANE_COUNT == 8 && defined(__AVX__)
    return reinterpret_cast<F>(_mm256_sqrt_ps(reinterpret_cast<__m256>(a)));
#elif LUTKA_LANE_COUNT == 4 && defined(__SSE2__)
    return reinterpret_cast<F>(_mm_sqrt_ps(reinterpret_cast<__m128>(a)));
#else
    F root;
    for (int lane = 0; lane < kLanes; ++lane)
        root[lane] = __builtin_sqrtf(a[lane]);
    return root;
#endif
}
LUTKA_LANES F loadLanes(const float* from) {
    return *reinterpret_cast<const F*>(from);
}
LUTKA_LANES void storeLanes(float* to, const F& value) {
    *reinterpret_cast<F*>(to) = value;
}

struct V3 {
    F x, y, z;
};
LUTKA_LANES V3 all(const float (&v)[3]) {
    return {all(v[0]), all(v[1]), all(v[2])};
}
LUTKA_LANES V3 operator+(const V3& a, const V3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
LUTKA_LANES V3 operator-(const V3& a, const V3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
LUTKA_LANES V3 operator*(const V3& a, const F& s) {
    return {a.x * s, a.y * s, a.z * s};
}
LUTKA_LANES F dot(const V3& a, const V3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
LUTKA_LANES V3 cross(const V3& a, const V3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A quaternion a lane.
struct Q {
    F x, y, z, w;
};
LUTKA_LANES Q allTurns(const float* q) {
    return {all(q[0]), all(q[1]), all(q[2]), all(q[3])};
}
LUTKA_LANES Q operator*(const Q& a, const Q& b) {
    return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
LUTKA_LANES Q conjugate(const Q& q) {
    return {-q.x, -q.y, -q.z, q.w};
}
LUTKA_LANES Q normalised(const Q& q) {
    const F scale = all(1.0F) / squareRoot(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    return {q.x * scale, q.y * scale, q.z * scale, q.w * scale};
}
LUTKA_LANES V3 operator*(const Q& q, const V3& v) {
    const V3 u{q.x, q.y, q.z};
    const V3 t = cross(u, v) * all(2.0F);
    return v + t * q.w + cross(u, t);
}

/// A rigid transform a lane.
struct Rigid {
    Q turn;
    V3 at;
};
LUTKA_LANES Rigid operator*(const Rigid& a, const Rigid& b) {
    return {a.turn * b.turn, a.turn * b.at + a.at};
}
LUTKA_LANES Rigid inverse(const Rigid& t) {
    const Q back = conjugate(t.turn);
    const V3 at = back * t.at;
    return {back, {-at.x, -at.y, -at.z}};
}
LUTKA_LANES Rigid allRigid(const float* t) {
    return {allTurns(t), {all(t[4]), all(t[5]), all(t[6])}};
}
/// Seven registers in a row.
LUTKA_LANES Rigid loadRigid(const float* from) {
    return {{loadLanes(from), loadLanes(from + kLanes), loadLanes(from + 2 * kLanes), loadLanes(from + 3 * kLanes)},
            {loadLanes(from + 4 * kLanes), loadLanes(from + 5 * kLanes), loadLanes(from + 6 * kLanes)}};
}
LUTKA_LANES void storeRigid(float* to, const Rigid& t) {
    storeLanes(to, t.turn.x);
    storeLanes(to + kLanes, t.turn.y);
    storeLanes(to + 2 * kLanes, t.turn.z);
    storeLanes(to + 3 * kLanes, t.turn.w);
    storeLanes(to + 4 * kLanes, t.at.x);
    storeLanes(to + 5 * kLanes, t.at.y);
    storeLanes(to + 6 * kLanes, t.at.z);
}

}  // namespace lutka::animation::wide::LUTKA_KERNELS
