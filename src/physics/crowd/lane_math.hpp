#pragma once

/// Arithmetic on eight lanes through the compiler's vector types. Included by the kernels only, which are compiled
/// once an instruction set, each in its own namespace LUTKA_CROWD_KERNELS; everything has internal linkage.

#include "physics/crowd/layout.hpp"

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace lutka::physics::crowd::LUTKA_CROWD_KERNELS {

// GCC warns that passing these by value depends on the instruction set; nothing here is called across sets.
#define LUTKA_LANES static inline __attribute__((always_inline))

using F = float __attribute__((vector_size(32), may_alias));
using Mask = int __attribute__((vector_size(32), may_alias));

LUTKA_LANES F load(const Wide& wide) {
    return *reinterpret_cast<const F*>(wide.lane);
}
LUTKA_LANES void store(Wide& wide, const F& value) {
    *reinterpret_cast<F*>(wide.lane) = value;
}
LUTKA_LANES F all(float value) {
    return F{value, value, value, value, value, value, value, value};
}
// A mask with no lane set.
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
#if defined(__AVX__)
    return reinterpret_cast<F>(_mm256_sqrt_ps(reinterpret_cast<__m256>(a)));
#else
    F root;
    for (int lane = 0; lane < kLanes; ++lane)
        root[lane] = __builtin_sqrtf(a[lane]);
    return root;
#endif
}
/// A bit a lane.
LUTKA_LANES unsigned bits(const Mask& mask) {
#if defined(__AVX__)
    return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(mask)));
#else
    unsigned set = 0;
    for (int lane = 0; lane < kLanes; ++lane)
        set |= mask[lane] != 0 ? 1U << static_cast<unsigned>(lane) : 0U;
    return set;
#endif
}

struct V3 {
    F x, y, z;
};
LUTKA_LANES V3 load(const Wide3& v) {
    return {load(v.x), load(v.y), load(v.z)};
}
LUTKA_LANES void store(Wide3& to, const V3& v) {
    store(to.x, v.x);
    store(to.y, v.y);
    store(to.z, v.z);
}
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
// The part of `a` across a unit vector.
LUTKA_LANES V3 across(const V3& a, const V3& n) {
    return a - n * dot(a, n);
}
LUTKA_LANES V3 magnitude(const V3& a) {
    return {magnitude(a.x), magnitude(a.y), magnitude(a.z)};
}

struct Symmetric {
    F xx, yy, zz, xy, xz, yz;
};
LUTKA_LANES Symmetric load(const WideSymmetric& m) {
    return {load(m.xx), load(m.yy), load(m.zz), load(m.xy), load(m.xz), load(m.yz)};
}
LUTKA_LANES void store(WideSymmetric& to, const Symmetric& m) {
    store(to.xx, m.xx);
    store(to.yy, m.yy);
    store(to.zz, m.zz);
    store(to.xy, m.xy);
    store(to.xz, m.xz);
    store(to.yz, m.yz);
}
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
/// The matrix that takes an impulse at `arm` to the velocity it gives that point by turning: -[arm] I⁻¹ [arm].
LUTKA_LANES Symmetric turnedByArm(const Symmetric& inertia, const V3& r) {
    // Rows of I⁻¹ [r], then -[r] times that.
    const V3 a{inertia.xy * r.z - inertia.xz * r.y, inertia.yy * r.z - inertia.yz * r.y,
               inertia.yz * r.z - inertia.zz * r.y};
    const V3 b{inertia.xz * r.x - inertia.xx * r.z, inertia.yz * r.x - inertia.xy * r.z,
               inertia.zz * r.x - inertia.xz * r.z};
    const V3 c{inertia.xx * r.y - inertia.xy * r.x, inertia.xy * r.y - inertia.yy * r.x,
               inertia.xz * r.y - inertia.yz * r.x};
    return {r.z * a.y - r.y * a.z, r.x * b.z - r.z * b.x, r.y * c.x - r.x * c.y,
            r.z * b.y - r.y * b.z, r.z * c.y - r.y * c.z, r.x * c.z - r.z * c.x};
}

struct Q {
    F x, y, z, w;
};
LUTKA_LANES Q load(const Wide4& q) {
    return {load(q.x), load(q.y), load(q.z), load(q.w)};
}
LUTKA_LANES void store(Wide4& to, const Q& q) {
    store(to.x, q.x);
    store(to.y, q.y);
    store(to.z, q.z);
    store(to.w, q.w);
}
LUTKA_LANES Q all(const float (&q)[4]) {
    return {all(q[0]), all(q[1]), all(q[2]), all(q[3])};
}
LUTKA_LANES Q operator*(const Q& a, const Q& b) {
    return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
LUTKA_LANES Q conjugate(const Q& q) {
    return {-q.x, -q.y, -q.z, q.w};
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

/// Two unit vectors across a unit vector and each other.
LUTKA_LANES void tangentsOf(const V3& n, V3& t1, V3& t2) {
    // Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
    const F sign = n.z < all(0.0F) ? all(-1.0F) : all(1.0F);
    const F a = all(-1.0F) / (sign + n.z);
    const F b = n.x * n.y * a;
    t1 = {all(1.0F) + sign * n.x * n.x * a, sign * b, -sign * n.x};
    t2 = {b, sign + n.y * n.y * a, -n.y};
}

}  // namespace lutka::physics::crowd::LUTKA_CROWD_KERNELS
