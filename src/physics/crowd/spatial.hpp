#pragma once

/// 3 × 3 matrices in lanes, and the inertia of a body that has others hanging on it.

#include "physics/crowd/lane_storage.hpp"

namespace lutka::physics::crowd::LUTKA_KERNELS {

struct Matrix {
    V3 row[3];
};
LUTKA_LANES Matrix load(const WideMatrix& m) {
    return {{load(m.row[0]), load(m.row[1]), load(m.row[2])}};
}
LUTKA_LANES void store(WideMatrix& to, const Matrix& m) {
    store(to.row[0], m.row[0]);
    store(to.row[1], m.row[1]);
    store(to.row[2], m.row[2]);
}
LUTKA_LANES V3 operator*(const Matrix& m, const V3& v) {
    return {dot(m.row[0], v), dot(m.row[1], v), dot(m.row[2], v)};
}
LUTKA_LANES V3 transposed(const Matrix& m, const V3& v) {
    return m.row[0] * v.x + m.row[1] * v.y + m.row[2] * v.z;
}
// m times a symmetric matrix: its rows are images under it.
LUTKA_LANES Matrix operator*(const Matrix& m, const Symmetric& s) {
    return {{s * m.row[0], s * m.row[1], s * m.row[2]}};
}
LUTKA_LANES Matrix product(const Symmetric& a, const Symmetric& b) {
    return Matrix{{V3{a.xx, a.xy, a.xz}, V3{a.xy, a.yy, a.yz}, V3{a.xz, a.yz, a.zz}}} * b;
}
// m [v]: the matrix that crosses with v first. Row i times [v] is row i × v.
LUTKA_LANES Matrix timesCross(const Matrix& m, const V3& v) {
    return {{cross(m.row[0], v), cross(m.row[1], v), cross(m.row[2], v)}};
}
LUTKA_LANES Matrix operator+(const Matrix& a, const Matrix& b) {
    return {{a.row[0] + b.row[0], a.row[1] + b.row[1], a.row[2] + b.row[2]}};
}
LUTKA_LANES Matrix operator-(const Matrix& a, const Matrix& b) {
    return {{a.row[0] - b.row[0], a.row[1] - b.row[1], a.row[2] - b.row[2]}};
}
LUTKA_LANES Symmetric operator-(const Symmetric& a, const Symmetric& b) {
    return {a.xx - b.xx, a.yy - b.yy, a.zz - b.zz, a.xy - b.xy, a.xz - b.xz, a.yz - b.yz};
}
LUTKA_LANES Matrix rowsOf(const Symmetric& s) {
    return {{V3{s.xx, s.xy, s.xz}, V3{s.xy, s.yy, s.yz}, V3{s.xz, s.yz, s.zz}}};
}
// a bᵀ, of which the caller knows that it is symmetric.
LUTKA_LANES Symmetric symmetricProduct(const Matrix& a, const Matrix& b) {
    return {dot(a.row[0], b.row[0]), dot(a.row[1], b.row[1]), dot(a.row[2], b.row[2]),
            dot(a.row[0], b.row[1]), dot(a.row[0], b.row[2]), dot(a.row[1], b.row[2])};
}
// The inertia of a mass at an arm.
LUTKA_LANES Symmetric pointInertia(const V3& arm, F mass) {
    const V3 scaled = arm * mass;
    const F whole = dot(scaled, arm);
    return {whole - scaled.x * arm.x, whole - scaled.y * arm.y, whole - scaled.z * arm.z,
            -(scaled.x * arm.y),      -(scaled.x * arm.z),      -(scaled.y * arm.z)};
}
// weight · a aᵀ added.
LUTKA_LANES void addSquare(Symmetric& to, const V3& a, F weight) {
    const V3 scaled = a * weight;
    to.xx += scaled.x * a.x;
    to.yy += scaled.y * a.y;
    to.zz += scaled.z * a.z;
    to.xy += scaled.x * a.y;
    to.xz += scaled.x * a.z;
    to.yz += scaled.y * a.z;
}

// Inertia about some point: what momentum and angular momentum velocity and angular velocity give.
struct Spatial {
    Symmetric linear;
    Matrix mixed;
    Symmetric turning;
};
LUTKA_LANES Spatial operator+(const Spatial& a, const Spatial& b) {
    return {a.linear + b.linear, a.mixed + b.mixed, a.turning + b.turning};
}
LUTKA_LANES Spatial load(const GatheredLanes& g) {
    return {load(g.linear), load(g.mixed), load(g.turning)};
}
LUTKA_LANES void store(GatheredLanes& to, const Spatial& s) {
    store(to.linear, s.linear);
    store(to.mixed, s.mixed);
    store(to.turning, s.turning);
}
// The turning block under a shift of the point, which needs the mixed block before and after: B - [r] C' + Cᵀ [r] for
// C' = C + H [r]. Both terms by their columns.
LUTKA_LANES Symmetric shiftTurning(const Symmetric& b, const Matrix& before, const Matrix& after, const V3& r) {
    // [r] C' has columns r × (column of C'); Cᵀ [r] has rows (column of C) × r.
    const V3 a0{after.row[0].x, after.row[1].x, after.row[2].x};
    const V3 a1{after.row[0].y, after.row[1].y, after.row[2].y};
    const V3 a2{after.row[0].z, after.row[1].z, after.row[2].z};
    const V3 c0{before.row[0].x, before.row[1].x, before.row[2].x};
    const V3 c1{before.row[0].y, before.row[1].y, before.row[2].y};
    const V3 left0 = cross(r, a0), left1 = cross(r, a1), left2 = cross(r, a2);
    const V3 right0 = cross(c0, r), right1 = cross(c1, r);
    const V3 c2{before.row[0].z, before.row[1].z, before.row[2].z};
    const V3 right2 = cross(c2, r);
    return {b.xx - left0.x + right0.x, b.yy - left1.y + right1.y, b.zz - left2.z + right2.z,
            b.xy - left1.x + right0.y, b.xz - left2.x + right0.z, b.yz - left2.y + right1.z};
}
// From one point to another, at `r` from it.
LUTKA_LANES Spatial movedTo(const Spatial& s, const V3& r) {
    const Matrix mixed = s.mixed + timesCross(rowsOf(s.linear), r);
    return {s.linear, mixed, shiftTurning(s.turning, s.mixed, mixed, r)};
}
// J K Jᵀ of the weights K of a point's velocity, at an arm.
LUTKA_LANES void addPoint(Spatial& s, const V3& arm, const Symmetric& k) {
    const Matrix rows = rowsOf(k);
    const Matrix mixed{{cross(arm, rows.row[0]), cross(arm, rows.row[1]), cross(arm, rows.row[2])}};
    s.linear = s.linear + k;
    s.mixed = s.mixed + mixed;
    const V3 first = cross(arm, V3{mixed.row[0].x, mixed.row[1].x, mixed.row[2].x});
    const V3 c1{mixed.row[0].y, mixed.row[1].y, mixed.row[2].y};
    const V3 c2{mixed.row[0].z, mixed.row[1].z, mixed.row[2].z};
    s.turning.xx += first.x;
    s.turning.xy += first.y;
    s.turning.xz += first.z;
    s.turning.yy += arm.z * c1.x - arm.x * c1.z;
    s.turning.yz += arm.x * c1.y - arm.y * c1.x;
    s.turning.zz += arm.x * c2.y - arm.y * c2.x;
}

}  // namespace lutka::physics::crowd::LUTKA_KERNELS
