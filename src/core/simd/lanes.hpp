#pragma once

/// Arithmetic on four or eight floats at once through the compiler's vector types: numbers, vectors, rotations, rigid
/// transforms and symmetric matrices of which every lane holds another.
///
/// Included by kernels only. Their translation unit defines LUTKA_LANE_COUNT (4 or 8) and LUTKA_KERNELS, the name of
/// its set, which differs wherever the lane count or the instruction set does; everything has internal linkage. It
/// includes no header with inline functions of others: such a function would be compiled for this set too and might be
/// the copy that the linker keeps for the whole program.
///
/// Only the arithmetic of IEEE 754 is used and no approximate reciprocals. Without fused operations all sets give the
/// same bits.

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace lutka::simd::LUTKA_KERNELS {

// GCC warns that passing these by value depends on the instruction set; nothing here is called across sets.
#define LUTKA_LANES static inline __attribute__((always_inline))

static constexpr int kLanes = LUTKA_LANE_COUNT;

using F = float __attribute__((vector_size(4 * LUTKA_LANE_COUNT), may_alias));
using Mask = int __attribute__((vector_size(4 * LUTKA_LANE_COUNT), may_alias));

/// From and to kLanes floats, aligned to their size.
LUTKA_LANES F loadLanes(const float* from) {
    return *reinterpret_cast<const F*>(from);
}
LUTKA_LANES void storeLanes(float* to, const F& value) {
    *reinterpret_cast<F*>(to) = value;
}
LUTKA_LANES F all(float value) {
#if LUTKA_LANE_COUNT == 8
    return F{value, value, value, value, value, value, value, value};
#else
    return F{value, value, value, value};
#endif
}
/// A mask with no lane set.
LUTKA_LANES Mask noLanes() {
    return all(0.0F) > all(1.0F);
}
LUTKA_LANES F least(const F& a, const F& b) {
    return a < b ? a : b;
}
LUTKA_LANES F most(const F& a, const F& b) {
    return a > b ? a : b;
}
LUTKA_LANES F clampLanes(const F& value, const F& low, const F& high) {
    return least(most(value, low), high);
}
LUTKA_LANES F magnitude(const F& a) {
    return most(a, -a);
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
/// A bit a lane, set where the mask is.
LUTKA_LANES unsigned bits(const Mask& mask) {
#if LUTKA_LANE_COUNT == 8 && defined(__AVX__)
    return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(mask)));
#else
    unsigned set = 0;
    for (int lane = 0; lane < kLanes; ++lane)
        set |= mask[lane] != 0 ? 1U << static_cast<unsigned>(lane) : 0U;
    return set;
#endif
}
/// The lanes whose bits are set.
LUTKA_LANES Mask lanesOf(unsigned set) {
    Mask mask = noLanes();
    for (int lane = 0; lane < LUTKA_LANE_COUNT; ++lane)
        mask[lane] = (set >> static_cast<unsigned>(lane) & 1U) != 0 ? -1 : 0;
    return mask;
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
LUTKA_LANES V3 operator-(const V3& a) {
    return {-a.x, -a.y, -a.z};
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
/// The part of `a` across a unit vector.
LUTKA_LANES V3 across(const V3& a, const V3& n) {
    return a - n * dot(a, n);
}
LUTKA_LANES V3 magnitude(const V3& a) {
    return {magnitude(a.x), magnitude(a.y), magnitude(a.z)};
}
LUTKA_LANES V3 choose(const Mask& mask, const V3& a, const V3& b) {
    return {mask ? a.x : b.x, mask ? a.y : b.y, mask ? a.z : b.z};
}
/// Two unit vectors across a unit vector and each other (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
LUTKA_LANES void tangentsOf(const V3& n, V3& t1, V3& t2) {
    const F sign = n.z < all(0.0F) ? all(-1.0F) : all(1.0F);
    const F a = all(-1.0F) / (sign + n.z);
    const F b = n.x * n.y * a;
    t1 = {all(1.0F) + sign * n.x * n.x * a, sign * b, -sign * n.x};
    t2 = {b, sign + n.y * n.y * a, -n.y};
}

/// A quaternion a lane.
struct Q {
    F x, y, z, w;
};
/// The same quaternion, x, y, z, w, in every lane.
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

/// Three axes: the columns of a rotation.
struct Axes {
    V3 x, y, z;
};
LUTKA_LANES Axes axesOf(const Q& q) {
    const F two = all(2.0F);
    const F one = all(1.0F);
    const F xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z;
    const F xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z;
    const F wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
    return {{one - two * (yy + zz), two * (xy + wz), two * (xz - wy)},
            {two * (xy - wz), one - two * (xx + zz), two * (yz + wx)},
            {two * (xz + wy), two * (yz - wx), one - two * (xx + yy)}};
}
LUTKA_LANES V3 operator*(const Axes& axes, const V3& v) {
    return axes.x * v.x + axes.y * v.y + axes.z * v.z;
}
LUTKA_LANES V3 transposed(const Axes& axes, const V3& v) {
    return {dot(axes.x, v), dot(axes.y, v), dot(axes.z, v)};
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
    return {back, -(back * t.at)};
}
/// The same transform in every lane: seven floats, the quaternion x, y, z, w, then the translation.
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

/// A symmetric 3 × 3 matrix a lane.
struct Symmetric {
    F xx, yy, zz, xy, xz, yz;
};
LUTKA_LANES Symmetric operator+(const Symmetric& a, const Symmetric& b) {
    return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.xz + b.xz, a.yz + b.yz};
}
LUTKA_LANES V3 operator*(const Symmetric& m, const V3& v) {
    return {m.xx * v.x + m.xy * v.y + m.xz * v.z, m.xy * v.x + m.yy * v.y + m.yz * v.z,
            m.xz * v.x + m.yz * v.y + m.zz * v.z};
}
/// Of a positive definite matrix, by cofactors.
LUTKA_LANES Symmetric inverse(const Symmetric& m) {
    const F c00 = m.yy * m.zz - m.yz * m.yz;
    const F c01 = m.xz * m.yz - m.xy * m.zz;
    const F c02 = m.xy * m.yz - m.xz * m.yy;
    const F scale = all(1.0F) / (m.xx * c00 + m.xy * c01 + m.xz * c02);
    return {c00 * scale, (m.xx * m.zz - m.xz * m.xz) * scale, (m.xx * m.yy - m.xy * m.xy) * scale, c01 * scale,
            c02 * scale, (m.xy * m.xz - m.xx * m.yz) * scale};
}

/// atan2 for y of any sign and x >= 0, to 1e-6: our own least-maximum fit of atan on [0, 1].
LUTKA_LANES F angleOf(const F& y, const F& x) {
    const F a = magnitude(y);
    const F big = most(most(a, x), all(1e-30F));
    const F ratio = least(a, x) / big;
    const F s = ratio * ratio;
    F p = all(0.00681179F);
    p = p * s - all(0.03360422F);
    p = p * s + all(0.07962367F);
    p = p * s - all(0.13233342F);
    p = p * s + all(0.19807816F);
    p = p * s - all(0.33317368F);
    p = p * s + all(0.99999611F);
    const F near = p * ratio;
    const F angle = a > x ? all(1.57079633F) - near : near;
    return y < all(0.0F) ? -angle : angle;
}

}  // namespace lutka::simd::LUTKA_KERNELS
